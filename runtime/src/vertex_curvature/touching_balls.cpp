#include "vertex_curvature/touching_balls.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/point_ops.h"
#include "curvature/polynomial_fit.h"

namespace medial_vk {
namespace {

constexpr double kMostGap = 0.25;   // of the radius: the ball does not touch at a vertex farther away
constexpr double kReach = 3;        // spacings around a ball: near ones
constexpr double kRimReach = 6;     // spacings around a ball that tell whether it is at a rim, and where out is
constexpr double kRimOffset = 0.2;  // of kRimReach: the offset of the centroid; at the rim of a half-plane it is 0.42
constexpr double kSmoothJump = 1.0 / 3;  // of 1 / r: how much the curvature changes from a tip to a smooth cap, at most
constexpr double kAngleAbove = 1.2;      // times the least object angle: the sheet ends here
constexpr double kWideCap = 1.2;         // radians: half-angles at which tips say nothing of the bend of the rim
constexpr std::size_t kLeastRows = 9;

bool has_normals(const BallCurvature& ball) {
  return !std::isnan(ball.tips[0].normal[0]) && !std::isnan(ball.tips[1].normal[0]);
}

bool is_used(const BallCurvature& ball) {
  const CurvatureState state = ball.tips[0].state;
  return state == CurvatureState::kCurve || state == CurvatureState::kPoint || has_normals(ball);
}

/// The part of `v` perpendicular to a unit vector, of unit length.
Eigen::Vector3d across_to(const Eigen::Vector3d& v, const Eigen::Vector3d& unit) {
  return (v - v.dot(unit) * unit).normalized();
}

std::vector<Ball> taken(std::span<const Ball> balls, const std::vector<std::uint32_t>& numbers) {
  std::vector<Ball> out;
  out.reserve(numbers.size());
  for (const std::uint32_t number : numbers) out.push_back(balls[number]);
  return out;
}

std::vector<std::uint32_t> used_balls(const BoundaryCurvature& curvature) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(curvature.balls.size());
  for (std::size_t i = 0; i < curvature.balls.size(); ++i) {
    if (is_used(curvature.balls[i])) numbers.push_back(static_cast<std::uint32_t>(i));
  }
  return numbers;
}

double least_object_angle(const BoundaryCurvature& curvature) {
  double least = std::numbers::pi / 2;
  for (const BallCurvature& ball : curvature.balls) {
    if (ball.object_angle < least) least = ball.object_angle;
  }
  return least;
}

}  // namespace

TouchingBalls::TouchingBalls(std::span<const Ball> balls, const BoundaryCurvature& curvature, double object_angle)
    : balls_(balls),
      curvature_(curvature),
      least_angle_(object_angle > 0 ? object_angle : least_object_angle(curvature)),
      numbers_(used_balls(curvature)),
      tree_(taken(balls, numbers_)),
      grid_(centres_, 1) {
  centres_.reserve(numbers_.size());
  for (const std::uint32_t number : numbers_) centres_.push_back(balls[number].centre);
  grid_ = PointGrid(centres_, std::max(kReach * curvature.spacing, 1e-300));
}

Touch TouchingBalls::at(const Point& p, std::span<const Point> around) const {
  Touch out;
  if (numbers_.empty()) return out;
  const NearestBall nearest = tree_.nearest(p);
  const std::uint32_t ball = numbers_[nearest.ball];
  const double radius = balls_[ball].radius, gap = std::fabs(nearest.distance);
  if (!(gap <= kMostGap * radius)) return out;
  const TipCurvature& tip = curvature_.balls[ball].tips[0];
  const Eigen::Vector3d from_centre = to_eigen(p - balls_[ball].centre);
  const Eigen::Vector3d u = from_centre.normalized();
  if (tip.state == CurvatureState::kCurve) return cap_of_curve(ball, u, gap);
  if (tip.state != CurvatureState::kPoint) return cap_of_rim(ball, u, gap, around);
  out.state = CurvatureState::kPoint;
  out.ball = ball;
  out.at = {u, (Eigen::Matrix3d::Identity() - u * u.transpose()) / radius, tip.error + gap / (radius * radius)};
  return out;
}

