// Cells of an octree over the voxels of a box, named by Morton codes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/medial_spheres.h"

namespace medial_vk::any_boundary {

/// Half the diagonal of a cube, in sides: the square root of 0.75, rounded up.
inline constexpr double kHalfDiagonal = 0.8660254037844388;

using CellIndex = std::array<std::uint32_t, 3>;

/// The bits of the three coordinates, interleaved, x lowest. Coordinates below 2^21.
std::uint64_t morton_code(const CellIndex& cell);
CellIndex cell_of_code(std::uint64_t code);

/// Depth 0 is one cell that holds the grid; a cell has eight parts a depth below.
class CellGrid {
 public:
  /// At most 21 depths below the first.
  CellGrid(const Point& lower, const Point& upper, std::uint32_t resolution, std::uint32_t extra_levels);

  const VoxelGrid& voxels() const { return voxels_; }
  int voxel_depth() const { return voxel_depth_; }
  int last_depth() const { return last_depth_; }

  double side(int depth) const;
  double share_of_longest_side(int depth) const { return side(depth) / longest_side_; }
  Point centre(std::uint64_t code, int depth) const;
  /// False for cells wholly beyond the last voxels.
  bool reaches(std::uint64_t code, int depth) const;
  /// The voxel that holds a cell of `depth`, at least voxel_depth().
  std::uint64_t voxel_of(std::uint64_t code, int depth) const { return code >> (3 * (depth - voxel_depth_)); }
  bool holds(std::uint64_t voxel, const Point& p) const;
  /// Appends the parts of cells of `depth` that reach into the grid, in order.
  void add_parts(std::span<const std::uint64_t> codes, int depth, std::vector<std::uint64_t>& parts) const;

 private:
  VoxelGrid voxels_;
  double longest_side_;  // of the box
  int voxel_depth_ = 0, last_depth_ = 0;
};

}  // namespace medial_vk::any_boundary
