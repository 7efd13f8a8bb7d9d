// The triangle nearest to a point, and the emptiness of a ball, by one invocation: the near child is visited first, and
// the far child is put on the stack. Include tree.glsl before.
#ifndef MEDIAL_VK_TREE_CLOSEST_GLSL
#define MEDIAL_VK_TREE_CLOSEST_GLSL
#include "tree/triangle_feature.glsl"

// If the foot of the perpendicular lies in a face, but close to an edge, the neighbour's edge is equally near in float:
// the squares differ by less than a rounding of the height h, while the points are up to sqrt(2^-22) h = 5e-4 h apart.
// A face is therefore preferred by a little more than that rounding, which costs 2^-21 of the distance.
const float kPreferFaces = 1.0 - 9.5367e-7;  // 2^-20

struct TreeHit {
  float squared_distance;  // the given bound if there is no nearer triangle
  uint triangle;           // leaf position, 0xffffffff if there is none
  bool complete;           // false: the walk was too long, examine all triangles
};

// Among exact ties the smallest index of the input wins (triangle_order: leaf position to index), at the cost of a
// seventh more time; otherwise the smallest leaf position.
layout(constant_id = 1) const bool kSmallestIndex = false;

// Nearest triangle closer than sqrt(bound); if `any`, the first one that is found.
TreeHit walk_tree(vec3 p, float bound, bool any) {
  uint positions[kStackSize];
  float distances[kStackSize];
  uint size = 0u, position = 0u, rounds = 0u;
  TreeHit hit = TreeHit(bound, 0xffffffffu, false);
  uint best_index = 0u;  // a point at exactly the bound is no hit
  while (position != kFinished) {
    uint descents = 0u;
    while (descents < kDescents) {
      bool inner = position < kLeaf;
      uint node = 4u * (inner ? position : 0u);
      vec4 lower_0 = tree_texel(node), upper_0 = tree_texel(node + 1u);
      vec4 lower_1 = tree_texel(node + 2u), upper_1 = tree_texel(node + 3u);
      float d_0 = squared_distance_to_box(p, lower_0.xyz, upper_0.xyz);
      float d_1 = squared_distance_to_box(p, lower_1.xyz, upper_1.xyz);
      uint position_0 = tree_position(lower_0, upper_0), position_1 = tree_position(lower_1, upper_1);
      bool swapped = d_1 < d_0;
      float near = min(d_0, d_1), far = max(d_0, d_1);
      positions[min(size, kStackSize - 1u)] = swapped ? position_0 : position_1;
      distances[min(size, kStackSize - 1u)] = far;
      size += uint(inner && far <= hit.squared_distance);
      uint next = near <= hit.squared_distance ? (swapped ? position_1 : position_0) : kSkipped;
      position = inner ? next : position;
      tested_nodes += inner ? 2u : 0u;
      if (position >= kLeaf || ++descents == kDescents) break;
    }
    bool leaf = is_leaf(position), down = position < kLeaf;
    uint first = leaf ? position & kFirstMask : 0u, count = leaf ? position >> 24 : 0u;
    uint i = 0u;
    while (i <= count) {
      TriangleTexels texels = load_triangle(first + i);
      float d = squared_distance_to_triangle(p, texels);
      d *= !any && foot_is_inside(p, texels) ? kPreferFaces : 1.0;
      uint index = kSmallestIndex && !any ? triangle_order[first + i] : first + i;
      bool nearer = i < count && (d < hit.squared_distance || (d == hit.squared_distance && index < best_index));
      hit.squared_distance = nearer ? d : hit.squared_distance;
      hit.triangle = nearer ? first + i : hit.triangle;
      best_index = nearer ? index : best_index;
      if (++i >= count) break;
    }
    tested_triangles += count;
    bool stop = any && hit.triangle != 0xffffffffu;
    uint pops = 0u;
    while (pops < kPops) {
      bool pop = !down && size > 0u;
      size -= uint(pop);
      uint top = min(size, kStackSize - 1u);
      uint popped = distances[top] <= hit.squared_distance ? positions[top] : kSkipped;
      position = down ? position : (pop && !stop ? popped : kFinished);
      if (position != kSkipped || ++pops == kPops) break;
    }
    if (position == kFinished || ++rounds == kRounds) break;
  }
  hit.complete = position == kFinished;
  return hit;
}

#endif