Touch TouchingBalls::cap_of_curve(std::uint32_t ball, const Eigen::Vector3d& u, double gap) const {
  const Ball& self = balls_[ball];
  const TipCurvature& tip = curvature_.balls[ball].tips[0];
  const Eigen::Vector3d along = to_eigen(tip.directions[1]);
  const double square = self.radius * self.radius, spacing = curvature_.spacing;
  bool goes_on = false;  // the curve, on the side of the vertex
  const double side = u.dot(along);
  grid_.visit_within(self.centre, kReach * spacing, [&](std::uint32_t other, double) {
    const double step = to_eigen(centres_[other] - self.centre).dot(along);
    if ((side > 0 ? step : -step) > 0.25 * spacing) goes_on = true;
  });
  Touch out;
  out.ball = ball;
  out.at = {u, (Eigen::Matrix3d::Identity() - u * u.transpose()) / self.radius, tip.error + gap / square};
  // Along the sides of a tube, a vertex is up to half a spacing beside the circle of its ball.
  out.depth = self.radius * std::fabs(side) - 0.5 * spacing;
  if (!goes_on && out.depth > 0) {
    out.state = CurvatureState::kCut;
    out.at.error += spacing / square;  // the curve may end as far beyond the ball
    return out;
  }
  out.state = CurvatureState::kCurve;
  const Eigen::Vector3d around = across_to(along.cross(u), u);
  out.tangent = u.cross(around);
  out.at.shape = around * around.transpose() / self.radius;
  return out;
}

bool TouchingBalls::find_rim(std::uint32_t ball, Rim& rim) const {
  const BallCurvature& known = curvature_.balls[ball];
  const Eigen::Vector3d a = to_eigen(known.tips[0].normal), b = to_eigen(known.tips[1].normal);
  rim.across = (a - b).normalized();
  const double reach = kRimReach * curvature_.spacing;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  grid_.visit_within(balls_[ball].centre, reach, [&](std::uint32_t other, double squared) {
    const Eigen::Vector3d offset = to_eigen(centres_[other] - balls_[ball].centre);
    if (std::fabs(offset.dot(rim.across)) > 0.5 * std::sqrt(squared)) return;  // of another sheet
    sum += offset;
    ++count;
  });
  const Eigen::Vector3d outward = -(sum - sum.dot(rim.across) * rim.across) / static_cast<double>(count);
  if (!(outward.norm() > kRimOffset * reach)) return false;
  rim.outward = outward.normalized();
  // Where spokes lean, the arc from one tip to the other one is in the plane of both.
  const Eigen::Vector3d mean = a + b;
  if (mean.norm() > 2 * std::cos(kWideCap) && mean.dot(outward) > 0) rim.outward = mean.normalized();
  rim.along = rim.outward.cross(rim.across);
  rim.upper = std::atan2(a.dot(rim.across), a.dot(rim.outward));
  rim.lower = std::atan2(b.dot(rim.across), b.dot(rim.outward));
  return true;
}

void TouchingBalls::find_tips(std::uint32_t ball, Rim& rim) const {
  constexpr double kLeastAgreement = 0.9;
  double nearest[2] = {kReach * curvature_.spacing, kReach * curvature_.spacing};
  grid_.visit_within(balls_[ball].centre, kReach * curvature_.spacing, [&](std::uint32_t other, double squared) {
    const double distance = std::sqrt(squared);
    for (const TipCurvature& tip : curvature_.balls[numbers_[other]].tips) {
      if (!is_known(tip.state)) continue;
      for (std::size_t side = 0; side < 2; ++side) {
        const TipCurvature& own = curvature_.balls[ball].tips[side];
        if (distance > nearest[side] || dot(own.normal, tip.normal) < kLeastAgreement) continue;
        if (distance == nearest[side] && rim.tips[side] != nullptr) continue;
        nearest[side] = distance;
        rim.tips[side] = &tip;
      }
    }
  });
}

