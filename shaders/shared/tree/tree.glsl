// The tree over the triangles. Before including, define TREE_STORAGE_BINDING and TREE_TEXEL_BINDING, and include
// triangles.glsl.
//
// An inner node is 4 texels, two for each child: lower corner and start, upper corner and number of triangles. A child
// with 0 triangles is the inner node at its start; otherwise it is a leaf of the triangles from there on. After all
// nodes, 8 texels follow for each with the moments of the children (winding.glsl).
#ifndef MEDIAL_VK_TREE_GLSL
#define MEDIAL_VK_TREE_GLSL
#include "tree_types.h"

layout(set = 0, binding = TREE_STORAGE_BINDING) readonly buffer TreeStorage { vec4 tree_storage[]; };
layout(set = 0, binding = TREE_TEXEL_BINDING) uniform samplerBuffer tree_texels;

vec4 tree_texel(uint i) { return kUseTexels ? texelFetch(tree_texels, int(i)) : tree_storage[i]; }
uint tree_node_count() { return (kUseTexels ? uint(textureSize(tree_texels)) : uint(tree_storage.length())) / 12u; }

// A position in the tree: an inner node, or (count << 24 | first) of a leaf.
const uint kLeaf = 1u << 24;
const uint kFirstMask = kLeaf - 1u;
const uint kSkipped = 0xfffffffeu;   // no node here, more on the stack
const uint kFinished = 0xffffffffu;  // nothing left

uint tree_position(vec4 lower, vec4 upper) { return uint(lower.w) | uint(upper.w) << 24; }
bool is_leaf(uint position) { return position >= kLeaf && position < kSkipped; }

float squared_distance_to_box(vec3 p, vec3 lower, vec3 upper) {
  vec3 outside = max(max(lower - p, p - upper), vec3(0.0));
  return dot(outside, outside);
}

// Counts of the tests that the walks of an invocation have made: boxes or moments of the tree's nodes, and triangles.
uint tested_nodes = 0u, tested_triangles = 0u;

// Every walk consists of rounds: down at most kDescents nodes, through one leaf, back over at most kPops entries of the
// stack. lavapipe ends all loops of an invocation silently after 65,535 iterations, and it counts for eight invocations
// together: an iteration counts if any of them makes it. Rounds that are bounded in each part bound the sum for any
// behaviour of the neighbours: kRounds (kDescents + kMostLeafTriangles + kPops + 1) iterations. A walk that needs more
// rounds reports that, and all triangles are examined for its query (resolve_*.comp). Loops test their condition at the
// end (for the condition at the start see docs/reliability.md, "Values that leave a loop"), and branches are replaced
// by selections: branches not taken and masked loop bodies take their full time.
const uint kDescents = 8u;
const uint kPops = 4u;
const uint kRounds = 60000u / (kDescents + kMostLeafTriangles + kPops + 1u);

#endif
