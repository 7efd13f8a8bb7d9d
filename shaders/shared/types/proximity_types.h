// Structures and numbers that C++ and GLSL share about distances between bodies.
#ifndef MEDIAL_VK_PROXIMITY_TYPES_H
#define MEDIAL_VK_PROXIMITY_TYPES_H

#include "gpu_types.h"

#ifdef __cplusplus
namespace medial_vk::gpu {
#endif

MEDIAL_VK_GPU_CONSTANT kProximityWidth = 8u;
MEDIAL_VK_GPU_CONSTANT kProximityLevels = 8u;  // of nodes, at most: 8^8 balls
MEDIAL_VK_GPU_CONSTANT kProximityNodeBits = 28u;

// A node of the host's NodeTree.
struct ProximityNode {
  vec4 balls[kProximityWidth];  // w: radius; of an unused slot below 0
  uint below[kProximityWidth];  // index of a node or, on the lowest level, of a ball of the set
};

// The balls of a set.
struct ProximityTree {
  uint root;
  uint levels;  // of nodes; 0: no balls
  float reach;  // no point of a ball is farther from the origin
  uint unused;
};

struct ProximityBody {
  ProximityTree inside;
  ProximityTree cover;
  vec4 centre;  // the origin of the trees, to the nearest float
};

// Layout of RecordedPose. A pose from the host has the bit kProximityCentred in `a`: it is between the origins of the
// trees, and has the errors of separations. All others are between the frames of the bodies.
struct ProximityPose {
  vec4 row_x, row_y, row_z;  // of the rotation; w: of the shift
  uint a, b;
  float inside_error, cover_error;
};
MEDIAL_VK_GPU_CONSTANT kProximityCentred = 0x80000000u;

// Layout of RecordedBounds.
struct ProximityBounds {
  float lower, upper;
  uint cover_a, cover_b;
  uint inside_a, inside_b;
};

// Verdicts, in the order of Collision, and one for poses that are left to the host.
MEDIAL_VK_GPU_CONSTANT kProximityFree = 0u;
MEDIAL_VK_GPU_CONSTANT kProximityHit = 1u;
MEDIAL_VK_GPU_CONSTANT kProximityUndecided = 2u;
MEDIAL_VK_GPU_CONSTANT kProximityGivenUp = 3u;

// Push constants.
struct ProximityConstants {
  uint pose_count;
  uint body_count;
  uint most_steps;   // comparisons of nodes that one search may make
  uint leaves_rest;  // 1: where they do not suffice, the verdict is kProximityGivenUp, or the lower bound -1
};

#ifdef __cplusplus
}  // namespace medial_vk::gpu
#endif
#endif