/// Whether the sheet has no other ball beyond this one: the object angle, as it decreases along the sheet, is well
/// above the least one even a spacing farther out.
bool TouchingBalls::ends_here(const Rim& rim, double radius, double across) const {
  const double half = (rim.upper - rim.lower) / 2;
  const double turn = across > 0 ? across / std::max(1 - radius * across, 1e-3) : 0;  // of a spoke along the sheet
  const double square = half * half - 2 * half * curvature_.spacing * std::sin(half) * turn;
  return square > kAngleAbove * kAngleAbove * least_angle_ * least_angle_;
}

TouchingBalls::Bends TouchingBalls::across_rim(const Rim& rim, double radius, double share) const {
  const double sphere = 1 / radius, blur = curvature_.spacing / (radius * radius);
  std::array<double, 2> sides = {};
  double errors = 0;
  std::size_t count = 0;
  for (std::size_t side = 0; side < 2; ++side) {
    if (rim.tips[side] == nullptr) continue;
    const TipCurvature& tip = *rim.tips[side];
    const Eigen::Vector3d normal = to_eigen(tip.normal), across = across_to(rim.along, normal).cross(normal);
    sides[side] = across.dot(shape_of(tip) * across) - sphere;
    errors = std::max(errors, std::isnan(tip.error) ? 0 : tip.error);
    ++count;
  }
  if (count == 1) sides[0] = sides[1] = sides[0] + sides[1];
  const double even = (sides[0] + sides[1]) / 2, odd = (sides[0] - sides[1]) / 2;
  const bool ends = ends_here(rim, radius, even + sphere);
  const double depth = 0.5 * (1 - std::fabs(share)) * (rim.upper - rim.lower) * radius;
  if (count == 0) return {sphere, ends ? blur : sphere};
  if (ends) return {sphere, depth > 0.5 * curvature_.spacing ? blur : std::max(blur, std::fabs(even))};
  if (std::fabs(even) > kSmoothJump * sphere) return {sphere, std::fabs(even)};
  // Legendre polynomials: the curve keeps its end points and its tangents there to first order.
  const double p2 = (3 * share * share - 1) / 2, p3 = (5 * share * share - 3) * share / 2;
  return {sphere + even * p2 + odd * p3, errors + std::fabs(even) / 2 + std::fabs(odd)};
}

TouchingBalls::Bends TouchingBalls::along_rim(const Rim& rim, double radius, const Eigen::Vector3d& u) const {
  // Of the tube around the rim, 1 / kappa = r + 1 / g, where g is linear in the normal: docs/theory.md.
  const Bends unknown = {0, 1 / radius};
  Eigen::Matrix2d rows = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  double errors = 0, mean = 0, count = 0;
  for (int side = 0; side < 2; ++side) {
    if (rim.tips[side] == nullptr) continue;
    const TipCurvature& tip = *rim.tips[side];
    const Eigen::Vector3d normal = to_eigen(tip.normal), t = across_to(rim.along, normal);
    const double kappa = t.dot(shape_of(tip) * t);
    if (radius * kappa > 0.95) return unknown;
    rows.row(side) << normal.dot(rim.outward), normal.dot(rim.across);
    g[side] = kappa / (1 - radius * kappa);
    errors = std::max(errors, std::isnan(tip.error) ? 0 : tip.error);
    mean += kappa;
    ++count;
  }
  if (count == 0) return unknown;
  mean /= count;
  const Eigen::Vector2d bend =
      count > 1 ? Eigen::Vector2d(rows.inverse() * g) : Eigen::Vector2d(g.sum() / rows.col(0).sum(), 0);
  const double at_u = bend[0] * u.dot(rim.outward) + bend[1] * u.dot(rim.across);
  if (!(1 + radius * at_u > 0.05)) return unknown;
  const double kappa = at_u / (1 + radius * at_u);
  return {kappa, errors + std::fabs(kappa - mean)};
}

