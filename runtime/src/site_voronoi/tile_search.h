// The search in a tile: a cube of voxels, divided like an octree.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/loop_watch.h"
#include "site_voronoi/grid_rounding.h"
#include "site_voronoi/point_search.h"

namespace medial_vk {

/// An edge of the grid between two corners with different nearest sites.
struct GridEdge {
  std::array<std::uint32_t, 3> voxel = {};  ///< Its lower corner is that of this voxel.
  std::uint32_t axis = 0;
  std::array<std::uint32_t, 2> sites = {};  ///< Nearest at the lower and at the upper corner.
};

struct TileFindings {
  std::vector<SitePoint> points;
  std::vector<GridEdge> edges;
  std::vector<std::array<std::uint32_t, 3>> undecided, tied, overlapping;
  std::vector<std::array<std::uint32_t, 2>> overlaps;
  std::uint64_t cells = 0;
};

class TileSearch {
 public:
  static constexpr std::uint32_t kVoxels = kVoxelsOfATile;  ///< Along a side of a tile.

  TileSearch(const SiteForest& forest, const SiteGrid& grid, double rounding, const LoopWatch& watch)
      : grid_(grid), watch_(watch), stack_(forest, rounding), points_(forest, stack_) {}

  /// The tile whose lowest voxel is kVoxels times `tile`. Throws LoopStopped.
  TileFindings search(const std::array<std::uint32_t, 3>& tile);

 private:
  static constexpr std::uint32_t kCorners = kVoxels + 1;
  static constexpr std::uint32_t kUnknown = 0xffffffffu;

  void visit(const CellRange& outer, const std::array<std::uint32_t, 3>& voxel, std::uint32_t voxels);
  void search_voxel(const CellRange& sites, const SiteCell& cell, const std::array<std::uint32_t, 3>& voxel);
  std::uint32_t label_of(const CellRange& sites, const std::array<std::uint32_t, 3>& corner);

  std::uint32_t most_cells() const;

  const SiteGrid& grid_;
  const LoopWatch& watch_;
  CellStack stack_;
  PointSearch points_;
  std::array<std::uint32_t, 3> first_ = {};
  std::vector<std::uint32_t> labels_;  // of the corners of the tile's voxels, once they are known
  std::vector<SiteDistance> distances_;
  std::uint64_t searched_ = 0, divisions_ = 0;  // voxels of the tile, and cells that they were divided into
  TileFindings found_;
};

}  // namespace medial_vk
