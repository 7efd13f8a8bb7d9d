#version 450
#extension GL_GOOGLE_include_directive : enable
// Generalised winding numbers within the tolerance, and the bound of their error that was met. A query whose w is
// negative is passed over.
#define QUERY_STORAGE_BUFFERS 7
#include "tree/tree_query.glsl"
layout(set = 0, binding = 5) writeonly buffer Numbers { vec2 numbers[]; };
layout(set = 0, binding = 6) readonly coherent buffer Stop { uint stop; };  // not 0: no answer is wanted any more
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