/// The heights of vertices on the cap as a polynomial of degree 2. Of its curvatures the lesser one is that along the
/// rim; the greater one is 1 / radius.
TouchingBalls::Bends TouchingBalls::bend_of_vertices(const Rim& rim, double radius, const Eigen::Vector3d& u,
                                                     std::span<const Point> around, Eigen::Vector3d& along) const {
  const Eigen::Vector3d t = across_to(rim.along, u);
  Eigen::Vector3d w = t.cross(u);
  if (w.dot(rim.across) * u.dot(rim.outward) < w.dot(rim.outward) * u.dot(rim.across)) w = -w;
  const double angle = std::atan2(u.dot(rim.across), u.dot(rim.outward));
  using Row = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> moments = Eigen::Matrix<double, 5, 5>::Zero();
  Row right = Row::Zero();
  double squares = 0;
  std::size_t count = 0;
  for (const Point& q : around.subspan(1)) {
    const Eigen::Vector3d offset = to_eigen(q - around[0]);
    const double a = offset.dot(w) / radius, b = offset.dot(t) / radius, height = offset.dot(u) / radius;
    if (std::fabs(a) > 0.5 || height < -0.5 || angle + a < rim.lower || angle + a > rim.upper) continue;
    Row row;
    row << a, b, -0.5 * a * a, -a * b, -0.5 * b * b;
    // Beyond degree 2, a circle across the rim.
    const double value = height + (1 - 0.5 * a * a - std::sqrt(1 - a * a));
    moments += row * row.transpose();
    right += value * row;
    squares += value * value;
    ++count;
  }
  if (count < kLeastRows) return {0, 1 / radius};
  NormalEquations<5> equations;
  if (!equations.factor(moments)) return {0, 1 / radius};
  const Row found = equations.solve(right);
  Eigen::Matrix2d form;
  form << found[2], found[3], found[3], found[4];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(0.5 * (form + form.transpose()));
  const double residual = std::max(0.0, squares - found.dot(right)) / static_cast<double>(count - 5);
  const double variance =
      std::max({equations.inverse_diagonal(2), equations.inverse_diagonal(3), equations.inverse_diagonal(4)});
  const double error = 2 * std::sqrt(residual * variance);
  if (!(error < 1) || !(axes.eigenvalues()[0] < 1 + error)) return {0, 1 / radius};  // nor if it is NaN
  if (axes.eigenvalues()[1] - axes.eigenvalues()[0] > 2 * error) {
    along = (w * axes.eigenvectors()(0, 0) + t * axes.eigenvectors()(1, 0)).normalized();
  }
  // What the ball says of the greater one is a test of the heights.
  return {axes.eigenvalues()[0] / radius, (error + std::fabs(axes.eigenvalues()[1] - 1)) / radius};
}

Touch TouchingBalls::cap_of_rim(std::uint32_t ball, const Eigen::Vector3d& u, double gap,
                                std::span<const Point> around) const {
  Touch out;
  Rim rim;
  if (!find_rim(ball, rim)) return out;
  const double angle = std::atan2(u.dot(rim.across), u.dot(rim.outward));
  if (angle <= rim.lower || angle >= rim.upper) return out;
  const double radius = balls_[ball].radius, square = radius * radius;
  out.state = CurvatureState::kCut;
  out.ball = ball;
  out.at.normal = u;
  out.depth = radius * std::min(angle - rim.lower, rim.upper - angle);
  find_tips(ball, rim);
  const double half = (rim.upper - rim.lower) / 2, share = (angle - rim.lower) / half - 1;
  const Bends across = across_rim(rim, radius, share);
  Eigen::Vector3d t = across_to(rim.along, u);
  const Bends along = half < kWideCap ? along_rim(rim, radius, u) : bend_of_vertices(rim, radius, u, around, t);
  const Eigen::Vector3d w = t.cross(u);
  out.at.shape = across.value * w * w.transpose() + along.value * t * t.transpose();
  out.at.error = std::max(across.error, along.error) + gap / square;
  return out;
}

}  // namespace medial_vk
