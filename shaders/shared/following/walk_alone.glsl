// The walk of search.glsl by one ball, from box to box. Included by search.glsl.
#ifndef MEDIAL_VK_FOLLOWING_WALK_ALONE_GLSL
#define MEDIAL_VK_FOLLOWING_WALK_ALONE_GLSL

// lavapipe ends all loops of an invocation silently after 65,535 iterations, and counts an iteration if any of the
// invocations beside it makes it. A round is at most kDescents boxes, kMostTests tests of triangles, and the ends of the
// three loops.
const uint kDescents = 8u;
const uint kMostTests = 32u;  // in a leaf, of at most kMostFollowLeaf triangles
#ifndef SEARCH_ROUNDS
#define SEARCH_ROUNDS 1500u
#endif

uint rounds = 0u;  // of all searches

void test_leaf(uint leaf) {
  uint i = leaf & ((1u << kFollowLeafBits) - 1u), end = i + (leaf >> kFollowLeafBits), tests = 0u;
  while (i < end) {
    bool again = shrinks_at(load_followed(i), i, true, tests + kMostFollowLeaf < kMostTests);
    i += again ? 0u : 1u;
    if (i >= end || ++tests == kMostTests) break;
  }
}

// From the ball that at, towards and radius (or a fixed centre) describe, if one is wanted.
void search(bool is_wanted) {
  deficit = 0.0;
  place_ball();
  uint position = 0u, end = is_wanted ? push.place_count : 0u;
  while (position < end) {
    uint leaf = 0u, descents = 0u;
    while (descents < kDescents) {
      uvec4 lower = node_vector(2u * position), upper = node_vector(2u * position + 1u);
      vec3 outside = max(max(uintBitsToFloat(lower.xyz) - centre, centre - uintBitsToFloat(upper.xyz)), vec3(0.0));
      bool meets = dot(outside, outside) < radius * radius, is_leaf = lower.w >= 1u << kFollowLeafBits;
      leaf = meets && is_leaf ? lower.w : 0u;
      position = meets && !is_leaf ? kFollowArity * lower.w : upper.w;
      if (leaf != 0u || position >= end || ++descents == kDescents) break;
    }
    test_leaf(leaf);
    if (position >= end || ++rounds >= SEARCH_ROUNDS || radius <= least_wanted) break;
  }
  is_complete = position >= end;
}

#endif
