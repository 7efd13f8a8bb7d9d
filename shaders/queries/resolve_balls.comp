#version 450
#extension GL_GOOGLE_include_directive : enable
// The balls whose walk was too long: a workgroup tests all triangles for one ball.
#define QUERY_STORAGE_BUFFERS 8
#include "tree/tree_query.glsl"
layout(set = 0, binding = 5) readonly buffer TriangleOrder { uint triangle_order[]; };
layout(set = 0, binding = 6) writeonly buffer Empty { uint empty[]; };
layout(set = 0, binding = 7) readonly coherent buffer Stop { uint stop; };  // not 0: results are no longer needed

shared uint found;
shared bool stopped;  // one read for all lanes, which meet at barriers

void main() {
  if (group_index() >= unresolved[kUnresolvedCount]) return;
  uint query = unresolved[kUnresolvedFirst + group_index()];
  vec4 q = queries[query];
  if (gl_LocalInvocationID.x == 0u) {
    found = 0u;
    stopped = stop != 0u;
  }
  barrier();
  if (stopped) return;
  bool inside = false;
  for (uint t = gl_LocalInvocationID.x; t < push.triangle_count; t += gl_WorkGroupSize.x) {
    inside = inside || squared_distance_to_triangle(q.xyz, load_triangle(t)) < q.w;
    ++tested_triangles;
  }
  count_tests();
  if (inside) atomicOr(found, 1u);
  barrier();
  if (gl_LocalInvocationID.x == 0u) empty[query] = 1u - found;
}
