#include "site_voronoi/tile_search.h"

#include <algorithm>
#include <utility>

namespace medial_vk {
namespace {

// Near-coincident sites leave most voxels to be divided as far as allowed. So a tile has so many cells for divisions,
// and voxels that are searched after these are used up have few. Tiles are searched in one order by one thread each.
constexpr std::uint64_t kCellsOfATile = 4000, kMoreForEachVoxel = 8;
constexpr std::uint64_t kMostCellsOfAVoxel = 4000, kFewCellsOfAVoxel = 64;

}  // namespace

TileFindings TileSearch::search(const std::array<std::uint32_t, 3>& tile) {
  for (std::size_t k = 0; k < 3; ++k) first_[k] = kVoxels * tile[k];
  searched_ = divisions_ = 0;
  labels_.assign(std::size_t{kCorners} * kCorners * kCorners, kUnknown);
  const std::uint64_t before = stack_.narrowed();
  const CellRange all = stack_.whole();
  visit(all, first_, kVoxels);
  stack_.drop(all);
  found_.cells = stack_.narrowed() - before;
  return std::exchange(found_, {});
}

/// A cube of so many voxels along its side.
void TileSearch::visit(const CellRange& outer, const std::array<std::uint32_t, 3>& voxel, std::uint32_t voxels) {
  const double half = 0.5 * voxels * grid_.side;
  const SiteCell cell = {grid_.corner(voxel) + Point{half, half, half}, half};
  const CellRange sites = stack_.narrow(outer, cell);
  if (sites.count() > 1 && voxels == 1) search_voxel(sites, cell, voxel);
  if (sites.count() > 1 && voxels > 1) {
    for (unsigned i = 0; i < 8; ++i) {
      std::array<std::uint32_t, 3> child = voxel;
      bool is_in_grid = true;
      for (std::size_t k = 0; k < 3; ++k) {
        child[k] += ((i >> k) & 1u) != 0 ? voxels / 2 : 0;
        is_in_grid = is_in_grid && child[k] < grid_.size[k];
      }
      if (is_in_grid) visit(sites, child, voxels / 2);
    }
  }
  stack_.drop(sites);
}

/// The nearest site to a corner is among those of each voxel that has it.
std::uint32_t TileSearch::label_of(const CellRange& sites, const std::array<std::uint32_t, 3>& corner) {
  std::size_t index = 0;
  for (std::size_t k = 3; k-- > 0;) index = index * kCorners + (corner[k] - first_[k]);
  std::uint32_t& label = labels_[index];
  if (label == kUnknown) {
    stack_.measure(sites, grid_.corner(corner), distances_);
    label = distances_.front().site;
  }
  return label;
}

std::uint32_t TileSearch::most_cells() const {
  const std::uint64_t allowed = kCellsOfATile + kMoreForEachVoxel * searched_;
  const std::uint64_t left = allowed - std::min(allowed, divisions_);
  return static_cast<std::uint32_t>(std::clamp(left, kFewCellsOfAVoxel, kMostCellsOfAVoxel));
}

void TileSearch::search_voxel(const CellRange& sites, const SiteCell& cell, const std::array<std::uint32_t, 3>& voxel) {
  watch_.check();
  ++searched_;
  std::array<std::uint32_t, 8> labels = {};
  for (unsigned i = 0; i < 8; ++i) {
    std::array<std::uint32_t, 3> corner = voxel;
    for (std::size_t k = 0; k < 3; ++k) corner[k] += (i >> k) & 1u;
    labels[i] = label_of(sites, corner);
  }
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t upper = labels[std::size_t{1} << axis];
    if (upper != labels[0]) found_.edges.push_back({voxel, axis, {labels[0], upper}});
  }
  const VoxelOutcome outcome = points_.search(sites, cell, labels, most_cells());
  divisions_ += points_.cells();
  const auto& overlaps = points_.overlaps();
  found_.overlaps.insert(found_.overlaps.end(), overlaps.begin(), overlaps.end());
  switch (outcome) {
    case VoxelOutcome::kPoint:
      found_.points.push_back(points_.point());
      found_.points.back().voxel = voxel;
      break;
    case VoxelOutcome::kUndecided:
      found_.undecided.push_back(voxel);
      break;
    case VoxelOutcome::kTied:
      found_.tied.push_back(voxel);
      break;
    case VoxelOutcome::kOverlapping:
      found_.overlapping.push_back(voxel);
      break;
    case VoxelOutcome::kEmpty:
      break;
  }
}

}  // namespace medial_vk
