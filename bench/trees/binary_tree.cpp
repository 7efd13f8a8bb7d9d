#include "binary_tree.h"

#include <algorithm>
#include <utility>

#include "base/point_ops.h"
#include "rectangle_distance.h"

namespace medial_vk::bench {

namespace {

/// The library's product of a pose and a point is not inlined.
double distance_of_points(const Point& a, const Point& b, const Pose& pose) {
  const Point there = {dot(pose.rotation[0], b), dot(pose.rotation[1], b), dot(pose.rotation[2], b)};
  return length(a - pose.shift - there);
}

}  // namespace

double separation(const BoundingBall& a, const BoundingBall& b, const Pose& pose) {
  return distance_of_points(a.centre, b.centre, pose) - a.radius - b.radius;
}

double separation(const SweptRectangle& a, const SweptRectangle& b, const Pose& pose) {
  return distance_of_rectangles(a, b, pose) - a.radius - b.radius;
}

double distance_of_rectangles(const SweptRectangle& a, const SweptRectangle& b, const Pose& pose) {
  return RectangleDistance(a, b, pose).value();
}

template <class Volume>
BinaryTree<Volume>::BinaryTree(std::span<const Ball> balls, const Pairing& pairing, std::span<const double> likelihoods)
    : balls_(balls.begin(), balls.end()), nodes_(pairing.nodes()) {
  std::vector<std::vector<std::uint32_t>> below(pairing.nodes());
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (is_ball(i)) {
      below[i] = {i};
      if (!likelihoods.empty()) nodes_[i].likelihood = likelihoods[i];
    } else {
      const auto& [first, second] = nodes_[i].below = pairing.pairs[i - balls_.size()];
      below[i] = below[first];
      below[i].insert(below[i].end(), below[second].begin(), below[second].end());
      below[first] = below[second] = {};
      nodes_[i].likelihood = nodes_[first].likelihood + nodes_[second].likelihood;
    }
    nodes_[i].volume = Volume::around(balls_, below[i]);
  }
}

namespace {

template <class Volume>
class Search {
 public:
  Search(const BinaryTree<Volume>& a, const BinaryTree<Volume>& b, const Pose& pose, PartOrder order)
      : a_(a), b_(b), pose_(pose), order_(order) {}

  ClosestPair run(const BallPair& start) {
    if (start.a < a_.balls() && start.b < b_.balls()) take(start.a, start.b);
    const std::uint32_t i = a_.root(), j = b_.root();
    visit({separation_of(i, j), i, j});
    return best_;
  }

 private:
  struct Nodes {
    double separation;
    std::uint32_t a, b;
  };

  void visit(const Nodes& nodes) {
    if (nodes.separation >= best_.separation || best_.separation <= 0) return;
    const bool is_ball_a = a_.is_ball(nodes.a), is_ball_b = b_.is_ball(nodes.b);
    if (is_ball_a && is_ball_b) {
      best_.separation = nodes.separation;
      best_.balls = {nodes.a, nodes.b};
      return;
    }
    const auto &a = a_.node(nodes.a), &b = b_.node(nodes.b);
    const bool divides_a = is_ball_b || (!is_ball_a && a.volume.size() >= b.volume.size());
    Nodes first = nodes, second = nodes;
    (divides_a ? first.a : first.b) = (divides_a ? a : b).below[0];
    (divides_a ? second.a : second.b) = (divides_a ? a : b).below[1];
    first.separation = separation_of(first.a, first.b);
    second.separation = separation_of(second.a, second.b);
    if (comes_before(second, first)) std::swap(first, second);
    visit(first);
    visit(second);
  }

  bool comes_before(const Nodes& p, const Nodes& q) const {
    if (order_ == PartOrder::kLikelier) {
      const double of_p = a_.node(p.a).likelihood * b_.node(p.b).likelihood,
                   of_q = a_.node(q.a).likelihood * b_.node(q.b).likelihood;
      if (of_p != of_q) return of_p > of_q;
    }
    return p.separation < q.separation;
  }

  void take(std::uint32_t i, std::uint32_t j) {
    best_.separation = separation_of(i, j);
    best_.balls = {i, j};
  }

  double separation_of(std::uint32_t i, std::uint32_t j) {
    ++best_.tests;
    if (a_.is_ball(i) && b_.is_ball(j)) {
      const Ball &a = a_.ball(i), &b = b_.ball(j);
      return distance_of_points(a.centre, b.centre, pose_) - a.radius - b.radius;
    }
    return separation(a_.node(i).volume, b_.node(j).volume, pose_);
  }

  const BinaryTree<Volume>& a_;
  const BinaryTree<Volume>& b_;
  const Pose& pose_;
  PartOrder order_;
  ClosestPair best_;
};

}  // namespace

template <class Volume>
ClosestPair closest_pair(const BinaryTree<Volume>& a, const BinaryTree<Volume>& b, const Pose& pose,
                         const BallPair& start, PartOrder order) {
  return Search<Volume>(a, b, pose, order).run(start);
}

template class BinaryTree<BoundingBall>;
template class BinaryTree<SweptRectangle>;
template ClosestPair closest_pair(const BinaryTree<BoundingBall>&, const BinaryTree<BoundingBall>&, const Pose&,
                                  const BallPair&, PartOrder);
template ClosestPair closest_pair(const BinaryTree<SweptRectangle>&, const BinaryTree<SweptRectangle>&, const Pose&,
                                  const BallPair&, PartOrder);

}  // namespace medial_vk::bench
