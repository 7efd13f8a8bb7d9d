// Structures and numbers that C++ and GLSL share about unions of balls.
#ifndef MEDIAL_VK_BALL_TYPES_H
#define MEDIAL_VK_BALL_TYPES_H

#include "gpu_types.h"

#ifdef __cplusplus
namespace medial_vk::gpu {
#endif

// A number as three floats of descending size, which add up to it: a double, unless it is tiny.
struct SplitBall {
  vec4 high;  // centre; w: radius
  vec4 middle;
  vec4 low;
};

// A node of the host's BallTree, with bounds rounded so that they hold if the host's do (docs/theory.md, "On the
// device").
struct BallNode {
  vec4 middle_high;  // w: radius around the middle that holds its balls; below 0 in an empty node
  vec4 middle_low;   // w: least
  vec4 axis_0;       // w: half extent of the centres along it
  vec4 axis_1;
  vec4 axis_2;
  vec4 slope;  // along the axes
};

// The kernel's results for one ball, in units of its radius.
struct MeasuredBall {
  float volume;
  float area;
  float volume_bound;  // of the errors; below 0: given up
  float area_bound;
};

// Push constants.
struct BallConstants {
  uint ball_count;
  uint first_ball;  // of this dispatch
  uint end_ball;
  uint first_leaf;  // number of the first node that is a leaf
  uint iterations;  // of loops that one invocation may run
};

MEDIAL_VK_GPU_CONSTANT kBallsPerLeaf = 4u;
// Neighbours in the order of the tree that are tested before the tree: this many on both sides.
MEDIAL_VK_GPU_CONSTANT kBallHints = 8u;
// Limits of a cell while it is cut. Corners and planes are named by bytes.
MEDIAL_VK_GPU_CONSTANT kMostCorners = 64u;
MEDIAL_VK_GPU_CONSTANT kMostPlanes = 64u;

// Balls that are smaller, with the largest coordinate or radius below 1, are left to the host: squares would underflow.
MEDIAL_VK_GPU_CONSTANT_FLOAT kLeastRadius = 5.9604645e-8f;  // 2^-24

#ifdef __cplusplus
}  // namespace medial_vk::gpu
#endif
#endif
