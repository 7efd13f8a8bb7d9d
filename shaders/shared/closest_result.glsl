// The result of a closest-point query, as both its kernels write it. Include tree_query.glsl before.
#include "triangle_feature.glsl"

layout(set = 0, binding = 5) readonly buffer TriangleOrder { uint triangle_order[]; };  // leaf position to input index
layout(set = 0, binding = 6) writeonly buffer Nearest { vec4 nearest[]; };  // point; w: squared distance
layout(set = 0, binding = 7) writeonly buffer Hits { uint hits[]; };        // feature << 24 | leaf position

const uint kNoHit = 0xffffffffu;

// on_face: another arithmetic found the foot of the perpendicular inside. Beside an edge this one may differ, and what
// was chosen as a face must not be called an edge.
void write_hit(uint query, vec3 p, uint triangle, bool on_face) {
  TriangleTexels texels = load_triangle(triangle == kNoHit ? 0u : triangle);
  vec3 v = vector_to_triangle(p, texels);
  uint feature = on_face ? 0u : feature_of_triangle(p, texels);
  nearest[query] = triangle == kNoHit ? vec4(p, 3.4e38) : vec4(p + v, dot(v, v));
  hits[query] = triangle == kNoHit ? kNoHit : feature << 24 | triangle;
}

void write_hit(uint query, vec3 p, uint triangle) { write_hit(query, p, triangle, false); }
