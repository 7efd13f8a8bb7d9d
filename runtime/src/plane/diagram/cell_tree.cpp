#include "plane/diagram/cell_tree.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/parallel.h"
#include "plane/diagram/site_lists.h"

namespace medial_vk::plane {
namespace {

constexpr double kLeastReach = 0x1p-38;  // near the rounding of centres

// The cells of the first levels are divided side by side; what is below one of them is built by one thread, whose sites
// then stay in its cache.
constexpr int kSharedLevels = 8;
constexpr std::size_t kSitesOfBranch = 256;  // with fewer sites a cell is not divided so

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
  double squared = 0;
  for (const Vec2 corner : cell.corners) squared = std::max(squared, dot(corner - cell.centre, corner - cell.centre));
  cell.reach = std::sqrt(squared);
}

}  // namespace

Cell CellTree::cell(std::uint32_t node) const {
  const Node& n = nodes_[node];
  Cell result;
  result.corners = std::span(corners_).subspan(static_cast<std::size_t>(n.first_corner), n.corners);
  result.sites = std::span(sites_).subspan(static_cast<std::size_t>(n.first_site), n.sites);
  measure(result);
  return result;
}

void CellTree::graft(std::uint32_t node, const CellTree& branch) {
  const auto shift = static_cast<std::uint32_t>(nodes_.size()) - 1;  // the root of the branch is not copied
  const auto placed = [&](Node n) {
    n.child += shift;
    n.first_corner += corners_.size();
    n.first_site += sites_.size();
    return n;
  };
  nodes_[node] = placed(branch.nodes_.front());
  for (std::size_t i = 1; i < branch.nodes_.size(); ++i) nodes_.push_back(placed(branch.nodes_[i]));
  corners_.insert(corners_.end(), branch.corners_.begin(), branch.corners_.end());
  sites_.insert(sites_.end(), branch.sites_.begin(), branch.sites_.end());
}

/// Builds trees below given cells. An object is used by one thread.
class CellTreeBuilder {
 public:
  using Node = CellTree::Node;
  /// A cell that is to be divided further.
  struct Open {
    std::uint32_t node = 0;
    Line cut;
    std::vector<Vec2> corners;
    std::vector<std::uint32_t> sites;
  };

  CellTreeBuilder(const SiteSet& sites, const NeededSites& needed, const DiagramQuery& query, const LoopWatch& watch)
      : lists_(sites, needed, query), watch_(watch) {}

  /// The half of a divided cell on one side of its cut; its node has corners and sites only where it is not divided.
  CellState half_of(const Open& parent, double sign, Open& half) {
    half.corners.clear();
    half.sites.clear();
    clip(parent.corners, parent.cut, sign, half.corners);
    if (half.corners.size() < 3) return CellState::kDismissed;
    Cell cell;
    cell.corners = half.corners;
    cell.sites = parent.sites;
    measure(cell);
    const CellState state = lists_.find(cell, half.sites, half.cut);
    return state == CellState::kDivided && cell.reach < kLeastReach ? CellState::kClustered : state;
  }

  /// The tree below a cell, the cell as its root.
  CellTree branch(const Open& open, std::size_t most_cells) {
    CellTree tree;
    tree.nodes_.resize(1);
    most_cells_ = most_cells;
    divide(tree, 0, open, 0);
    return tree;
  }

  static void keep(CellTree& tree, std::uint32_t node, CellState state, const Open& open) {
    Node& n = tree.nodes_[node];
    n.state = state;
    if (state == CellState::kDismissed) return;
    n.first_corner = tree.corners_.size();
    n.first_site = tree.sites_.size();
    n.corners = static_cast<std::uint32_t>(open.corners.size());
    n.sites = static_cast<std::uint32_t>(open.sites.size());
    tree.corners_.insert(tree.corners_.end(), open.corners.begin(), open.corners.end());
    tree.sites_.insert(tree.sites_.end(), open.sites.begin(), open.sites.end());
  }

