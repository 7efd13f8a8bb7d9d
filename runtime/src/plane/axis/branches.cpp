#include "plane/axis/branches.h"

#include <algorithm>

namespace medial_vk::plane {
namespace {

class BranchWalk {
 public:
  explicit BranchWalk(PlaneAxis& axis) : axis_(axis), first_(axis.nodes.size() + 1), is_used_(axis.arcs.size()) {
    for (const AxisArc& arc : axis.arcs) {
      for (const std::uint32_t node : arc.nodes) ++first_[node + 1];
    }
    for (std::size_t i = 0; i < axis.nodes.size(); ++i) {
      axis.nodes[i].degree = static_cast<std::uint32_t>(first_[i + 1]);
      first_[i + 1] += first_[i];
    }
    arcs_at_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t a = 0; a < axis.arcs.size(); ++a) {
      for (const std::uint32_t node : axis.arcs[a].nodes) arcs_at_[next[node]++] = a;
    }
  }

  /// From junctions and ends first; loops without any remain.
  void run() {
    for (std::uint32_t a = 0; a < axis_.arcs.size(); ++a) {
      for (const std::uint32_t node : axis_.arcs[a].nodes) {
        if (!is_used_[a] && axis_.nodes[node].degree != 2) walk(node, a);
      }
    }
    for (std::uint32_t a = 0; a < axis_.arcs.size(); ++a) {
      if (!is_used_[a]) walk(axis_.arcs[a].nodes[0], a);
    }
  }

 private:
  void walk(std::uint32_t from, std::uint32_t arc) {
    AxisBranch branch;
    branch.ends[0] = from;
    std::uint32_t node = from;
    for (;;) {
      is_used_[arc] = true;
      const AxisArc& a = axis_.arcs[arc];
      const bool is_reversed = a.nodes[0] != node;
      branch.arcs.push_back(arc);
      branch.reversed.push_back(is_reversed);
      branch.length += a.curve.length(a.t[0], a.t[1]);
      node = a.nodes[is_reversed ? 0 : 1];
      if (node == from || axis_.nodes[node].degree != 2) break;
      const std::uint32_t one = arcs_at_[first_[node]], two = arcs_at_[first_[node] + 1];
      const std::uint32_t next = one == arc ? two : one;
      if (is_used_[next]) break;
      arc = next;
    }
    branch.ends[1] = node;
    axis_.branches.push_back(std::move(branch));
  }

  PlaneAxis& axis_;
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> arcs_at_;
  std::vector<bool> is_used_;
};

}  // namespace

void set_branches(PlaneAxis& axis) {
  axis.branches.clear();
  BranchWalk(axis).run();
}

}  // namespace medial_vk::plane
