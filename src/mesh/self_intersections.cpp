#include "mesh/self_intersections.h"

#include <utility>

namespace medial_vk {
namespace {

class Search {
 public:
  Search(const Mesh& mesh, const TriangleTree& tree) : mesh_(mesh), tree_(tree) {
    result_.crossed.assign(mesh.triangles.size(), false);
    // Six pairs of neighbours per triangle and a few near misses are normal; far beyond that a mesh is a tangle, and
    // the time is better spent elsewhere. A pair takes about 0.1 microseconds.
    budget_ = kPairCost * (2'000'000 + 24 * static_cast<std::int64_t>(mesh.triangles.size()));
  }

  SelfIntersections run() {
    // Pairs of nodes instead of a query per triangle: boxes that are apart are told apart once for all below them.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> stack;
    if (!tree_.nodes.empty()) stack.push_back({0, 0});
    while (!stack.empty() && budget_ > 0) {
      const auto [i, j] = stack.back();
      stack.pop_back();
      --budget_;
      const TriangleTree::Node &a = tree_.nodes[i], &b = tree_.nodes[j];
      if (i == j) {
        if (a.left == 0) {
          test_within(a);
        } else {
          stack.push_back({a.left, a.left});
          stack.push_back({a.right, a.right});
          stack.push_back({a.left, a.right});
        }
        continue;
      }
      if (!overlap(a.box, b.box)) continue;
      if (a.left == 0 && b.left == 0) {
        test_between(a, b);
      } else if (b.left == 0 || (a.left != 0 && a.count >= b.count)) {
        stack.push_back({a.left, j});
        stack.push_back({a.right, j});
      } else {
        stack.push_back({i, b.left});
        stack.push_back({i, b.right});
      }
    }
    result_.known = budget_ > 0;
    for (const bool crossed : result_.crossed) result_.count += crossed;
    return std::move(result_);
  }

 private:
  void test_within(const TriangleTree::Node& node) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      for (std::uint32_t j = i + 1; j < node.first + node.count; ++j) test(i, j);
    }
  }

  void test_between(const TriangleTree::Node& a, const TriangleTree::Node& b) {
    for (std::uint32_t i = a.first; i < a.first + a.count; ++i) {
      if (!overlap(tree_.boxes[i], b.box)) continue;
      for (std::uint32_t j = b.first; j < b.first + b.count; ++j) test(i, j);
    }
  }

  void test(std::uint32_t i, std::uint32_t j) {
    --budget_;
    if (!overlap(tree_.boxes[i], tree_.boxes[j])) return;
    const std::uint32_t t = tree_.order[i], u = tree_.order[j];
    if (result_.crossed[t] && result_.crossed[u]) return;
    budget_ -= kPairCost;
    if (!certainly_apart(i, j)) result_.crossed[t] = result_.crossed[u] = true;
  }

  /// But for what they share by index.
  bool certainly_apart(std::uint32_t i, std::uint32_t j) const {
    const Triangle &t = mesh_.triangles[tree_.order[i]], &u = mesh_.triangles[tree_.order[j]];
    const std::array<Point, 3>&a = tree_.corners[i], &b = tree_.corners[j];
    int shared = 0, t_at = 0, u_at = 0, t_sum = 0, u_sum = 0;
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) {
        if (t[k] != u[l]) continue;
        ++shared;
        t_at = k;
        u_at = l;
        t_sum += k;
        u_sum += l;
      }
    }
    if (shared == 0) return certainly_disjoint(a, b);
    if (shared == 1) {
      return certainly_meet_at_apex(a[t_at], a[(t_at + 1) % 3], a[(t_at + 2) % 3], b[(u_at + 1) % 3],
                                    b[(u_at + 2) % 3]);
    }
    if (shared == 2) {
      const int t_free = 3 - t_sum, u_free = 3 - u_sum;
      return certainly_meet_at_side(a[(t_free + 1) % 3], a[(t_free + 2) % 3], a[t_free], b[u_free]);
    }
    return false;  // duplicates are gone by now
  }

  /// A full test costs about this many comparisons of boxes.
  static constexpr std::int64_t kPairCost = 16;

  const Mesh& mesh_;
  const TriangleTree& tree_;
  std::int64_t budget_;
  SelfIntersections result_;
};

}  // namespace

SelfIntersections find_self_intersections(const Mesh& mesh, const TriangleTree& tree) {
  return Search(mesh, tree).run();
}

}  // namespace medial_vk
