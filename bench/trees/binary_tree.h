// Binary trees of bounding volumes over balls, and the closest two balls of two of them.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "bounding_ball.h"
#include "medial_vk/proximity.h"
#include "pairing.h"
#include "swept_rectangle.h"

namespace medial_vk::bench {

/// `Volume` is BoundingBall or SweptRectangle. Each is fitted to the balls below it.
template <class Volume>
class BinaryTree {
 public:
  /// `likelihoods` of the balls are for searches by likelihood; none: they are 0. Precondition: the pairing is one of
  /// these balls, of which there are one or more.
  BinaryTree(std::span<const Ball> balls, const Pairing& pairing, std::span<const double> likelihoods = {});

  struct Node {
    Volume volume;
    double likelihood = 0;  ///< The sum of those of the balls below.
    std::array<std::uint32_t, 2> below = {};
  };

  std::uint32_t root() const { return static_cast<std::uint32_t>(nodes_.size() - 1); }
  bool is_ball(std::uint32_t node) const { return node < balls_.size(); }
  const Ball& ball(std::uint32_t i) const { return balls_[i]; }
  const Node& node(std::uint32_t i) const { return nodes_[i]; }
  std::size_t balls() const { return balls_.size(); }

 private:
  std::vector<Ball> balls_;
  std::vector<Node> nodes_;
};

struct ClosestPair {
  double separation = std::numeric_limits<double>::infinity();  ///< Less than 0 if the balls overlap.
  BallPair balls;
  std::uint64_t tests = 0;  ///< Of pairs of volumes or balls.
};

/// Which part of a node comes first.
enum class PartOrder {
  kCloser,    ///< That which is closer to the other node.
  kLikelier,  ///< That which is likelier to hold the answer (Section 8.7.4); of equal ones the closer.
};

/// The closest two balls, up to rounding; or two that overlap, if some do. Depth first: of two nodes the larger one is
/// divided. `start`: two balls with which to begin, such as the last answer, or none.
template <class Volume>
ClosestPair closest_pair(const BinaryTree<Volume>& a, const BinaryTree<Volume>& b, const Pose& pose,
                         const BallPair& start = {}, PartOrder order = PartOrder::kCloser);

extern template class BinaryTree<BoundingBall>;
extern template class BinaryTree<SweptRectangle>;
extern template ClosestPair closest_pair(const BinaryTree<BoundingBall>&, const BinaryTree<BoundingBall>&, const Pose&,
                                         const BallPair&, PartOrder);
extern template ClosestPair closest_pair(const BinaryTree<SweptRectangle>&, const BinaryTree<SweptRectangle>&,
                                         const Pose&, const BallPair&, PartOrder);

}  // namespace medial_vk::bench
