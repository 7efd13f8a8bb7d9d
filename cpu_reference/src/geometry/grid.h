// The voxel grid of the output and the coarser cells above it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <tuple>
#include <vector>

#include "cpu_reference/extract.h"
#include "cpu_reference/queries.h"

namespace medial_vk::reference {

struct Grid {
  Eigen::Vector3d origin;
  double voxel_size;
  Eigen::Vector3i size;
  int levels;  // the finest is levels - 1; a cell of level k has 2^(levels - 1 - k) voxels along a side

  Grid(const Tree& tree, int resolution);

  double cell_size(int level) const { return voxel_size * (1 << (levels - 1 - level)); }
  Eigen::Vector3d lower_corner(const Eigen::Vector3i& cell, int level) const;
  Eigen::Vector3d centre(const Eigen::Vector3i& cell, int level) const;
  /// floor((p - origin) / voxel_size), the rule for readers of the output.
  Eigen::Vector3i voxel_of(const Eigen::Vector3d& p) const;
  bool holds(const Eigen::Vector3i& voxel) const;
  /// True if a cell contains a voxel of the grid: cells at the border of the grid extend beyond it.
  bool reaches(const Eigen::Vector3i& cell, int level) const;
  /// Number of top-level cells along each axis.
  Eigen::Vector3i top_cells() const;
};

/// Child number k (0 to 7) of a cell, in the numbering of the next level.
Eigen::Vector3i child_of(const Eigen::Vector3i& cell, int k);

/// Half the diagonal of a cube with this side.
double circumradius(double side);

/// Lengths and angles for both modes, computed from the fractions in the options.
struct Thresholds {
  double epsilon;       // length
  double object_angle;  // theta
  double radius;        // length, 0: off
  double deep_angle;    // theta for points with radius >= `radius`

  Thresholds(const Options& options, const Grid& grid, double longest_side);

  /// The object angle required of a point at this distance from the boundary to be salient.
  double angle_at(double distance) const { return radius > 0 && distance >= radius ? deep_angle : object_angle; }
};

/// The order of the output: z slowest, then y, then x.
template <typename OfVoxel>
void sort_by_voxel(std::vector<OfVoxel>& all) {
  const auto key = [](const OfVoxel& one) { return std::tuple(one.voxel.z(), one.voxel.y(), one.voxel.x()); };
  std::sort(all.begin(), all.end(), [&](const OfVoxel& a, const OfVoxel& b) { return key(a) < key(b); });
}

}  // namespace medial_vk::reference
