#version 450
#extension GL_GOOGLE_include_directive : enable
// Queries at the opposites of those samples that are nearest to an edge or a vertex, since only these can be two-sided
// fans (Definition 2.4).
#include "tree/sphere_samples.glsl"
layout(set = 0, binding = 2) readonly buffer Samples { vec4 samples[]; };
layout(set = 0, binding = 3) readonly buffer Nearest { vec4 nearest[]; };
layout(set = 0, binding = 4) readonly buffer Hits { uint hits[]; };
layout(set = 0, binding = 5) writeonly buffer Queries { vec4 queries[]; };

void main() {
  uint index = invocation_index();
  uint sphere = index / push.samples;
  if (sphere >= sphere_count()) return;
  vec3 point = samples[index].xyz;
  vec3 direction = unit_or_zero(nearest[index].xyz - point);
  bool passed_over = samples[index].w < 0.0 || hits[index] >> 24 == 0u;
  queries[index] = vec4(opposite(spheres[sphere].xyz, point, direction), passed_over ? kPassOver : kAnyDistance);
}
