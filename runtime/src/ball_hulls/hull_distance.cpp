// The distance of two hulls: the minimum of |c(l) - c'(m)| - r(l) - r'(m), by enumeration of its stationary points
// (docs/theory.md, "Hulls of balls", "Distance of two hulls").
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "ball_hulls/axis_parts.h"
#include "ball_hulls/axis_point.h"
#include "base/point_ops.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk {
namespace {

/// Where the function is stationary over the lines of two edges, as lengths from their first ends.
struct StationaryPair {
  bool exists = false;
  double on_first = 0, on_second = 0;
  double value = 0;
  Point direction = {};  // from the second line to the first, of unit length
};

/// The direction n from one line to the other is known from the slopes: its products with the directions of the edges
/// are the slope of the first and minus that of the second, and of the two unit vectors with these products it is the
/// one on the side of the first line. In the frame of the first direction, of what is perpendicular to it in the plane
/// of both, and of their normal, the ends follow one after the other. The value is n (a - b) less the radii at the
/// first ends, since n is stationary.
StationaryPair stationary_pair(const AxisEdge& edge, const Ball& a, const AxisEdge& other, const Ball& b) {
  StationaryPair pair;
  const double cosine = dot(edge.direction, other.direction);
  Point across = other.direction - cosine * edge.direction;
  const double sine = length(across);
  if (!(sine > kAxisRounding)) return pair;  // parallel: an end of one is as good
  across = (1 / sine) * across;
  if (sine < 0.25) across = orthogonalized(across, edge.direction);
  const double n_along = edge.slope, n_across = -(other.slope + cosine * edge.slope) / sine;
  const double rest_of_one = (1 - n_along) * (1 + n_along) - n_across * n_across;
  if (!(rest_of_one > 0)) return pair;
  const Point normal = cross(edge.direction, across);
  const Point offset = a.centre - b.centre;
  const double along = dot(offset, edge.direction), aside = dot(offset, across), height = dot(offset, normal);
  const double n_normal = std::copysign(std::sqrt(rest_of_one), height);
  const double distance = height / n_normal;
  pair.on_second = (aside - distance * n_across) / sine;
  pair.on_first = distance * n_along - along + pair.on_second * cosine;
  pair.value = n_along * along + n_across * aside + n_normal * height - a.radius - b.radius;
  pair.direction = n_along * edge.direction + n_across * across + n_normal * normal;
  pair.exists = true;
  return pair;
}

/// Of two hulls of two balls.
double distance_of_cones(const BallHull& first, const BallHull& second) {
  const AxisEdge edge(first, 0, 1), other(second, 0, 1);
  const auto& a = first.corners;
  const auto& b = second.corners;
  const auto ball_to_second = [&](const Ball& ball) {
    return nearest_on_edge(second, other, ball.centre).distance - ball.radius;
  };
  const auto ball_to_first = [&](const Ball& ball) {
    return nearest_on_edge(first, edge, ball.centre).distance - ball.radius;
  };
  if (!edge.is_cone) return ball_to_second(a[a[1].radius > a[0].radius ? 1 : 0]);
  if (!other.is_cone) return ball_to_first(b[b[1].radius > b[0].radius ? 1 : 0]);
  const StationaryPair pair = stationary_pair(edge, a[0], other, b[0]);
  if (!pair.exists) {
    return std::min({ball_to_second(a[0]), ball_to_second(a[1]), ball_to_first(b[0]), ball_to_first(b[1])});
  }
  // The way from the stationary pair to any pair of points of the edges enters through a side beyond which it lies.
  const bool before = pair.on_first<0, behind = pair.on_first> edge.extent;
  const bool other_before = pair.on_second<0, other_behind = pair.on_second> other.extent;
  if (!before && !behind && !other_before && !other_behind) return pair.value;
  double least = std::numeric_limits<double>::infinity();
  if (before || behind) least = ball_to_second(a[behind ? 1 : 0]);
  if (other_before || other_behind) least = std::min(least, ball_to_first(b[other_behind ? 1 : 0]));
  return least;
}

/// The minimum for two hulls of which one has three balls, as the least of the candidates: balls of either against the
/// other hull, pairs of edges, and points where an edge of one axis goes through the triangle of the other.
///
/// For any unit vector n the minimum is at least min(n c_i - r_i) - max(n c'_k + r'_k), over the balls of the first
/// hull and those of the second; the same holds for an edge pair and its four balls. Taken for the direction of the
/// best pair so far, this bound excludes most edge pairs, and it ends the search where it meets the best value.
class HullPair {
 public:
  HullPair(const AxisQuery& first, const AxisQuery& second) : first_(first), second_(second) {
    for (const Ball& ball : first.hull().balls()) note_extent(ball);
    for (const Ball& ball : second.hull().balls()) note_extent(ball);
    rounding_ *= 0x1p-51;
    look_along({1, 0, 0});  // any direction, for centres that coincide below
  }

