#version 450
#extension GL_GOOGLE_include_directive : enable
// The point of the mesh nearest to each query: xyz, and in w the squared distance within which it is sought, or a
// negative number if the query is to be skipped.
#define QUERY_STORAGE_BUFFERS 8
#include "tree/tree_query.glsl"
#include "tree/closest_result.glsl"
#include "tree/tree_closest.glsl"

void main() {
  uint query = invocation_index();
  if (query >= query_count()) return;
  vec4 q = queries[query];
  if (q.w < 0.0) return;
  TreeHit hit = walk_tree(q.xyz, q.w, false);
  if (hit.complete)
    write_hit(query, q.xyz, hit.triangle);
  else
    leave_unresolved(query);
  count_tests();
}
