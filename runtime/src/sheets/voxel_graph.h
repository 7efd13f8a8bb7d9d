// The graph of medial points in voxels that touch: the 26-neighbourhood of Section 2.5.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// Points are identified by their position in voxel order (z slowest, then y, then x), for any order of the input.
/// Parameters named `position` are such positions.
class VoxelGraph {
 public:
  /// Precondition: at most one sphere per voxel; coordinates of voxels below 2^20.
  explicit VoxelGraph(std::span<const MedialSphere> spheres, unsigned threads = 0);

  std::uint32_t size() const { return static_cast<std::uint32_t>(order_.size()); }
  const MedialSphere& sphere(std::uint32_t position) const { return spheres_[order_[position]]; }
  /// The index of the point in the input.
  std::uint32_t index(std::uint32_t position) const { return order_[position]; }
  /// Positions of the points in the 26 voxels around, ascending.
  std::span<const std::uint32_t> neighbours(std::uint32_t position) const {
    return {neighbours_.data() + starts_[position], starts_[position + 1] - starts_[position]};
  }
  /// True if the voxels of the two touch.
  bool touch(std::uint32_t a, std::uint32_t b) const;

 private:
  std::span<const MedialSphere> spheres_;
  std::vector<std::uint32_t> order_;
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> neighbours_;
};

}  // namespace medial_vk
