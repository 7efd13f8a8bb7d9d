// Triangles around each point of a surface, seen along its normal: they may touch, but not overlap.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sheets/tangent_frame.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {

/// Sectors between two neighbours of a point, by place.
class TriangleFans {
 public:
  explicit TriangleFans(const VoxelGraph& graph);

  /// Is there room at corner `at` for a triangle with corners `a` and `b` beside it?
  bool has_room(std::uint32_t at, std::uint32_t a, std::uint32_t b) const;
  void add(std::uint32_t at, std::uint32_t a, std::uint32_t b);

 private:
  struct Sector {
    double start, extent;  ///< Counter-clockwise, the extent below pi.
  };
  Sector sector(std::uint32_t at, std::uint32_t a, std::uint32_t b) const;

  const VoxelGraph& graph_;
  std::vector<TangentFrame> frames_;
  std::vector<std::vector<Sector>> sectors_;
};

}  // namespace medial_vk
