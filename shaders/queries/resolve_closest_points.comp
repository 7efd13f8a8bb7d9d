#version 450
#extension GL_GOOGLE_include_directive : enable
// Closest points of the queries whose walk was too long: a workgroup examines all triangles for one query.
#define QUERY_STORAGE_BUFFERS 8
#include "tree/tree_query.glsl"
#include "tree/closest_result.glsl"
#include "tree/tree_closest.glsl"

shared float best_distance[256];
shared uint best_triangle[256];

bool is_nearer(float d, uint triangle, float other_d, uint other) {
  bool tie = d == other_d && triangle != kNoHit && other != kNoHit;
  if (!tie) return d < other_d;
  return kSmallestIndex ? triangle_order[triangle] < triangle_order[other] : triangle < other;
}

void main() {
  if (group_index() >= unresolved[kUnresolvedCount]) return;
  uint query = unresolved[kUnresolvedFirst + group_index()];
  uint lane = gl_LocalInvocationID.x;
  vec4 q = queries[query];
  float best = q.w;
  uint triangle = kNoHit;
  for (uint t = lane; t < push.triangle_count; t += gl_WorkGroupSize.x) {
    TriangleTexels texels = load_triangle(t);
    float d = squared_distance_to_triangle(q.xyz, texels);
    d *= foot_is_inside(q.xyz, texels) ? kPreferFaces : 1.0;
    bool nearer = is_nearer(d, t, best, triangle);
    best = nearer ? d : best;
    triangle = nearer ? t : triangle;
    ++tested_triangles;
  }
  count_tests();
  best_distance[lane] = best;
  best_triangle[lane] = triangle;
  for (uint half_count = gl_WorkGroupSize.x / 2u; half_count > 0u; half_count /= 2u) {
    barrier();
    uint other = lane + half_count;
    if (lane < half_count &&
        is_nearer(best_distance[other], best_triangle[other], best_distance[lane], best_triangle[lane])) {
      best_distance[lane] = best_distance[other];
      best_triangle[lane] = best_triangle[other];
    }
  }
  if (lane == 0u) write_hit(query, q.xyz, best_triangle[0]);
}
