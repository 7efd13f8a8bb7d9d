#version 450
#extension GL_GOOGLE_include_directive : enable
// Prefix sums of uvec4, step 3 of 3: the exclusive sum of every element.
#include "gpu_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;  // 64
layout(push_constant) uniform Push { ScanConstants scan; };
layout(set = 0, binding = 0) readonly buffer Elements { uvec4 elements[]; };
layout(set = 0, binding = 1) readonly buffer BlockSums { uvec4 block_sums[]; };
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) writeonly buffer Sums { uvec4 sums[]; };

shared uvec4 lane_sums[64];

void main() {
  uint block = workgroup_index();
  uint lane = gl_LocalInvocationID.x;
  uint count = counters[scan.items_counter] * scan.items_multiplier;
  uint begin = 1024u * block + 16u * lane;
  uint end = min(count, begin + 16u);
  uvec4 sum = uvec4(0);
  for (uint i = begin; i < end; ++i) sum += elements[i];
  lane_sums[lane] = sum;
  barrier();
  if (begin >= count) return;
  uvec4 offset = block_sums[block];
  for (uint i = 0; i < lane; ++i) offset += lane_sums[i];
  for (uint i = begin; i < end; ++i) {
    sums[i] = offset;
    offset += elements[i];
  }
}
