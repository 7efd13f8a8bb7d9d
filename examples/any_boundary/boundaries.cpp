#include "boundaries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <nanoflann.hpp>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace any_boundary {
namespace {

using medial_vk::BoundaryFunctions;
using medial_vk::Point;

/// Answers for many points by `nearest`, which answers for one.
template <class Nearest>
BoundaryFunctions boundary_of(const Nearest& nearest) {
  BoundaryFunctions boundary;
  boundary.nearest = [nearest](std::span<const Point> points, std::span<Point> answers) {
    std::transform(points.begin(), points.end(), answers.begin(), nearest);
  };
  return boundary;
}

template <class Nearest, class IsInside>
BoundaryFunctions boundary_of(const Nearest& nearest, const IsInside& is_inside) {
  BoundaryFunctions boundary = boundary_of(nearest);
  boundary.contains = [is_inside](std::span<const Point> points, std::span<std::uint8_t> answers) {
    std::transform(points.begin(), points.end(), answers.begin(),
                   [&](const Point& p) { return is_inside(p) ? std::uint8_t{1} : std::uint8_t{0}; });
  };
  return boundary;
}

/// Points and their k-d tree, for nanoflann.
class Cloud {
 public:
  explicit Cloud(std::vector<Point> points) : points_(std::move(points)), tree_(3, *this) {}

  Point nearest(const Point& p) const {
    std::size_t index = 0;
    double squared = 0;
    tree_.knnSearch(p.data(), 1, &index, &squared);
    return points_[index];
  }

  std::size_t kdtree_get_point_count() const { return points_.size(); }
  double kdtree_get_pt(std::size_t index, std::size_t axis) const { return points_[index][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // nanoflann finds it
  }

 private:
  using Distance = nanoflann::L2_Simple_Adaptor<double, Cloud>;

  std::vector<Point> points_;
  nanoflann::KDTreeSingleIndexAdaptor<Distance, Cloud, 3, std::size_t> tree_;
};

/// The signed distance from a box with rounded edges: negative inside.
double distance_from_rounded_box(const Point& p) {
  constexpr Point kHalf = {1, 0.6, 0.35};
  constexpr double kRounding = 0.2;
  double outside = 0, deepest = -1e30;
  for (std::size_t k = 0; k < 3; ++k) {
    const double beyond = std::fabs(p[k]) - (kHalf[k] - kRounding);
    outside += beyond > 0 ? beyond * beyond : 0;
    deepest = std::max(deepest, beyond);
  }
  return std::sqrt(outside) + std::min(deepest, 0.0) - kRounding;
}

/// Central differences.
template <class Function>
Point gradient(const Function& f, const Point& p) {
  constexpr double kStep = 1e-6;
  Point g;
  for (std::size_t k = 0; k < 3; ++k) {
    Point before = p, after = p;
    before[k] -= kStep;
    after[k] += kStep;
    g[k] = (f(after) - f(before)) / (2 * kStep);
  }
  return g;
}

/// A nearest point of the surface f = 0 by the gradient of the signed distance f. Near the medial axis differences may
/// mix two gradients. But f gives the distance itself, so that a wrong answer is known, and another start is tried. NaN
/// if none leads to an answer within `error`.
template <class Function>
Point nearest_by_gradient(const Function& f, const Point& p, double error) {
  constexpr int kStarts = 64, kSteps = 8;
  const double distance = std::fabs(f(p));
  Point best = p;
  double least = 1e30;
  for (int start = 0; start < kStarts && least > distance + error; ++start) {
    // Points of a spiral around p; the first is p.
    const double off = 0.05 * error * start, angle = 2.4 * start, height = std::cos(1.7 * start);
    const double across = off * std::sqrt(1 - height * height);
    Point q = {p[0] + across * std::cos(angle), p[1] + across * std::sin(angle), p[2] + off * height};
    for (int step = 0; step < kSteps; ++step) {
      const double value = f(q);
      const Point g = gradient(f, q);
      for (std::size_t k = 0; k < 3; ++k) q[k] -= value * g[k];
    }
    const double away = std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
    if (std::fabs(f(q)) > error || away >= least) continue;
    least = away;
    best = q;
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return least <= distance + error ? best : Point{kNone, kNone, kNone};
}

}  // namespace

BoundaryFunctions torus() {
  constexpr double kTube = 0.4;
  // In the half plane of p that ends at the axis of rotation, across is the distance from the axis, and the tube a
  // circle around (1, 0). The answer is computed from there, so that it is on the torus also where p is close to the
  // circle of all centres.
  const auto nearest = [](const Point& p) {
    const double across = std::hypot(p[0], p[1]), off = std::hypot(across - 1, p[2]);
    const double u = off > 0 ? (across - 1) / off : 0,
                 v = off > 0 ? p[2] / off : 1;  // all points are equally far for 0
    const double x = across > 0 ? p[0] / across : 1, y = across > 0 ? p[1] / across : 0;
    return Point{(1 + kTube * u) * x, (1 + kTube * u) * y, kTube * v};
  };
  const auto is_inside = [](const Point& p) { return std::hypot(std::hypot(p[0], p[1]) - 1, p[2]) < kTube; };
  BoundaryFunctions boundary = boundary_of(nearest, is_inside);
  boundary.lower = {-1.4, -1.4, -0.4};
  boundary.upper = {1.4, 1.4, 0.4};
  return boundary;
}

BoundaryFunctions helix_of_points() {
  constexpr int kPoints = 5000;
  std::vector<Point> points;
  points.reserve(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const double t = 4.0 * i / kPoints, angle = 2 * std::numbers::pi * t;
    points.push_back({std::cos(angle), std::sin(angle), 0.5 * t});
  }
  const auto cloud = std::make_shared<Cloud>(std::move(points));
  BoundaryFunctions boundary = boundary_of([cloud](const Point& p) { return cloud->nearest(p); });
  boundary.lower = {-1.2, -1.2, -0.1};
  boundary.upper = {1.2, 1.2, 2.1};
  return boundary;
}

BoundaryFunctions rounded_box() {
  constexpr double kError = 1e-5;
  BoundaryFunctions boundary =
      boundary_of([](const Point& p) { return nearest_by_gradient(distance_from_rounded_box, p, kError); },
                  [](const Point& p) { return distance_from_rounded_box(p) < 0; });
  boundary.lower = {-1, -0.6, -0.35};
  boundary.upper = {1, 0.6, 0.35};
  boundary.error = kError;
  return boundary;
}

}  // namespace any_boundary
