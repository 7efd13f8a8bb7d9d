// Structures and numbers of the published method (Sections 2.3 and 2.4) that C++ and GLSL share.
#ifndef MEDIAL_VK_THESIS_TYPES_H
#define MEDIAL_VK_THESIS_TYPES_H

#include "gpu_types.h"

#ifdef __cplusplus
namespace medial_vk::gpu {
#endif

// A voxel of some level. Coordinates count cells of that level.
struct ThesisCell {
  uint x, y, z;
  uint flags;      // kThesis* below
  float distance;  // from the centre to the boundary
  float flux;
  uint sphere;  // its index among the spheres whose flux was measured
  uint padding;
};
MEDIAL_VK_GPU_CONSTANT kThesisPresent = 1u;    // in the grid, and not wholly outside the solid
MEDIAL_VK_GPU_CONSTANT kThesisSideKnown = 2u;  // kThesisInside gives the side of the centre
MEDIAL_VK_GPU_CONSTANT kThesisInside = 4u;

// A segment that Algorithm 1 narrows: B(p) is `contact`, B(q) is another point.
struct Retraction {
  vec4 p;  // w: 1 while the segment is active
  vec4 q;  // after the last step: the direction from q to B(q); w: object angle
  vec4 contact;
  uint voxel;   // slot of its finest voxel
  uint source;  // index of the voxel in this round * kRetractionsPerRound + sample
  uint padding_0, padding_1;
};
MEDIAL_VK_GPU_CONSTANT kRetractionsPerRound = 10u;  // samples of a voxel that are tried at a time

// Push constants. Lengths are fractions of the longest side of the bounding box.
struct ThesisConstants {
  uint items_counter;  // items of this dispatch: counters[items_counter] * items_multiplier
  uint items_multiplier;
  float cell_size;
  float voxel_size;
  float epsilon;
  float angle;        // threshold of the object angle
  float radius;       // threshold of the radius, or a number that no radius reaches
  float least_flux;   // threshold of the flux at this level
  float slack;        // bound of the rounding error of a distance
  float ball_margin;  // balls of points on a segment are made smaller by this
  uint grid_x, grid_y, grid_z;  // finest voxels along each axis
  uint voxels_per_cell;
  uint top_x, top_y;  // top cells along x and y
  uint first_cell;    // top cell with which this chunk begins
  uint level;
  uint finest;         // 1 at the finest level
  uint closed;         // 1: the boundary has no open edge
  uint narrow;         // 1: search voxels whose sphere meets the boundary too (2.4.3)
  uint samples;        // per sphere, at the finest level
  uint first_sample;   // of this round
};

// Counters, after those of gpu_types.h that the prefix sums use.
MEDIAL_VK_GPU_CONSTANT kThesisParents = 20u;      // cells whose children are examined; at the top: cells
MEDIAL_VK_GPU_CONSTANT kThesisKept = 21u;
MEDIAL_VK_GPU_CONSTANT kThesisSpheres = 22u;      // cells whose flux is measured
MEDIAL_VK_GPU_CONSTANT kThesisActive = 23u;       // finest voxels without a point
MEDIAL_VK_GPU_CONSTANT kThesisStillActive = 24u;
MEDIAL_VK_GPU_CONSTANT kThesisRetractions = 25u;
MEDIAL_VK_GPU_CONSTANT kThesisFound = 26u;
MEDIAL_VK_GPU_CONSTANT kThesisQueries = 27u;      // made one by one; those of the flux follow from the spheres
MEDIAL_VK_GPU_CONSTANT kThesisLevels = 28u;       // per level: visited, kept, spheres, and kThesisTests
MEDIAL_VK_GPU_CONSTANT kThesisCountsPerLevel = 11u;
// Up to the end of the level: kNodeTests and kTriangleTests (tree_types.h) of walks for one query, then those of packets.
MEDIAL_VK_GPU_CONSTANT kThesisTests = 3u;

#ifdef __cplusplus
}  // namespace medial_vk::gpu
#endif
#endif