  static std::uint32_t add_children(CellTree& tree, std::uint32_t node, const Line& cut) {
    const auto child = static_cast<std::uint32_t>(tree.nodes_.size());
    tree.nodes_[node].child = child;
    tree.nodes_[node].cut = cut;
    tree.nodes_.resize(tree.nodes_.size() + 2);
    return child;
  }

 private:
  void divide(CellTree& tree, std::uint32_t node, const Open& open, std::size_t depth) {
    watch_.check();
    const std::uint32_t child = add_children(tree, node, open.cut);
    if (depth == stack_.size()) stack_.push_back(std::make_unique<Open>());
    Open& half = *stack_[depth];
    for (const std::uint32_t side : {0u, 1u}) {
      CellState state = half_of(open, side == 0 ? 1 : -1, half);
      if (state == CellState::kDivided && tree.nodes_.size() > most_cells_) state = CellState::kClustered;
      if (state == CellState::kDivided) {
        divide(tree, child + side, half, depth + 1);
      } else {
        keep(tree, child + side, state, half);
      }
    }
  }

  SiteLists lists_;
  const LoopWatch& watch_;
  std::size_t most_cells_ = 0;
  std::vector<std::unique_ptr<Open>> stack_;  // by depth
};

namespace {

using Open = CellTreeBuilder::Open;

Open root_of(const NeededSites& needed, const DiagramQuery& query) {
  Open root;
  root.sites = needed.list;
  for (const Vec2 way : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{1, 1}, Vec2{-1, 1}}) {
    root.corners.push_back(query.centre + query.half * way);
  }
  root.cut = {{1, 0}, query.centre.x};
  return root;
}

}  // namespace

CellTree CellTree::build(const SiteSet& sites, const DiagramQuery& query, const LoopWatch& watch) {
  CellTree tree;
  tree.centre_ = query.centre;
  tree.half_ = query.half;
  tree.nodes_.resize(1);
  std::vector<Open> open;
  const NeededSites needed(sites, query.wanted);
  open.push_back(root_of(needed, query));
  for (int level = 0; level < kSharedLevels; ++level) {
    std::vector<Open> halves(2 * open.size());
    std::vector<CellState> states(2 * open.size(), CellState::kDivided);
    const auto is_large = [&](std::size_t i) { return open[i].sites.size() > kSitesOfBranch; };
    parallel_for(halves.size(), 1, query.threads, [&](std::size_t i) {
      watch.check();
      if (!is_large(i / 2)) return;
      states[i] = CellTreeBuilder(sites, needed, query, watch).half_of(open[i / 2], i % 2 == 0 ? 1 : -1, halves[i]);
    });
    std::vector<Open> next;
    for (std::size_t i = 0; i < open.size(); ++i) {
      if (!is_large(i)) {
        next.push_back(std::move(open[i]));
        continue;
      }
      const std::uint32_t child = CellTreeBuilder::add_children(tree, open[i].node, open[i].cut);
      for (const std::uint32_t side : {0u, 1u}) {
        Open& half = halves[2 * i + side];
        half.node = child + side;
        if (states[2 * i + side] == CellState::kDivided) {
          next.push_back(std::move(half));
        } else {
          CellTreeBuilder::keep(tree, half.node, states[2 * i + side], half);
        }
      }
    }
    open = std::move(next);
  }
  std::vector<CellTree> branches(open.size());
  parallel_for(open.size(), 1, query.threads, [&](std::size_t i) {
    const std::size_t most = query.cells_of_branch + 32 * open[i].sites.size();
    branches[i] = CellTreeBuilder(sites, needed, query, watch).branch(open[i], most);
  });
  for (std::size_t i = 0; i < open.size(); ++i) tree.graft(open[i].node, branches[i]);
  return tree;
}

std::uint32_t CellTree::node_at(Vec2 x) const {
  if (std::fabs(x.x - centre_.x) > half_ || std::fabs(x.y - centre_.y) > half_) return kNone;
  std::uint32_t at = 0;
  while (nodes_[at].state == CellState::kDivided) at = nodes_[at].child + (nodes_[at].cut.height(x) > 0 ? 1u : 0u);
  return at;
}

}  // namespace medial_vk::plane
