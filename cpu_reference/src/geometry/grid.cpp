#include "geometry/grid.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace medial_vk::reference {

using Eigen::Vector3d;
using Eigen::Vector3i;

Grid::Grid(const Tree& tree, int resolution) : origin(tree.lower()), levels(4) {
  voxel_size = tree.longest_side() / resolution;
  for (int a = 0; a < 3; ++a) {
    // The extent of the longest side is `resolution` voxels up to rounding, which must not add a layer.
    const double voxels = (tree.upper()[a] - tree.lower()[a]) / voxel_size;
    size[a] = std::max(1, static_cast<int>(std::ceil(voxels - 1e-9)));
  }
  // Four levels as in the source; fewer while a top-level cell would be more than half of the longest side.
  while (levels > 1 && (2 << (levels - 1)) > resolution) --levels;
}

Vector3d Grid::lower_corner(const Vector3i& cell, int level) const {
  return origin + cell_size(level) * cell.cast<double>();
}

Vector3d Grid::centre(const Vector3i& cell, int level) const {
  return origin + cell_size(level) * (cell.cast<double>() + Vector3d::Constant(0.5));
}

Vector3i Grid::voxel_of(const Vector3d& p) const { return ((p - origin) / voxel_size).array().floor().cast<int>(); }

bool Grid::holds(const Vector3i& voxel) const {
  return (voxel.array() >= 0).all() && (voxel.array() < size.array()).all();
}

bool Grid::reaches(const Vector3i& cell, int level) const {
  return ((cell.array() * (1 << (levels - 1 - level))) < size.array()).all();
}

Vector3i Grid::top_cells() const {
  const int side = 1 << (levels - 1);
  return (size.array() + (side - 1)) / side;
}

Vector3i child_of(const Vector3i& cell, int k) { return 2 * cell + Vector3i(k & 1, (k >> 1) & 1, k >> 2); }

double circumradius(double side) { return side * std::sqrt(0.75); }

Thresholds::Thresholds(const Options& options, const Grid& grid, double longest_side)
    : epsilon(options.epsilon * grid.voxel_size),
      object_angle(options.object_angle),
      radius(options.radius * longest_side),
      deep_angle(std::min(options.object_angle, options.deep_angle)) {}

}  // namespace medial_vk::reference
