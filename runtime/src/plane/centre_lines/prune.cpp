#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

#include "base/host_memory.h"
#include "medial_vk/plane_centre_line.h"
#include "plane/centre_lines/kept_arcs.h"

namespace medial_vk {
namespace plane {
namespace {

/// A branch, or two that became one.
struct Piece {
  std::array<std::uint32_t, 2> ends = {};
  double length = 0;
  std::array<std::uint32_t, 2> halves = {};  ///< Pieces, from the number of branches on.
  bool is_there = true;
};

enum class Measure : std::uint8_t { kLength, kSignificance };

class Pruner {
 public:
  explicit Pruner(const PlaneAxis& axis) : axis_(axis), degree_(axis.nodes.size()), pieces_at_(axis.nodes.size()) {
    pieces_.reserve(2 * axis.branches.size());
    for (const AxisBranch& branch : axis.branches) pieces_.push_back({branch.ends, branch.length});
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
      for (const std::uint32_t end : pieces_[p].ends) {
        ++degree_[end];
        pieces_at_[end].push_back(p);
      }
    }
  }

  void remove_below(double least, Measure measure) {
    Queue queue;
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) offer(p, measure, queue);
    while (!queue.empty() && std::get<0>(queue.top()) < least) {
      const std::uint32_t p = std::get<1>(queue.top());
      queue.pop();
      if (!pieces_[p].is_there || !is_end_piece(p)) continue;
      const std::uint32_t junction = pieces_[p].ends[free_end(p) == 0 ? 1 : 0];
      pieces_[p].is_there = false;
      if (--degree_[junction] == 2) join(junction, measure, queue);
    }
  }

  std::vector<bool> kept_arcs() const {
    std::vector<bool> kept(axis_.arcs.size());
    std::vector<std::uint32_t> open;
    for (std::uint32_t p = 0; p < pieces_.size(); ++p) {
      if (pieces_[p].is_there) open.push_back(p);
    }
    while (!open.empty()) {
      const std::uint32_t p = open.back();
      open.pop_back();
      if (p < axis_.branches.size()) {
        for (const std::uint32_t arc : axis_.branches[p].arcs) kept[arc] = true;
      } else {
        open.insert(open.end(), pieces_[p].halves.begin(), pieces_[p].halves.end());
      }
    }
    return kept;
  }

 private:
  /// The lowest measure first, of equal ones the piece that came first.
  using Entry = std::tuple<double, std::uint32_t>;
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

  bool is_free(std::uint32_t node) const {
    return degree_[node] == 1 && axis_.nodes[node].kind != AxisNodeKind::kBorder;
  }
  std::size_t free_end(std::uint32_t p) const { return is_free(pieces_[p].ends[0]) ? 0 : 1; }

  bool is_end_piece(std::uint32_t p) const {
    const auto& [a, b] = pieces_[p].ends;
    return (is_free(a) && degree_[b] >= 3) || (is_free(b) && degree_[a] >= 3);
  }

  void offer(std::uint32_t p, Measure measure, Queue& queue) const {
    if (!pieces_[p].is_there || !is_end_piece(p)) return;
    double value = pieces_[p].length;
    if (measure == Measure::kSignificance) {
      const std::size_t end = free_end(p);
      value += axis_.nodes[pieces_[p].ends[end]].radius - axis_.nodes[pieces_[p].ends[1 - end]].radius;
    }
    queue.emplace(value, p);
  }

  /// The two pieces at a node become one; a loop stays as it is.
  void join(std::uint32_t node, Measure measure, Queue& queue) {
    std::array<std::uint32_t, 2> two = {};
    std::size_t count = 0;
    for (const std::uint32_t p : pieces_at_[node]) {
      if (pieces_[p].is_there && count < 2) two[count++] = p;
    }
    if (count < 2 || two[0] == two[1]) return;
    std::array<std::uint32_t, 2> ends = {};
    for (std::size_t k = 0; k < 2; ++k) {
      Piece& half = pieces_[two[k]];
      ends[k] = half.ends[half.ends[0] == node ? 1 : 0];
      half.is_there = false;
    }
    const auto joined = static_cast<std::uint32_t>(pieces_.size());
    pieces_.push_back({ends, pieces_[two[0]].length + pieces_[two[1]].length, two});
    for (const std::uint32_t end : ends) pieces_at_[end].push_back(joined);
    offer(joined, measure, queue);
  }

  const PlaneAxis& axis_;
  std::vector<std::uint32_t> degree_;                  // by node, of what is there
  std::vector<std::vector<std::uint32_t>> pieces_at_;  // by node, with those that are not there any more
  std::vector<Piece> pieces_;
};

}  // namespace
}  // namespace plane

bool is_end_branch(const PlaneAxis& axis, const AxisBranch& branch) {
  const AxisNode &a = axis.nodes[branch.ends[0]], &b = axis.nodes[branch.ends[1]];
  return (plane::is_free_end(a) && b.degree >= 3) || (plane::is_free_end(b) && a.degree >= 3);
}

double significance_of(const PlaneAxis& axis, const AxisBranch& branch) {
  const AxisNode &a = axis.nodes[branch.ends[0]], &b = axis.nodes[branch.ends[1]];
  return branch.length + (plane::is_free_end(a) ? a.radius - b.radius : b.radius - a.radius);
}

Result<PlaneAxis> prune_plane_axis(const PlaneAxis& axis, const PlanePruning& pruning) {
  for (const double least : {pruning.length, pruning.significance}) {
    if (!(least >= 0 && std::isfinite(least))) {
      return Error{ErrorCode::kUsage, "the least length and significance of a branch must be lengths, or 0"};
    }
  }
  return catch_out_of_memory("pruning an axis", [&]() -> Result<PlaneAxis> {
    plane::Pruner pruner(axis);
    if (pruning.length > 0) pruner.remove_below(pruning.length, plane::Measure::kLength);
    if (pruning.significance > 0) pruner.remove_below(pruning.significance, plane::Measure::kSignificance);
    return plane::axis_of_arcs(axis, pruner.kept_arcs());
  });
}

}  // namespace medial_vk
