// For which voxels and object angles a solid is fat: medial spheres of neighbouring voxels then overlap (S. Stolpner,
// "Medial Spheres for Shape Representation", 2011, Section 8.3; docs/theory.md, "Fat solids").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// A solid is (sigma, theta)-fat if sigma is at most r_0 / sqrt(3), where r_0 is the least radius of its medial points
/// with an object angle of at least theta (Definition 8.1). This is what a sample of them says: the true r_0 may be
/// less.
struct Fatness {
  double object_angle = 0;    ///< theta, radians.
  std::uint64_t spheres = 0;  ///< Of the sample, with at least this object angle.
  double least_radius = 0;    ///< r_0 of these; 0 if there are none. In the units of the mesh.
  double largest_voxel = 0;   ///< least_radius / sqrt(3): the sample is fat for sigma up to this side of a voxel.
  /// Of the voxels of these spheres, where voxels with a common corner are joined.
  std::uint64_t components = 0;
  /// That the union of these spheres is connected, by Lemma 8.1: their voxels are, and the spheres are large enough for
  /// those of neighbouring voxels to overlap. Proved for the spheres as they are, sample or not.
  bool proves_connected = false;
};

struct FatnessOptions {
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// By each of `object_angles`. Preconditions: at most one sphere per voxel of `grid`, each in its voxel, as certified
/// spheres are. Time: n log n. Errors: kUsage (an angle that is no number), kOutOfMemory.
Result<std::vector<Fatness>> measure_fatness(std::span<const MedialSphere> spheres, const VoxelGrid& grid,
                                             std::span<const double> object_angles, const FatnessOptions& options = {});

/// No medial point in the voxels of these spheres, of any object angle, has a lesser radius; 0 if none is proved. If
/// all medial points with an object angle of at least theta lie in these voxels, as those of an extraction in mode
/// certified that leaves no voxel undecided, the solid is proved to be fat for theta and sigma up to this radius /
/// sqrt(3). Preconditions: as above; radii are no greater than the distance of the centre from the boundary.
double least_medial_radius(std::span<const MedialSphere> spheres, const VoxelGrid& grid);

}  // namespace medial_vk
