// The result of a closest-point query, as both of its kernels write it. Include tree_query.glsl before.
#include "tree/triangle_feature.glsl"

layout(set = 0, binding = 5) readonly buffer TriangleOrder { uint triangle_order[]; };  // leaf position to input index
layout(set = 0, binding = 6) writeonly buffer Nearest { vec4 nearest[]; };  // point; w: squared distance
layout(set = 0, binding = 7) writeonly buffer Hits { uint hits[]; };        // feature << 24 | leaf position

const uint kNoHit = 0xffffffffu;

void write_hit(uint query, vec3 p, uint triangle) {
  TriangleTexels texels = load_triangle(triangle == kNoHit ? 0u : triangle);
  vec3 v = vector_to_triangle(p, texels);
  nearest[query] = triangle == kNoHit ? vec4(p, 3.4e38) : vec4(p + v, dot(v, v));
  hits[query] = triangle == kNoHit ? kNoHit : feature_of_triangle(p, texels) << 24 | triangle;
}
