// A binary partition of a square into convex cells, each divided until it is dismissed, or few sites can be nearest in
// it. The sites of a cell are found among those of the cell that it is a part of (docs/theory.md, "In the plane").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/loop_watch.h"
#include "plane/diagram/diagram_query.h"

namespace medial_vk::plane {

enum class CellState : std::uint8_t {
  kDivided,
  kDismissed,  ///< No wanted point lies in the cell.
  kLeaf,       ///< At most kLeafSites sites can be nearest.
  kClustered   ///< More, and the cell is as small as cells become: all its sites are taken to be equally far.
};

/// The points x with normal x = value.
struct Line {
  Vec2 normal;  ///< Unit.
  double value = 0;

  double height(Vec2 x) const { return dot(normal, x) - value; }
};

/// A convex polygon, and the sites that can be nearest to its points.
struct Cell {
  std::span<const Vec2> corners;  ///< Counter-clockwise.
  std::span<const std::uint32_t> sites;
  Vec2 centre;       ///< The mean of the corners.
  double reach = 0;  ///< The greatest distance of a corner from it.
};

class CellTree {
 public:
  static constexpr std::size_t kLeafSites = 8;

  /// Throws std::bad_alloc and LoopStopped.
  static CellTree build(const SiteSet& sites, const DiagramQuery& query, const LoopWatch& watch);

  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  CellState state(std::uint32_t node) const { return nodes_[node].state; }
  /// Of a leaf or a cluster.
  Cell cell(std::uint32_t node) const;
  /// The undivided cell that holds x; kNone outside of the square.
  std::uint32_t node_at(Vec2 x) const;

  static constexpr std::uint32_t kNone = ~0u;

 private:
  friend class CellTreeBuilder;
  struct Node {
    CellState state = CellState::kDivided;
    std::uint32_t child = 0;  // the first of two: where the cut's height is negative
    Line cut;
    std::uint64_t first_corner = 0, first_site = 0;  // of cells that are not divided
    std::uint32_t corners = 0, sites = 0;
  };
  /// The parts of another tree below `node`, whose root takes its place.
  void graft(std::uint32_t node, const CellTree& branch);

  std::vector<Node> nodes_;  // the root first
  std::vector<Vec2> corners_;
  std::vector<std::uint32_t> sites_;
  Vec2 centre_;
  double half_ = 0;
};

}  // namespace medial_vk::plane
