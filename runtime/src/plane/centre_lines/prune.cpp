#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>
#include <vector>

#include "base/host_memory.h"
#include "medial_vk/plane_centre_line.h"
#include "plane/centre_lines/kept_arcs.h"

namespace medial_vk {
namespace plane {
namespace {

enum class Measure : std::uint8_t { kLength, kSignificance };

/// A fire that begins at the free ends and burns along branches with unit speed. At a junction it waits for those of
/// all branches but one, and goes on along that one with the latest time.
class Pruner {
 public:
  explicit Pruner(const PlaneAxis& axis)
      : axis_(axis),
        degree_(axis.nodes.size()),
        time_(axis.nodes.size()),
        branches_at_(axis.nodes.size()),
        is_there_(axis.branches.size(), true),
        is_last_(axis.nodes.size()) {
    for (std::uint32_t b = 0; b < axis.branches.size(); ++b) {
      for (const std::uint32_t end : axis.branches[b].ends) {
        ++degree_[end];
        branches_at_[end].push_back(b);
      }
    }
  }

  void remove_below(double least, Measure measure) {
    const auto radius = [&](std::uint32_t n) { return measure == Measure::kLength ? 0 : axis_.nodes[n].radius; };
    for (std::uint32_t n = 0; n < time_.size(); ++n) time_[n] = radius(n);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto offer_at = [&](std::uint32_t node) {
      if (degree_[node] != 1 || axis_.nodes[node].kind == AxisNodeKind::kBorder) return;
      const std::uint32_t b = *std::ranges::find_if(branches_at_[node], [&](std::uint32_t i) { return is_there_[i]; });
      queue.emplace(time_[node] + axis_.branches[b].length - radius(other_end(b, node)), b, node);
    };
    for (std::uint32_t n = 0; n < time_.size(); ++n) offer_at(n);
    while (!queue.empty() && std::get<0>(queue.top()) < least) {
      const auto [value, b, from] = queue.top();
      queue.pop();
      if (!is_there_[b]) continue;  // it burned from its other end
      const std::uint32_t to = other_end(b, from);
      is_there_[b] = false;
      time_[to] = std::max(time_[to], time_[from] + axis_.branches[b].length);
      --degree_[from];
      if (--degree_[to] == 0) is_last_[to] = true;
      offer_at(to);
    }
  }

  PlaneAxis rest() const {
    std::vector<bool> kept(axis_.arcs.size());
    for (std::size_t b = 0; b < axis_.branches.size(); ++b) {
      for (const std::uint32_t arc : axis_.branches[b].arcs) kept[arc] = is_there_[b];
    }
    return axis_of_arcs(axis_, kept, is_last_);
  }

 private:
  using Entry = std::tuple<double, std::uint32_t, std::uint32_t>;  // what counts, the branch, its free end

  std::uint32_t other_end(std::uint32_t branch, std::uint32_t node) const {
    const auto& [a, b] = axis_.branches[branch].ends;
    return a == node ? b : a;
  }

  const PlaneAxis& axis_;
  std::vector<std::uint32_t> degree_;  // by node, of what is there
  std::vector<double> time_;           // by node, when the fire leaves it
  std::vector<std::vector<std::uint32_t>> branches_at_;
  std::vector<bool> is_there_;  // by branch
  std::vector<bool> is_last_;   // by node: all that is left of its part
};

}  // namespace
}  // namespace plane

bool is_end_branch(const PlaneAxis& axis, const AxisBranch& branch) {
  return std::ranges::any_of(branch.ends, [&](std::uint32_t n) { return plane::is_free_end(axis.nodes[n]); });
}

double significance_of(const PlaneAxis& axis, const AxisBranch& branch) {
  const AxisNode &a = axis.nodes[branch.ends[0]], &b = axis.nodes[branch.ends[1]];
  const double from_a = branch.length + a.radius - b.radius, from_b = branch.length + b.radius - a.radius;
  if (plane::is_free_end(a) && plane::is_free_end(b)) return std::min(from_a, from_b);
  return plane::is_free_end(a) ? from_a : from_b;
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
    return pruner.rest();
  });
}

}  // namespace medial_vk
