#include "plane/diagram/cell_tree.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"
#include "plane/diagram/site_lists.h"

namespace medial_vk::plane {
namespace {

constexpr std::size_t kCellsAtATime = 16;
constexpr double kLeastReach = 0x1p-38;  // near the rounding of centres

/// The part of a convex polygon where the line's height is at most 0, or with `sign` -1 at least 0. Appended.
void clip(std::span<const Vec2> polygon, const Line& line, double sign, std::vector<Vec2>& part) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double at_a = sign * line.height(a), at_b = sign * line.height(b);
    if (at_a <= 0) part.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) part.push_back(a + (at_a / (at_a - at_b)) * (b - a));
  }
}

void measure(Cell& cell) {
  Vec2 sum;
  for (const Vec2 corner : cell.corners) sum = sum + corner;
  cell.centre = (1 / static_cast<double>(cell.corners.size())) * sum;
  for (const Vec2 corner : cell.corners) cell.reach = std::max(cell.reach, distance(corner, cell.centre));
}

}  // namespace

/// Cells of one level with their corners and sites.
struct CellTree::Level {
  std::vector<Node> nodes;
  std::vector<Vec2> corners;
  std::vector<std::uint32_t> sites;

  Cell cell(const Node& node) const {
    Cell result;
    result.corners = std::span(corners).subspan(static_cast<std::size_t>(node.first_corner), node.corners);
    result.sites = std::span(sites).subspan(static_cast<std::size_t>(node.first_site), node.sites);
    measure(result);
    return result;
  }

  /// Half of a divided cell of `parents`; with fewer than three corners nothing is left of it.
  void add_child(const Level& parents, const Node& parent, double sign, SiteLists& lists) {
    Node node;
    node.first_corner = corners.size();
    node.first_site = sites.size();
    clip(parents.cell(parent).corners, parent.cut, sign, corners);
    node.corners = static_cast<std::uint32_t>(corners.size() - node.first_corner);
    node.state = CellState::kDismissed;
    if (node.corners >= 3) {
      Cell cell;
      cell.corners = std::span(corners).subspan(static_cast<std::size_t>(node.first_corner), node.corners);
      cell.sites = parents.cell(parent).sites;
      measure(cell);
      node.state = lists.find(cell, sites, node.cut);
      if (node.state == CellState::kDivided && cell.reach < kLeastReach) node.state = CellState::kClustered;
    }
    node.sites = static_cast<std::uint32_t>(sites.size() - node.first_site);
    nodes.push_back(node);
  }

  void append(const Level& part) {
    for (Node node : part.nodes) {
      node.first_corner += corners.size();
      node.first_site += sites.size();
      nodes.push_back(node);
    }
    corners.insert(corners.end(), part.corners.begin(), part.corners.end());
    sites.insert(sites.end(), part.sites.begin(), part.sites.end());
  }
};

Cell CellTree::cell(std::uint32_t node) const {
  const Node& n = nodes_[node];
  Cell result;
  result.corners = std::span(corners_).subspan(static_cast<std::size_t>(n.first_corner), n.corners);
  result.sites = std::span(sites_).subspan(static_cast<std::size_t>(n.first_site), n.sites);
  measure(result);
  return result;
}

/// Appends the nodes of a level, and corners and sites of those that are not divided further.
void CellTree::add(const Level& level, std::size_t most_cells) {
  std::size_t next = nodes_.size() + level.nodes.size();
  for (Node node : level.nodes) {
    if (node.state == CellState::kDivided && level.nodes.size() > most_cells) node.state = CellState::kClustered;
    if (node.state == CellState::kDivided) {
      node.child = static_cast<std::uint32_t>(next);
      next += 2;
    } else if (node.state != CellState::kDismissed) {
      const Cell cell = level.cell(node);
      node.first_corner = corners_.size();
      node.first_site = sites_.size();
      corners_.insert(corners_.end(), cell.corners.begin(), cell.corners.end());
      sites_.insert(sites_.end(), cell.sites.begin(), cell.sites.end());
    }
    nodes_.push_back(node);
  }
}

CellTree CellTree::build(const SiteSet& sites, const DiagramQuery& query, const LoopWatch& watch) {
  CellTree tree;
  tree.centre_ = query.centre;
  tree.half_ = query.half;
  Level level;
  level.sites.resize(sites.size());
  std::iota(level.sites.begin(), level.sites.end(), 0u);
  for (const Vec2 way : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{1, 1}, Vec2{-1, 1}}) {
    level.corners.push_back(query.centre + query.half * way);
  }
  Node root;
  root.corners = 4;
  root.sites = sites.size();
  root.cut = {{1, 0}, query.centre.x};
  level.nodes.push_back(root);
  for (;; ++tree.levels_) {
    tree.add(level, query.most_cells);
    std::vector<const Node*> divided;
    for (const Node& node : level.nodes) {
      if (node.state == CellState::kDivided && level.nodes.size() <= query.most_cells) divided.push_back(&node);
    }
    if (divided.empty()) return tree;
    std::vector<Level> parts((divided.size() + kCellsAtATime - 1) / kCellsAtATime);
    parallel_blocks(divided.size(), kCellsAtATime, query.threads, [&](std::size_t begin, std::size_t end) {
      watch.check();
      SiteLists lists(sites, query);
      Level& part = parts[begin / kCellsAtATime];
      for (std::size_t i = begin; i < end; ++i) {
        for (const double sign : {1.0, -1.0}) part.add_child(level, *divided[i], sign, lists);
      }
    });
    Level next;
    for (const Level& part : parts) next.append(part);
    level = std::move(next);
  }
}

std::uint32_t CellTree::node_at(Vec2 x) const {
  if (std::fabs(x.x - centre_.x) > half_ || std::fabs(x.y - centre_.y) > half_) return kNone;
  std::uint32_t at = 0;
  while (nodes_[at].state == CellState::kDivided) at = nodes_[at].child + (nodes_[at].cut.height(x) > 0 ? 1u : 0u);
  return at;
}

}  // namespace medial_vk::plane