  double distance() {
    look_along(middle(first_.hull()) - middle(second_.hull()));
    // The balls that face each other most come first: their pair is often the best one.
    const std::array<std::uint32_t, 3> order = ascending(height_, first_.hull().count, 1);
    const std::array<std::uint32_t, 3> other_order = ascending(other_height_, second_.hull().count, -1);
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (i < first_.hull().count && try_ball(first_, order[i], second_, 1)) return best_;
      if (i < second_.hull().count && try_ball(second_, other_order[i], first_, -1)) return best_;
    }
    for (std::size_t i = 0; i < first_.edge_count(); ++i) {
      for (std::size_t k = 0; k < second_.edge_count(); ++k) {
        if (try_edges(i, k)) return best_;
      }
    }
    try_crossings(first_, second_);
    try_crossings(second_, first_);
    return best_;
  }

 private:
  static Point middle(const BallHull& hull) {
    Point sum = {0, 0, 0};
    for (const Ball& ball : hull.balls()) sum = sum + ball.centre;
    return (1.0 / hull.count) * sum;
  }

  static std::array<std::uint32_t, 3> ascending(const std::array<double, 3>& height, std::uint32_t count, double sign) {
    std::array<std::uint32_t, 3> order = {0, 1, 2};
    for (std::uint32_t i = 1; i < count; ++i) {
      for (std::uint32_t k = i; k > 0 && sign * height[order[k]] < sign * height[order[k - 1]]; --k) {
        std::swap(order[k], order[k - 1]);
      }
    }
    return order;
  }

  void note_extent(const Ball& ball) {
    const Point offset = ball.centre - second_.hull().corners[0].centre;
    rounding_ = std::max(rounding_, std::fabs(offset[0]) + std::fabs(offset[1]) + std::fabs(offset[2]) + ball.radius);
  }

  /// Heights of the balls along a direction, for the bounds.
  void look_along(const Point& direction) {
    const double size = length(direction);
    if (!(size > 0)) return;
    const Point n = (1 / size) * direction;
    const Point& origin = second_.hull().corners[0].centre;
    for (std::uint32_t i = 0; i < first_.hull().count; ++i) {
      const Ball& ball = first_.hull().corners[i];
      height_[i] = dot(n, ball.centre - origin) - ball.radius;
    }
    for (std::uint32_t k = 0; k < second_.hull().count; ++k) {
      const Ball& ball = second_.hull().corners[k];
      other_height_[k] = dot(n, ball.centre - origin) + ball.radius;
    }
  }

  /// Whether the bound along that direction shows that the best value is the minimum, up to rounding.
  bool is_least() const {
    double lower = height_[0], upper = other_height_[0];
    for (std::uint32_t i = 1; i < first_.hull().count; ++i) lower = std::min(lower, height_[i]);
    for (std::uint32_t k = 1; k < second_.hull().count; ++k) upper = std::max(upper, other_height_[k]);
    return lower - upper >= best_ - rounding_;
  }

