#include "mesh/crossings/self_intersections.h"

#include <atomic>
#include <utility>

#include "base/parallel.h"

namespace medial_vk {
namespace {

using NodePair = std::pair<std::uint32_t, std::uint32_t>;

/// A full test costs about this many comparisons of boxes.
constexpr std::int64_t kPairCost = 16;

/// Replaces a pair of nodes, or a node with itself, by pairs of their children. False: both are leaves.
bool expand(const TriangleTree& tree, const NodePair& pair, std::vector<NodePair>& out) {
  const auto [i, j] = pair;
  const TriangleTree::Node &a = tree.nodes[i], &b = tree.nodes[j];
  if (a.left == 0 && b.left == 0) return false;
  if (i == j) {
    out.insert(out.end(), {{a.left, a.left}, {a.right, a.right}, {a.left, a.right}});
  } else if (b.left == 0 || (a.left != 0 && a.count >= b.count)) {
    out.insert(out.end(), {{a.left, j}, {a.right, j}});
  } else {
    out.insert(out.end(), {{i, b.left}, {i, b.right}});
  }
  return true;
}

/// Tests all pairs of triangles below some pairs of nodes. Several searches may share one budget.
class Search {
 public:
  Search(const Mesh& mesh, const TriangleTree& tree, std::atomic<std::int64_t>& budget)
      : mesh_(mesh), tree_(tree), budget_(budget) {}

  /// Pairs of nodes instead of a query per triangle: two disjoint boxes are tested once for all triangles below them.
  void run(const NodePair& start) {
    std::vector<NodePair> stack = {start};
    while (!stack.empty()) {
      if (cost_ >= kSettle && !settle()) return;
      const auto [i, j] = stack.back();
      stack.pop_back();
      ++cost_;
      const TriangleTree::Node &a = tree_.nodes[i], &b = tree_.nodes[j];
      if (i != j && !overlap(a.box, b.box)) continue;
      if (expand(tree_, {i, j}, stack)) continue;
      if (i == j) {
        test_within(a);
      } else {
        test_between(a, b);
      }
    }
    settle();
  }

  void add_to(SelfIntersections& result) const {
    for (std::size_t t = 0; t < crossed_.size(); ++t) {
      if (crossed_[t]) result.crossed[t] = true;
    }
  }

 private:
  /// Subtracts the finished work from the budget; false if that is used up.
  bool settle() {
    const std::int64_t cost = std::exchange(cost_, 0);
    return budget_.fetch_sub(cost) > cost;
  }

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
    ++cost_;
    if (!overlap(tree_.boxes[i], tree_.boxes[j])) return;
    const std::uint32_t t = tree_.order[i], u = tree_.order[j];
    if (!crossed_.empty() && crossed_[t] && crossed_[u]) return;
    cost_ += kPairCost;
    if (certainly_apart(mesh_, tree_, i, j)) return;
    crossed_.resize(mesh_.triangles.size(), false);
    crossed_[t] = crossed_[u] = true;
  }

  static constexpr std::int64_t kSettle = 4096;

  const Mesh& mesh_;
  const TriangleTree& tree_;
  std::atomic<std::int64_t>& budget_;
  std::int64_t cost_ = 0;      // not yet subtracted from the budget
  std::vector<bool> crossed_;  // empty: none
};

/// Pairs that together cover the whole search, enough for several threads. The same on every machine.
std::vector<NodePair> first_pairs(const TriangleTree& tree) {
  constexpr std::size_t kWanted = 200;
  std::vector<NodePair> pairs = {{0, 0}};
  for (std::size_t rounds = 0; pairs.size() < kWanted && rounds < 16; ++rounds) {
    std::vector<NodePair> next;
    for (const NodePair& pair : pairs) {
      if (pair.first != pair.second && !overlap(tree.nodes[pair.first].box, tree.nodes[pair.second].box)) continue;
      if (!expand(tree, pair, next)) next.push_back(pair);
    }
    pairs = std::move(next);
  }
  return pairs;
}

}  // namespace

bool certainly_apart(const Mesh& mesh, const TriangleTree& tree, std::uint32_t i, std::uint32_t j) {
  const Triangle &t = mesh.triangles[tree.order[i]], &u = mesh.triangles[tree.order[j]];
  const std::array<Point, 3>&a = tree.corners[i], &b = tree.corners[j];
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
    return certainly_meet_at_apex(a[t_at], a[(t_at + 1) % 3], a[(t_at + 2) % 3], b[(u_at + 1) % 3], b[(u_at + 2) % 3]);
  }
  if (shared == 2) {
    const int t_free = 3 - t_sum, u_free = 3 - u_sum;
    return certainly_meet_at_side(a[(t_free + 1) % 3], a[(t_free + 2) % 3], a[t_free], b[u_free]);
  }
  return false;  // duplicates have been removed
}

SelfIntersections find_self_intersections(const Mesh& mesh, const TriangleTree& tree, unsigned threads) {
  SelfIntersections result;
  result.crossed.assign(mesh.triangles.size(), false);
  if (tree.nodes.empty()) return result;
  // Six pairs of neighbours per triangle and a few near misses are normal; far beyond that a mesh is a tangle, and the
  // search is given up. A pair takes about 0.1 microseconds.
  const std::int64_t budget = kPairCost * (2'000'000 + 24 * static_cast<std::int64_t>(mesh.triangles.size()));
  std::atomic<std::int64_t> left = budget;
  const std::vector<NodePair> pairs = first_pairs(tree);
  std::vector<Search> searches(pairs.size(), Search(mesh, tree, left));
  parallel_for(pairs.size(), 1, threads, [&](std::size_t i) { searches[i].run(pairs[i]); });
  result.known = left > 0;
  if (!result.known) {
    // The progress of each search depends on the others, so the result for a tangle is that of one thread.
    left = budget;
    Search alone(mesh, tree, left);
    alone.run({0, 0});
    alone.add_to(result);
  } else {
    for (const Search& search : searches) search.add_to(result);
  }
  for (const bool crossed : result.crossed) result.count += crossed;
  return result;
}

}  // namespace medial_vk
