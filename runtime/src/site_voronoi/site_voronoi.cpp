#include "medial_vk/site_voronoi.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <utility>

#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "base/parallel.h"
#include "base/voxel_order.h"
#include "site_voronoi/faces.h"
#include "site_voronoi/grid_rounding.h"
#include "site_voronoi/tile_search.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kMostVoxels = 2048;  // along a side
constexpr double kLeastSide = 1e-70;         // of the sites: fourth powers of voxels are no denormal numbers
// Voxels between the lower end of the box and that of the grid, without a simple ratio.
constexpr Point kShift = {0.3719, 0.4127, 0.2953};

Status check_options(const SiteVoronoiOptions& options) {
  if (options.resolution < 1 || options.resolution > kMostVoxels) {
    return Error{ErrorCode::kUsage, "`resolution` must be from 1 to 2048"};
  }
  if (!(options.margin >= 0 && options.margin <= kGreatestSiteCoordinate)) {
    return Error{ErrorCode::kUsage, "`margin` must be a length up to 1e75, or 0"};
  }
  return {};
}

/// Around a box with a margin; no voxel is left out at the upper end by the shift.
Result<SiteGrid> grid_around(const BvhBox& box, const SiteVoronoiOptions& options) {
  const Point across = box.upper - box.lower;
  const double longest = std::max({across[0], across[1], across[2]});
  if (!(longest >= kLeastSide)) {
    return Error{ErrorCode::kInvalidMesh,
                 "the sites are too small: the longest side of the box around them is below 1e-70"};
  }
  const double margin = options.margin > 0 ? options.margin : 0.25 * longest;
  SiteGrid grid;
  grid.side = (longest + 2 * margin) / options.resolution;
  const double magnitude = greatest_coordinate(box) + margin;
  // Voxels are cubes only if their side is many times the distance of neighbouring numbers.
  if (!(grid.side > 0x1p-40 * magnitude)) {
    return Error{ErrorCode::kInvalidMesh, "the sites are too small for the size of their coordinates"};
  }
  for (std::size_t k = 0; k < 3; ++k) {
    grid.origin[k] = box.lower[k] - margin - kShift[k] * grid.side;
    grid.size[k] = static_cast<std::uint32_t>(std::ceil((across[k] + 2 * margin) / grid.side)) + 1;
  }
  return grid;
}

class Collector {
 public:
  void add(const TileFindings& tile) {
    const std::lock_guard lock(mutex_);
    const auto append = [](auto& all, const auto& more) { all.insert(all.end(), more.begin(), more.end()); };
    append(points_, tile.points);
    append(edges_, tile.edges);
    append(voronoi_.undecided, tile.undecided);
    append(voronoi_.tied, tile.tied);
    append(voronoi_.overlapping, tile.overlapping);
    append(voronoi_.overlaps, tile.overlaps);
    std::ranges::sort(voronoi_.overlaps);
    voronoi_.overlaps.erase(std::unique(voronoi_.overlaps.begin(), voronoi_.overlaps.end()), voronoi_.overlaps.end());
    voronoi_.cells += tile.cells;
  }

  /// Throws LoopStopped.
  SiteVoronoi finish(const SiteGrid& grid, const LoopWatch& watch) {
    voronoi_.grid = grid;
    for (auto* const voxels : {&voronoi_.undecided, &voronoi_.tied, &voronoi_.overlapping}) {
      watch.check();
      std::ranges::sort(*voxels, is_earlier_voxel);
    }
    make_surface(std::move(points_), std::move(edges_), watch, voronoi_);
    return std::move(voronoi_);
  }

 private:
  std::mutex mutex_;
  std::vector<SitePoint> points_;
  std::vector<GridEdge> edges_;
  SiteVoronoi voronoi_;
};

SiteVoronoi search(const SiteForest& forest, const SiteGrid& grid, const SiteVoronoiOptions& options,
                   LoopWatch& watch) {
  std::array<std::uint32_t, 3> tiles = {};
  for (std::size_t k = 0; k < 3; ++k) tiles[k] = (grid.size[k] + TileSearch::kVoxels - 1) / TileSearch::kVoxels;
  const std::size_t count = std::size_t{tiles[0]} * tiles[1] * tiles[2];
  Collector collector;
  const double rounding = rounding_in(grid);
  parallel_for(count, 1, options.threads, [&](std::size_t i) {
    watch.check();
    TileSearch tile(forest, grid, rounding, watch);
    const std::size_t layer = std::size_t{tiles[0]} * tiles[1];
    collector.add(
        tile.search({static_cast<std::uint32_t>(i % tiles[0]), static_cast<std::uint32_t>(i % layer / tiles[0]),
                     static_cast<std::uint32_t>(i / layer)}));
    watch.finish(1, count);
  });
  return collector.finish(grid, watch);
}

}  // namespace

Result<SiteVoronoi> find_site_voronoi(std::span<const VoronoiSite> sites, const SiteVoronoiOptions& options,
                                      const ProgressCallback& progress, const std::stop_token& stop) {
  if (Status status = check_options(options); !status) return status.error();
  return catch_out_of_memory("searching between sites", [&]() -> Result<SiteVoronoi> {
    const Result<SiteForest> forest = SiteForest::build(sites, options.threads);
    if (!forest) return forest.error();
    const Result<SiteGrid> grid = grid_around(forest.value().box(), options);
    if (!grid) return grid.error();
    LoopWatch watch(progress, stop);
    try {
      return search(forest.value(), grid.value(), options, watch);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

}  // namespace medial_vk