  bool take(double value, const Point& direction) {
    if (!(value < best_)) return false;
    best_ = value;
    look_along(direction);
    return is_least();
  }

  /// `sign`: 1 for a ball of the first hull, whose direction is from the second.
  bool try_ball(const AxisQuery& owner, std::uint32_t index, const AxisQuery& other, double sign) {
    const Ball& ball = owner.hull().corners[index];
    const AxisPoint nearest = other.nearest(ball.centre);
    const double value = nearest.distance - ball.radius;
    if (!(value < best_)) return false;
    return take(value, sign * (ball.centre - ball_at(other.hull(), nearest.weight).centre));
  }

  bool try_edges(std::size_t i, std::size_t k) {
    const AxisEdge &edge = first_.edge(i), &other = second_.edge(k);
    if (!edge.is_cone || !other.is_cone) return false;
    const double bound =
        std::min(height_[edge.from], height_[edge.to]) - std::max(other_height_[other.from], other_height_[other.to]);
    if (bound >= best_ - rounding_) return false;
    const StationaryPair pair =
        stationary_pair(edge, first_.hull().corners[edge.from], other, second_.hull().corners[other.from]);
    if (!pair.exists || pair.on_first < 0 || pair.on_first > edge.extent || pair.on_second < 0 ||
        pair.on_second > other.extent) {
      return false;  // beyond an end, and the balls have been tried
    }
    return take(pair.value, pair.direction);
  }

  /// Edges of `owner` through the triangle of `other`: there the centres coincide.
  void try_crossings(const AxisQuery& owner, const AxisQuery& other) {
    const AxisFace& face = other.face();
    if (!face.exists) return;
    const BallHull &hull = owner.hull(), &of_face = other.hull();
    const Point& origin = of_face.corners[face.from].centre;
    std::array<Point, 3> offset{};
    std::array<double, 3> height{};
    for (std::uint32_t i = 0; i < hull.count; ++i) {
      offset[i] = hull.corners[i].centre - origin;
      height[i] = dot(offset[i], face.normal);
    }
    for (std::size_t k = 0; k < owner.edge_count(); ++k) {
      const std::size_t i = k, j = (k + 1) % 3;
      if ((height[i] > 0) == (height[j] > 0) || height[i] == height[j]) continue;
      const double share = height[i] / (height[i] - height[j]);
      const Point crossing = offset[i] + share * (offset[j] - offset[i]);
      const auto weight = face.weights_at(dot(crossing, face.along), dot(crossing, face.across));
      if (weight[0] < 0 || weight[1] < 0 || weight[2] < 0) continue;
      best_ = std::min(best_, -ball_at(of_face, weight).radius -
                                  (hull.corners[i].radius + share * (hull.corners[j].radius - hull.corners[i].radius)));
    }
  }

  const AxisQuery &first_, &second_;
  double best_ = std::numeric_limits<double>::infinity();
  double rounding_ = 0;
  std::array<double, 3> height_ = {};        // of the first hull's balls: least product with a point, less the radius
  std::array<double, 3> other_height_ = {};  // of the second's: greatest
};

}  // namespace

double distance_between(const BallHull& a, const BallHull& b) {
  if (a.count == 1 && b.count == 1) {
    return length(a.corners[0].centre - b.corners[0].centre) - a.corners[0].radius - b.corners[0].radius;
  }
  if (a.count == 1) return signed_distance(b, a.corners[0].centre) - a.corners[0].radius;
  if (b.count == 1) return signed_distance(a, b.corners[0].centre) - b.corners[0].radius;
  if (a.count == 2 && b.count == 2) return distance_of_cones(a, b);
  const AxisQuery first(a), second(b);
  return HullPair(first, second).distance();
}

}  // namespace medial_vk
