#version 450
#extension GL_GOOGLE_include_directive : enable
// Generalised winding numbers within the tolerance, and the attained bound of their error. A query with a negative w is
// skipped.
#define QUERY_STORAGE_BUFFERS 7
#include "tree/tree_query.glsl"
layout(set = 0, binding = 5) writeonly buffer Numbers { vec2 numbers[]; };
layout(set = 0, binding = 6) readonly coherent buffer Stop { uint stop; };  // not 0: results are no longer needed
#include "tree/winding.glsl"

void main() {
  uint query = invocation_index();
  if (query >= query_count() || stop != 0u) return;
  vec4 q = queries[query];
  if (q.w < 0.0) return;
  Winding winding = winding_number(q.xyz, push.tolerance);
  if (winding.complete)
    numbers[query] = vec2(winding.number, winding.bound);
  else
    leave_unresolved(query);
  count_tests();
}
