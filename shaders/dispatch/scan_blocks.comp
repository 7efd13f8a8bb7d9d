#version 450
#extension GL_GOOGLE_include_directive : enable
// Prefix sums of uvec4, step 1 of 3: the sum of each block of 1024 elements (Blelloch 1990).
#include "lanes/scan.glsl"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;  // 64
layout(push_constant) uniform Push { ScanConstants scan; };
layout(set = 0, binding = 0) readonly buffer Elements { uvec4 elements[]; };
layout(set = 0, binding = 1) writeonly buffer BlockSums { uvec4 block_sums[]; };
layout(set = 0, binding = 2) readonly buffer Counters { uint counters[]; };

shared uvec4 lane_sums[64];

void main() {
  uint block = workgroup_index();
  uint count = counters[scan.items_counter] * scan.items_multiplier;
  uint begin = 1024u * block + 16u * gl_LocalInvocationID.x;
  uvec4 sum = uvec4(0);
  for (uint i = begin; i < min(count, begin + 16u); ++i) sum = add(sum, elements[i]);
  lane_sums[gl_LocalInvocationID.x] = sum;
  barrier();
  if (gl_LocalInvocationID.x != 0u || 1024u * block >= count) return;
  uvec4 total = uvec4(0);
  for (uint i = 0; i < 64u; ++i) total = add(total, lane_sums[i]);
  block_sums[block] = total;
}
