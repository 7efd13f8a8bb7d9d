#include "vertex_curvature/touching_balls.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr double kMostGap = 0.25;        // of the radius: the ball does not touch at a vertex farther away
constexpr double kReach = 3;             // spacings around a ball that tell whether it is at a rim
constexpr double kRimOffset = 0.2;       // of kReach: the offset of the centroid; at the rim of a half-plane it is 0.42
constexpr double kSmoothJump = 1.0 / 3;  // of 1 / r: how much the curvature changes from a tip to a smooth cap, at most
constexpr double kAngleAbove = 1.5;      // times the least object angle: the sheet ends here
constexpr double kWideCap = 1.2;         // radians: half-angles at which tips say nothing of the bend of the rim
constexpr std::size_t kLeastRows = 5;

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
  const double reach = kReach * curvature_.spacing;
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
  const bool ends = (rim.upper - rim.lower) / 2 > kAngleAbove * least_angle_;
  if (count == 0) return {sphere, ends ? blur : sphere};
  if (std::fabs(even) > kSmoothJump * sphere) {
    const double depth = 0.5 * (1 - std::fabs(share)) * (rim.upper - rim.lower) * radius;
    return {sphere, ends && depth > 0.5 * curvature_.spacing ? blur : std::fabs(even)};
  }
  // Legendre polynomials: the curve keeps its end points and its tangents there to first order.
  const double p2 = (3 * share * share - 1) / 2, p3 = (5 * share * share - 3) * share / 2;
  return {sphere + even * p2 + odd * p3, errors + std::fabs(even) / 2 + std::fabs(odd)};
}

TouchingBalls::Bends TouchingBalls::along_rim(const Rim& rim, double radius, const Eigen::Vector3d& u, double across,
                                              std::span<const Point> around) const {
  if ((rim.upper - rim.lower) / 2 < kWideCap && (rim.tips[0] != nullptr || rim.tips[1] != nullptr)) {
    // Of the tube around the rim, 1 / kappa = r + 1 / g, where g is linear in the normal: docs/theory.md.
    Eigen::Matrix2d rows = Eigen::Matrix2d::Zero();
    Eigen::Vector2d g = Eigen::Vector2d::Zero();
    double errors = 0, mean = 0, count = 0;
    for (int side = 0; side < 2; ++side) {
      if (rim.tips[side] == nullptr) continue;
      const TipCurvature& tip = *rim.tips[side];
      const Eigen::Vector3d normal = to_eigen(tip.normal), t = across_to(rim.along, normal);
      const double kappa = t.dot(shape_of(tip) * t);
      if (radius * kappa > 0.95) return {1 / radius, 1 / radius};
      rows.row(side) << normal.dot(rim.outward), normal.dot(rim.across);
      g[side] = kappa / (1 - radius * kappa);
      errors = std::max(errors, std::isnan(tip.error) ? 0 : tip.error);
      mean += kappa;
      ++count;
    }
    mean /= count;
    Eigen::Vector2d bend;
    if (count < 2) {
      const Eigen::RowVector2d row = rows.row(rim.tips[0] != nullptr ? 0 : 1);
      bend = {g.sum() / row[0], 0};
    } else {
      bend = rows.inverse() * g;
    }
    const double at_u = bend[0] * u.dot(rim.outward) + bend[1] * u.dot(rim.across);
    const double kappa = at_u / (1 + radius * at_u);
    if (1 + radius * at_u > 0) return {kappa, errors + std::fabs(kappa - mean)};
    return {mean, 1 / radius};
  }
  // From the heights of vertices on the cap, by least squares: two tilts, and the curvature along the rim.
  const Eigen::Vector3d t = across_to(rim.along, u), w = t.cross(u);
  const double angle = std::atan2(u.dot(rim.across), u.dot(rim.outward));
  const double sense = w.dot(rim.across) * u.dot(rim.outward) - w.dot(rim.outward) * u.dot(rim.across) > 0 ? 1 : -1;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0;
  std::size_t count = 0;
  for (const Point& q : around.subspan(1)) {
    const Eigen::Vector3d offset = to_eigen(q - around[0]);
    const double a = offset.dot(w), b = offset.dot(t), turn = angle + sense * a / radius;
    if (std::fabs(a) > 0.5 * radius || turn < rim.lower || turn > rim.upper || offset.dot(u) < -radius) continue;
    const Eigen::Vector3d row(a, b, -0.5 * b * b);
    const double height = offset.dot(u) + 0.5 * across * a * a;
    moments += row * row.transpose();
    right += height * row;
    squares += height * height;
    ++count;
  }
  if (count < kLeastRows) return {0, 1 / radius};
  const Eigen::Matrix3d inverse = moments.inverse();
  const Eigen::Vector3d found = inverse * right;
  const double residual = std::max(0.0, squares - found.dot(right)) / static_cast<double>(count - 3);
  const double error = 2 * std::sqrt(residual * inverse(2, 2));
  if (!(error < 1 / radius)) return {0, 1 / radius};  // nor if it is NaN: vertices on a line
  return {found[2], error};
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
  // Beside the tube around the rim: where the rim turns sharply, the ball touches in more than an arc.
  const double level = 0.5 * (to_eigen(curvature_.balls[ball].tips[0].normal).dot(rim.along) +
                              to_eigen(curvature_.balls[ball].tips[1].normal).dot(rim.along));
  if (std::fabs(u.dot(rim.along) - level) > std::max(0.2, 2 * curvature_.spacing / radius)) {
    out.at.shape = (Eigen::Matrix3d::Identity() - u * u.transpose()) / radius;
    out.at.error = (curvature_.spacing + gap) / square;
    return out;
  }
  find_tips(ball, rim);
  const double share = 2 * (angle - rim.lower) / (rim.upper - rim.lower) - 1;
  const Bends across = across_rim(rim, radius, share);
  const Bends along = along_rim(rim, radius, u, across.value, around);
  const Eigen::Vector3d t = across_to(rim.along, u), w = t.cross(u);
  out.at.shape = across.value * w * w.transpose() + along.value * t * t.transpose();
  out.at.error = std::max(across.error, along.error) + gap / square;
  return out;
}

}  // namespace medial_vk
