#version 450
#extension GL_GOOGLE_include_directive : enable
// The winding numbers whose walk was too long: a workgroup sums all triangles for one query. The order of the sum is
// fixed, so the result is the same every time.
#define QUERY_STORAGE_BUFFERS 7
#include "tree/tree_query.glsl"
layout(set = 0, binding = 5) writeonly buffer Numbers { vec2 numbers[]; };
layout(set = 0, binding = 6) readonly coherent buffer Stop { uint stop; };  // not 0: results are no longer needed
#include "tree/winding.glsl"

shared float sums[256];
shared bool stopped;  // one read for all lanes, which meet at barriers

void main() {
  if (group_index() >= unresolved[kUnresolvedCount]) return;
  uint query = unresolved[kUnresolvedFirst + group_index()];
  uint lane = gl_LocalInvocationID.x;
  if (lane == 0u) stopped = stop != 0u;
  barrier();
  if (stopped) return;
  vec3 p = queries[query].xyz;
  float sum = 0.0;
  for (uint t = lane; t < push.triangle_count; t += gl_WorkGroupSize.x) {
    sum += winding_of_triangle(p, load_triangle(t));
    ++tested_triangles;
  }
  count_tests();
  sums[lane] = sum;
  for (uint half_count = gl_WorkGroupSize.x / 2u; half_count > 0u; half_count /= 2u) {
    barrier();
    if (lane < half_count) sums[lane] += sums[lane + half_count];
  }
  if (lane == 0u) numbers[query] = vec2(sums[0], 0.0);
}
