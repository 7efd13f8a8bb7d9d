#version 450
#extension GL_GOOGLE_include_directive : enable
// Prefix sums of uvec4, step 2 of 3: one workgroup converts the block sums into offsets, and stores the totals. A total
// above its limit means that a buffer is too small: the overflow counter records that, and all dispatches that are
// sized afterwards are empty; those that have been sized read it before they use the sums. Few elements need no other
// step: their sums are computed here.
#include "lanes/scan.glsl"

layout(local_size_x_id = 0) in;  // 64
layout(push_constant) uniform Push { ScanConstants scan; };
layout(set = 0, binding = 0) buffer BlockSums { uvec4 block_sums[]; };
layout(set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) readonly buffer Elements { uvec4 elements[]; };
layout(set = 0, binding = 3) writeonly buffer Sums { uvec4 sums[]; };

shared uvec4 lane_sums[64];

uvec4 part(uint i, bool few) {
  if (few) return elements[i];
  return block_sums[i];
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  // After an overflow no elements have been written: stale elements must not raise another one. (All lanes read before
  // any writes.)
  if (counters[kOverflow] != 0u) return;
  uint count = counters[scan.items_counter] * scan.items_multiplier;
  bool few = count <= kFewElements;
  uint parts = few ? count : (count + 1023u) / 1024u;
  uint run = (parts + 63u) / 64u;
  uint begin = min(parts, lane * run), end = min(parts, begin + run);
  uvec4 sum = uvec4(0);
  for (uint i = begin; i < end; ++i) sum = add(sum, part(i, few));
  lane_sums[lane] = sum;
  barrier();
  uvec4 offset = uvec4(0), total = uvec4(0);
  for (uint i = 0; i < 64u; ++i) {
    offset = add(offset, i < lane ? lane_sums[i] : uvec4(0));
    total = add(total, lane_sums[i]);
  }
  for (uint i = begin; i < end; ++i) {
    uvec4 next = add(offset, part(i, few));
    if (few)
      sums[i] = offset;
    else
      block_sums[i] = offset;
    offset = next;
  }
  if (lane != 0u) return;
  counters[scan.total_x] = total.x;
  counters[scan.total_y] = total.y;
  counters[scan.total_z] = total.z;
  vec3 share = vec3(total.xyz) / vec3(scan.limit_x, scan.limit_y, scan.limit_z);
  uint fullest = uint(min(1e6, 1024.0 * max(share.x, max(share.y, share.z))));
  counters[kUtilisation] = max(counters[kUtilisation], fullest);
  uint overflow = uint(total.x > scan.limit_x) | uint(total.y > scan.limit_y) << 1 | uint(total.z > scan.limit_z) << 2;
  if (overflow != 0u) {
    counters[kOverflow] |= overflow;
    counters[scan.total_x] = 0u;
  }
}
