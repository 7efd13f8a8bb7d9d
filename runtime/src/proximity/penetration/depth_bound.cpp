#include "proximity/penetration/depth_bound.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "proximity/closest_balls.h"

namespace medial_vk {
namespace {

/// A cube of translations, with the deepest pair of the cube that it is a part of.
struct Cell {
  double least = 0;  ///< No translation of the cube that may separate the balls is shorter.
  Point middle = {0, 0, 0};
  double half = 0;  ///< Of its side: a power of two, of which the coordinates of the middle are exact multiples.
  BallPair pair;
};

struct IsLonger {
  bool operator()(const Cell& s, const Cell& t) const { return s.least > t.least; }
};

/// The length of the shortest vector of a cube, rounded down.
double least_length(const Point& middle, double half) {
  Point nearest;
  for (std::size_t k = 0; k < 3; ++k) nearest[k] = std::max(0.0, std::fabs(middle[k]) - half);
  return length(nearest) * (1 - 8 * 0x1p-53);
}

/// The least power of two that is at least x, for positive x.
double power_of_two_above(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(1.0, mantissa == 0.5 ? exponent - 1 : exponent);
}

class DepthSearch {
 public:
  DepthSearch(const BodyImpl& a, const BodyImpl& b, const Pose& pose) : a_(a), b_(b), pose_(pose) {}

  DepthBound run(double upper, std::uint64_t most_queries) {
    DepthBound bound;
    Cell root;
    const double overlap = overlap_at(root.middle, kNone, root.pair);
    if (!(overlap > 0)) return bound;
    bound = {std::min(overlap, upper), root.pair};
    // Shorter translations than the overlap of the deepest two balls do not separate these.
    root.least = overlap;
    root.half = power_of_two_above(std::min(upper, longest()));
    cells_.push(root);
    for (std::uint64_t queries = 1; queries < most_queries && !cells_.empty(); ++queries) {
      Cell cell = cells_.top();
      bound.lower = std::max(bound.lower, std::min(cell.least, upper));
      if (cell.least >= upper) break;
      // Far below the errors of overlaps. Above it, middles are multiples of a half by numbers below 2^46, and exact.
      if (cell.half <= 0x1p-44 * cell.least) break;
      cells_.pop();
      const double diagonal = std::sqrt(3.0) * cell.half * (1 + 8 * 0x1p-53);
      if (overlap_at(cell.middle, diagonal, cell.pair) < diagonal) divide(cell, overlap);
    }
    if (!cells_.empty()) bound.lower = std::max(bound.lower, std::min(cells_.top().least, upper));
    return bound;
  }

 private:
  static constexpr double kNone = 1e30;  // more than any two balls overlap by

  /// By how much two balls overlap after the translation, at least: they are the deepest two, or some that overlap by
  /// more than `enough`, up to the rounding of float. `pair` is where the search starts, and becomes these two.
  double overlap_at(const Point& translation, double enough, BallPair& pair) const {
    const Pose moved = {pose_.rotation, pose_.shift + translation};
    const Placement placement(a_, b_, moved);
    if (!placement.is_in_range()) return -kNone;
    const BodyTree &tree_a = a_.inside_tree, &tree_b = b_.inside_tree;
    const double error = placement.separation_error_of(tree_a.nodes(), tree_b.nodes());
    const float as_deep = static_cast<float>(-std::min(enough * (1 + 0x1p-20) + 2 * error, kNone));
    pair = closest_balls(tree_a, tree_b, placement.float_pose(), pair, as_deep).balls;
    const Ball &ball_a = a_.inside[pair.a], &ball_b = b_.inside[pair.b];
    if (!(ball_a.radius > 0 && ball_b.radius > 0)) return -kNone;  // a point need not be in the interior
    const Point away = ball_a.centre - moved * ball_b.centre;
    // The roundings are those of distance_bounds.cpp, and that of the sum of the shift and the translation.
    const double size = length(ball_a.centre) + length(ball_b.centre) + length(pose_.shift) + length(translation) +
                        ball_a.radius + ball_b.radius;
    const double error_of_pair = 0x1p-47 * size + 4e-12 * ball_b.radius;
    return ball_a.radius + ball_b.radius - std::hypot(away[0], away[1], away[2]) - error_of_pair;
  }

  double longest() const {
    const Placement placement(a_, b_, pose_);
    return 2 * (placement.distance() + a_.inside_tree.nodes().reach() + b_.inside_tree.nodes().reach());
  }

  /// The parts are exact: halves are powers of two, and not too small.
  void divide(const Cell& cell, double first_overlap) {
    const double half = 0.5 * cell.half;
    for (unsigned octant = 0; octant < 8; ++octant) {
      Cell part{0, cell.middle, half, cell.pair};
      for (std::size_t k = 0; k < 3; ++k) part.middle[k] += (octant >> k & 1u) != 0 ? half : -half;
      part.least = std::max({first_overlap, cell.least, least_length(part.middle, half)});
      cells_.push(part);
    }
  }

  const BodyImpl& a_;
  const BodyImpl& b_;
  const Pose& pose_;
  std::priority_queue<Cell, std::vector<Cell>, IsLonger> cells_;
};

}  // namespace

DepthBound bound_depth(const BodyImpl& a, const BodyImpl& b, const Pose& pose, double upper,
                       std::uint64_t most_queries) {
  return DepthSearch(a, b, pose).run(upper, most_queries);
}

}  // namespace medial_vk
