#version 450
#extension GL_GOOGLE_include_directive : enable
// Tests whether the open ball around a query's xyz holds no point of the mesh. w: squared radius; negative: skipped.
// Writes 1 or 0.
#define QUERY_STORAGE_BUFFERS 8
#include "tree/tree_query.glsl"
layout(set = 0, binding = 5) readonly buffer TriangleOrder { uint triangle_order[]; };
layout(set = 0, binding = 6) writeonly buffer Empty { uint empty[]; };
layout(set = 0, binding = 7) readonly coherent buffer Stop { uint stop; };  // not 0: results are no longer needed
#include "tree/tree_closest.glsl"

void main() {
  uint query = invocation_index();
  if (query >= query_count() || stop != 0u) return;
  vec4 q = queries[query];
  if (q.w < 0.0) return;
  TreeHit hit = walk_tree(q.xyz, q.w, true);
  if (hit.complete)
    empty[query] = uint(hit.triangle == 0xffffffffu);
  else
    leave_unresolved(query);
  count_tests();
}
