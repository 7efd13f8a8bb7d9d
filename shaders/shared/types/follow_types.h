// Structures and numbers that C++ and GLSL share about balls that follow a mesh (docs/theory.md, "Balls on the device").
// Lengths on the device are those of the caller times a power of two, by which the longest side of the rest pose becomes
// 1 to 2.
#ifndef MEDIAL_VK_FOLLOW_TYPES_H
#define MEDIAL_VK_FOLLOW_TYPES_H

#include "gpu_types.h"

#ifdef __cplusplus
namespace medial_vk::gpu {
#endif

// A ball and its contacts a and b. `towards`: the unit vector from a contact to the centre; w: the share of the edge from
// corner 0 to corner 1 of its triangle, v. A triangle is a position in the order of the tree.
struct FollowedBall {
  vec4 towards_a, towards_b;
  uint triangle_a;
  float w_a;  // the share of the edge from corner 0 to corner 2
  uint triangle_b;
  float w_b;
  vec4 ball;  // w: radius; 0: lost
};

// `carried`: the products of `towards` with the edges from corner 0 and with the inward normal of the triangle, in the
// frame that they belong to; w: 1 if the triangle had an area then.
struct FollowState {
  FollowedBall followed;
  vec4 carried_a, carried_b;
};

// A ball in the rest pose.
struct FollowRest {
  FollowState state;
  float through;  // radius of the ball that touches at a and passes through b
  float turn;     // cosine of the angle between the directions at both
  uint parent;    // a ball that overlaps it; itself: none
  uint index;     // its place in the order of the caller
};

// Their sizes, in vectors.
MEDIAL_VK_GPU_CONSTANT kFollowedVectors = 4u;
MEDIAL_VK_GPU_CONSTANT kStateVectors = 6u;
MEDIAL_VK_GPU_CONSTANT kRestVectors = 7u;

// Words of the lists; three lists of as many words as there are balls follow from kFollowLists on. Lists have three group
// counts each, with kFollowGroup entries for a workgroup.
MEDIAL_VK_GPU_CONSTANT kFollowRefused = 0u;  // not 0: a coordinate of this frame is not finite, or too large
MEDIAL_VK_GPU_CONSTANT kFollowAgain = 1u;    // lengths of the lists: balls that are tried in other ways, too,
MEDIAL_VK_GPU_CONSTANT kFollowRays = 2u;     // balls whose sides are decided by rays,
MEDIAL_VK_GPU_CONSTANT kFollowLost = 3u;     // balls that are to be recovered
MEDIAL_VK_GPU_CONSTANT kFollowGroups = 4u;   // group counts of the three lists
MEDIAL_VK_GPU_CONSTANT kFollowLists = 13u;
MEDIAL_VK_GPU_CONSTANT kFollowGroup = 64u;
MEDIAL_VK_GPU_CONSTANT kFollowOfImage = 0x80000000u;  // in a list: what was tried is the image of the ball at rest

// States of balls, in the order of FollowState.
MEDIAL_VK_GPU_CONSTANT kFollowMedial = 0u;
MEDIAL_VK_GPU_CONSTANT kFollowFlat = 1u;
MEDIAL_VK_GPU_CONSTANT kFollowShrunk = 2u;
MEDIAL_VK_GPU_CONSTANT kFollowIsLost = 3u;

// Where the side of a ball comes from: a ball that overlaps it, or one of these.
MEDIAL_VK_GPU_CONSTANT kFollowOutside = 0xfffffffeu;
MEDIAL_VK_GPU_CONSTANT kFollowInside = 0xffffffffu;
MEDIAL_VK_GPU_CONSTANT kMostFollowLinks = 1000u;  // from a ball to its parent, to the parent of that, and so on

MEDIAL_VK_GPU_CONSTANT kFollowLeafBits = 24u;      // a leaf: number of triangles above, the first one below
MEDIAL_VK_GPU_CONSTANT kMostFollowLeaf = 8u;
MEDIAL_VK_GPU_CONSTANT kFollowArity = 8u;          // places of children in a node
MEDIAL_VK_GPU_CONSTANT kMostFollowDepth = 16u;     // nodes above each other that balls walk together

// The longest side of a frame may be from 1/4096 to 4096 times the unit, and coordinates up to 2^20.
MEDIAL_VK_GPU_CONSTANT_FLOAT kLeastFollowSide = 0.000244140625f;
MEDIAL_VK_GPU_CONSTANT_FLOAT kMostFollowSide = 4096.0f;
MEDIAL_VK_GPU_CONSTANT_FLOAT kMostFollowCoordinate = 1048576.0f;

// Push constants of the kernels of balls.
struct FollowConstants {
  uint ball_count;
  uint place_count;     // of children in all nodes
  uint triangle_count;
  uint from_rest;       // 1: the frame before is the rest pose
  float scale;          // a length of the caller times this
  float inverse_scale;  // is one of the device times this
  float shrunk;         // share of the radius in the rest pose
  float flat_turn;      // the square of the difference of both directions at the least object angle
};

// Push constants of the kernels of the tree.
struct RefitConstants {
  uint triangle_count;
  uint first_level, end_level;  // of heights above the leaves
  float scale;
};

#ifdef __cplusplus
}  // namespace medial_vk::gpu
#endif
#endif
