// Structures and numbers that C++ and GLSL share about the tree and the queries that walk it.
#ifndef MEDIAL_VK_TREE_TYPES_H
#define MEDIAL_VK_TREE_TYPES_H

#include "gpu_types.h"

#ifdef __cplusplus
namespace medial_vk::gpu {
#endif

MEDIAL_VK_GPU_CONSTANT kMostLeafTriangles = 8u;  // triangles in a leaf
MEDIAL_VK_GPU_CONSTANT kStackSize = 48u;         // Bvh::kMaxDepth: a walk leaves one child behind per level

// Push constants of the kernels that answer queries.
struct QueryConstants {
  uint items;             // queries, if items_counter is kNoCounter
  uint items_counter;     // else counters[items_counter] * items_multiplier
  uint items_multiplier;
  uint triangle_count;
  float tolerance;        // of winding numbers
  uint first_group;       // workgroups that earlier dispatches have run
};

// Words of the list of queries whose walk was given up; the indices of the queries follow from kUnresolvedFirst on.
MEDIAL_VK_GPU_CONSTANT kUnresolvedWaiting = 0u;  // their number, while the list grows
MEDIAL_VK_GPU_CONSTANT kUnresolvedGroups = 1u;   // three group counts, one workgroup for each
MEDIAL_VK_GPU_CONSTANT kUnresolvedCount = 4u;    // their number, once it has been prepared
MEDIAL_VK_GPU_CONSTANT kUnresolvedTotal = 5u;    // since creation
MEDIAL_VK_GPU_CONSTANT kNodeTests = 6u;          // since creation, where tests are counted: low word, high word
MEDIAL_VK_GPU_CONSTANT kTriangleTests = 8u;      // likewise
MEDIAL_VK_GPU_CONSTANT kUnresolvedFirst = 10u;

// Push constants of the kernels around the flux through spheres.
struct SampleConstants {
  uint items;            // spheres, if items_counter is kNoCounter
  uint items_counter;    // else counters[items_counter]
  uint samples;          // per sphere
  float same_direction;  // directions that differ by less count as the same
};

#ifdef __cplusplus
}  // namespace medial_vk::gpu
#endif
#endif
