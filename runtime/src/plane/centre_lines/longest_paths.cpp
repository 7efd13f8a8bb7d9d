#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <span>
#include <utility>

#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "medial_vk/plane_centre_line.h"
#include "plane/centre_lines/kept_arcs.h"

namespace medial_vk {
namespace plane {
namespace {

constexpr std::uint32_t kNone = ~0u;
constexpr double kUnreached = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kMostSteps = 100'000'000;  // of all searches from ends of one part, some ten seconds

/// The branches as a graph, and shortest paths in it from one node at a time.
class BranchGraph {
 public:
  BranchGraph(const PlaneAxis& axis, const LoopWatch& watch)
      : axis_(axis),
        watch_(watch),
        first_(axis.nodes.size() + 1),
        at_(2 * axis.branches.size()),
        distance_(axis.nodes.size(), kUnreached),
        by_(axis.nodes.size()) {
    for (const AxisBranch& branch : axis.branches) {
      for (const std::uint32_t end : branch.ends) ++first_[end + 1];
    }
    for (std::size_t n = 0; n < axis.nodes.size(); ++n) first_[n + 1] += first_[n];
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t b = 0; b < axis.branches.size(); ++b) {
      for (const std::uint32_t end : axis.branches[b].ends) at_[next[end]++] = b;
    }
  }

  /// Sets the distances of all nodes of the part that `start` is in.
  void search(std::uint32_t start) {
    watch_.check();
    for (const std::uint32_t node : reached_) distance_[node] = kUnreached;
    reached_.clear();
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    const auto reach = [&](std::uint32_t node, double distance, std::uint32_t branch) {
      if (distance >= distance_[node]) return;
      if (distance_[node] == kUnreached) reached_.push_back(node);
      distance_[node] = distance;
      by_[node] = branch;
      queue.emplace(distance, node);
    };
    reach(start, 0, kNone);
    while (!queue.empty()) {
      const auto [distance, node] = queue.top();
      queue.pop();
      if (distance > distance_[node]) continue;
      for (std::size_t i = first_[node]; i < first_[node + 1]; ++i) {
        ++steps_;
        reach(other_end(at_[i], node), distance + axis_.branches[at_[i]].length, at_[i]);
      }
    }
  }

  double distance(std::uint32_t node) const { return distance_[node]; }
  const std::vector<std::uint32_t>& reached() const { return reached_; }
  std::uint64_t steps() const { return steps_; }
  std::size_t degree(std::uint32_t node) const { return first_[node + 1] - first_[node]; }

  std::span<const std::uint32_t> branches_at(std::uint32_t node) const {
    return std::span(at_).subspan(first_[node], degree(node));
  }

  /// The branches from a node back to the start.
  std::vector<std::uint32_t> path_to(std::uint32_t node) const {
    std::vector<std::uint32_t> path;
    while (by_[node] != kNone) {
      path.push_back(by_[node]);
      node = other_end(by_[node], node);
    }
    return path;
  }

  std::uint32_t other_end(std::uint32_t branch, std::uint32_t node) const {
    const auto& [a, b] = axis_.branches[branch].ends;
    return a == node ? b : a;
  }

 private:
  using Entry = std::pair<double, std::uint32_t>;

  const PlaneAxis& axis_;
  const LoopWatch& watch_;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> at_;
  std::vector<double> distance_;
  std::vector<std::uint32_t> by_;  // the branch by which a node was reached
  std::vector<std::uint32_t> reached_;
  std::uint64_t steps_ = 0;
};

/// The longest shortest path between two ends of one part of the axis.
class LongestPath {
 public:
  /// `ends` are two or more.
  LongestPath(BranchGraph& graph, std::vector<std::uint32_t> ends, bool is_tree)
      : graph_(graph), ends_(std::move(ends)) {
    graph_.search(ends_.front());
    take(farthest());
    const std::uint32_t far = farthest();
    graph_.search(far);
    take(farthest());
    if (!is_tree) examine_others(far);
  }

  const std::vector<std::uint32_t>& path() const { return path_; }
  double excess() const { return excess_; }

 private:
  std::uint32_t farthest() const {
    return *std::ranges::max_element(ends_, {}, [&](std::uint32_t e) { return graph_.distance(e); });
  }

  void take(std::uint32_t end) {
    if (graph_.distance(end) <= length_) return;
    length_ = graph_.distance(end);
    path_ = graph_.path_to(end);
  }

  /// Two ends are no farther apart than the sum of their distances from any one node: with the middle of a long path as
  /// that node, few ends can belong to a longer one.
  void examine_others(std::uint32_t start) {
    graph_.search(middle_from(start));
    std::vector<std::pair<double, std::uint32_t>> order;
    order.reserve(ends_.size());
    for (const std::uint32_t end : ends_) order.emplace_back(graph_.distance(end), end);
    std::ranges::sort(order, std::greater<>());
    const std::uint64_t begin = graph_.steps();
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
      const double most = order[i].first + order[i + 1].first;  // of this end and all that follow
      if (most <= length_) return;
      if (graph_.steps() - begin > kMostSteps) {
        excess_ = most - length_;
        return;
      }
      graph_.search(order[i].second);
      take(farthest());
    }
  }

  /// The node of the path nearest to its middle. The last search was from `start`, an end of the path.
  std::uint32_t middle_from(std::uint32_t start) const {
    std::uint32_t best = start, node = farthest();
    for (const std::uint32_t branch : graph_.path_to(node)) {
      node = graph_.other_end(branch, node);
      const auto off = [&](std::uint32_t n) { return std::fabs(graph_.distance(n) - length_ / 2); };
      if (off(node) < off(best)) best = node;
    }
    return best;
  }

  BranchGraph& graph_;
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint32_t> path_;
  double length_ = 0, excess_ = 0;
};

PlaneLongestPaths longest_paths(const PlaneAxis& axis, const LoopWatch& watch) {
  PlaneLongestPaths result;
  BranchGraph graph(axis, watch);
  std::vector<bool> is_seen(axis.nodes.size()), is_kept(axis.arcs.size());
  const auto keep = [&](std::span<const std::uint32_t> branches) {
    for (const std::uint32_t branch : branches) {
      for (const std::uint32_t arc : axis.branches[branch].arcs) is_kept[arc] = true;
    }
  };
  for (const AxisBranch& first : axis.branches) {
    if (is_seen[first.ends[0]]) continue;
    graph.search(first.ends[0]);
    std::vector<std::uint32_t> ends;
    std::size_t degrees = 0;
    const std::vector<std::uint32_t> nodes = graph.reached();
    for (const std::uint32_t node : nodes) {
      is_seen[node] = true;
      degrees += graph.degree(node);
      if (graph.degree(node) == 1) ends.push_back(node);
    }
    if (ends.size() < 2) {
      for (const std::uint32_t node : nodes) keep(graph.branches_at(node));
      continue;
    }
    const LongestPath longest(graph, std::move(ends), degrees / 2 == nodes.size() - 1);
    keep(longest.path());
    result.excess = std::max(result.excess, longest.excess());
  }
  result.axis = axis_of_arcs(axis, is_kept);
  return result;
}

}  // namespace
}  // namespace plane

Result<PlaneLongestPaths> find_longest_paths(const PlaneAxis& axis, const std::stop_token& stop) {
  return catch_out_of_memory("finding longest paths", [&]() -> Result<PlaneLongestPaths> {
    try {
      const ProgressCallback none;
      const LoopWatch watch(none, stop);
      return plane::longest_paths(axis, watch);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

}  // namespace medial_vk
