#include "any_boundary/cell_grid.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk::any_boundary {
namespace {

constexpr int kMostDepths = 21;

/// Moves bit i to bit 3 i.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x1f00000000ffffull;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffull;
  bits = (bits | bits << 8) & 0x100f00f00f00f00full;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ull;
  return (bits | bits << 2) & 0x1249249249249249ull;
}

std::uint32_t gather(std::uint64_t bits) {
  bits &= 0x1249249249249249ull;
  bits = (bits | bits >> 2) & 0x10c30c30c30c30c3ull;
  bits = (bits | bits >> 4) & 0x100f00f00f00f00full;
  bits = (bits | bits >> 8) & 0x1f0000ff0000ffull;
  bits = (bits | bits >> 16) & 0x1f00000000ffffull;
  return static_cast<std::uint32_t>(bits | bits >> 32);
}

}  // namespace

std::uint64_t morton_code(const CellIndex& cell) {
  return spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2;
}

CellIndex cell_of_code(std::uint64_t code) { return {gather(code), gather(code >> 1), gather(code >> 2)}; }

CellGrid::CellGrid(const Point& lower, const Point& upper, std::uint32_t resolution, std::uint32_t extra_levels) {
  const Point extent = upper - lower;
  voxels_.origin = lower;
  longest_side_ = std::max({extent[0], extent[1], extent[2]});
  voxels_.voxel_size = longest_side_ / resolution;
  for (std::size_t k = 0; k < 3; ++k) {
    // The longest side is `resolution` voxels up to rounding, which must not add a layer.
    voxels_.size[k] = static_cast<std::uint32_t>(std::max(1.0, std::ceil(extent[k] / voxels_.voxel_size - 1e-9)));
  }
  while ((1u << voxel_depth_) < *std::max_element(voxels_.size.begin(), voxels_.size.end())) ++voxel_depth_;
  last_depth_ = std::min(voxel_depth_ + static_cast<int>(extra_levels), kMostDepths);
}

double CellGrid::side(int depth) const { return std::ldexp(voxels_.voxel_size, voxel_depth_ - depth); }

Point CellGrid::centre(std::uint64_t code, int depth) const {
  const CellIndex cell = cell_of_code(code);
  Point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = voxels_.origin[k] + side(depth) * (cell[k] + 0.5);
  return p;
}

bool CellGrid::reaches(std::uint64_t code, int depth) const {
  const CellIndex cell = cell_of_code(code);
  const int finer = depth - voxel_depth_;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint64_t first_voxel = finer > 0 ? cell[k] >> finer : std::uint64_t{cell[k]} << -finer;
    if (first_voxel >= voxels_.size[k]) return false;
  }
  return true;
}

void CellGrid::add_parts(std::span<const std::uint64_t> codes, int depth, std::vector<std::uint64_t>& parts) const {
  for (const std::uint64_t cell : codes) {
    for (std::uint64_t part = 0; part < 8; ++part) {
      const std::uint64_t code = cell << 3 | part;
      if (reaches(code, depth + 1)) parts.push_back(code);
    }
  }
}

bool CellGrid::holds(std::uint64_t voxel, const Point& p) const {
  const CellIndex index = cell_of_code(voxel);
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::floor((p[k] - voxels_.origin[k]) / voxels_.voxel_size) != index[k]) return false;
  }
  return true;
}

}  // namespace medial_vk::any_boundary
