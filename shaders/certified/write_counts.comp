#version 450
#extension GL_GOOGLE_include_directive : enable
// The counts that a recorded job reports to its host (RecordedCounts in medial_vk/extraction_job.h): arguments of a
// draw with an instance for every sphere, and whether all of them are there.
#include "gpu_types.h"

layout(local_size_x_id = 0) in;  // 1
layout(push_constant) uniform Push { uint vertices_per_sphere; };
layout(set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) writeonly buffer Counts { uint counts[]; };

void main() {
  bool complete = counters[kOverflow] == 0u;
  counts[0] = vertices_per_sphere;
  counts[1] = complete ? counters[kFound] : 0u;
  counts[2] = 0u;
  counts[3] = 0u;
  counts[4] = complete ? counters[kUndecided] : 0u;
  counts[5] = complete ? 1u : 0u;
  counts[6] = counters[kOverflow];
}
