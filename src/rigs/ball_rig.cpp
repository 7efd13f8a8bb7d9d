#include "rigs/ball_rig.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "rigs/blend_weights.h"
#include "rigs/joint_stretch.h"

namespace medial_vk {
namespace {

/// Vertices up to this many radii from the centre decide which joints a ball has.
constexpr double kNear = 1.5;

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

using Joints = std::vector<std::uint32_t>;

/// The joints with the greatest shares in the motion of the surface near the ball: of all vertices within reach, the
/// nearer ones the more, or else of the nearest one.
Joints joints_near(const MotionRig& rig, std::span<const Point> vertices, const Ball& ball) {
  std::map<std::uint32_t, double> shares;
  const double reach = kNear * kNear * ball.radius * ball.radius;
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double squared = squared_distance(vertices[v], ball.centre);
    if (squared < least) {
      least = squared;
      nearest = v;
    }
    if (squared >= reach) continue;
    for (const RigInfluence& influence : rig.influences_of(v)) {
      shares[influence.joint] += (1 - squared / reach) * influence.weight;
    }
  }
  if (shares.empty()) {
    for (const RigInfluence& influence : rig.influences_of(nearest)) shares[influence.joint] += influence.weight;
  }
  std::vector<std::pair<double, std::uint32_t>> order;
  order.reserve(shares.size());
  for (const auto& [joint, share] : shares) order.emplace_back(-share, joint);
  std::ranges::sort(order);
  Joints joints;
  for (std::size_t i = 0; i < std::min(order.size(), kMostInfluences); ++i) joints.push_back(order[i].second);
  return joints;
}

/// The point that the map brings to `p`; no value: the map has no inverse.
std::optional<Point> unmapped(const AffineMap& map, const Point& p) {
  Eigen::Matrix3d linear;
  Eigen::Vector3d rest;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const std::array<double, 4>& row = map.rows()[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < 3; ++j) linear(i, j) = row[static_cast<std::size_t>(j)];
    rest[i] = p[static_cast<std::size_t>(i)] - row[3];
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(linear);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::Vector3d point = solver.solve(rest);
  if (!point.allFinite()) return std::nullopt;
  return Point{point[0], point[1], point[2]};
}

/// How far each joint alone would bring the centre from the ball that follows the mesh, frame after frame.
Eigen::MatrixXd offsets_of(std::span<const RiggedFrame> frames, std::size_t ball,
                           const std::vector<BallJoint>& joints) {
  Eigen::MatrixXd offsets =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * frames.size()), static_cast<Eigen::Index>(joints.size()));
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Ball& wanted = frames[f].balls[ball];
    if (!(wanted.radius > 0)) continue;  // lost: it has no place there
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const Point moved = frames[f].joints[joints[j].joint](joints[j].place);
      for (std::size_t k = 0; k < 3; ++k) {
        offsets(static_cast<Eigen::Index>(3 * f + k), static_cast<Eigen::Index>(j)) = moved[k] - wanted.centre[k];
      }
    }
  }
  return offsets;
}

/// The first joint for which the sum of the squares of the offsets is least.
Eigen::VectorXd nearest_joint(const Eigen::MatrixXd& offsets) {
  Eigen::Index nearest = 0;
  for (Eigen::Index j = 1; j < offsets.cols(); ++j) {
    if (offsets.col(j).squaredNorm() < offsets.col(nearest).squaredNorm()) nearest = j;
  }
  return Eigen::VectorXd::Unit(offsets.cols(), nearest);
}

RigBall bind_ball(const MotionRig& rig, std::span<const Point> vertices, std::span<const RiggedFrame> frames,
                  BallBinding binding, std::size_t i) {
  const Ball& at_rest = frames.front().balls[i];
  RigBall ball;
  ball.rest_radius = ball.radius = at_rest.radius;
  std::vector<BallJoint> joints;
  for (const std::uint32_t joint : joints_near(rig, vertices, at_rest)) {
    const std::optional<Point> place = unmapped(frames.front().joints[joint], at_rest.centre);
    if (place) joints.push_back({joint, 0, *place});
  }
  if (joints.empty()) {
    ball.radius = 0;
    return ball;
  }
  const Eigen::MatrixXd offsets = offsets_of(frames, i, joints);
  const Eigen::VectorXd weights = binding == BallBinding::kOneJoint ? nearest_joint(offsets) : blend_weights(offsets);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    joints[j].weight = weights[static_cast<Eigen::Index>(j)];
    if (joints[j].weight > 0) ball.joints.push_back(joints[j]);
  }
  return ball;
}

}  // namespace

double BallRig::greatest_reach_out() const {
  double greatest = 0;
  for (const RigBall& ball : balls) greatest = std::max(greatest, ball.reach_out);
  return greatest;
}

BallRig bind_balls(const MotionRig& rig, std::span<const Point> vertices, std::span<const RiggedFrame> frames,
                   BallBinding binding, const std::function<bool(double)>& goes_on) {
  BallRig bound;
  const std::size_t count = frames.front().balls.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!goes_on(static_cast<double>(i) / static_cast<double>(count))) break;
    bound.balls.push_back(bind_ball(rig, vertices, frames, binding, i));
  }
  bound.joint_stretches = greatest_stretches(frames);
  return bound;
}

std::vector<Point> posed_centres(const BallRig& rig, std::span<const AffineMap> joints) {
  std::vector<Point> centres;
  for (const RigBall& ball : rig.balls) {
    Point centre = {0, 0, 0};
    for (const BallJoint& bound : ball.joints) {
      const Point moved = joints[bound.joint](bound.place);
      for (std::size_t k = 0; k < 3; ++k) centre[k] += bound.weight * moved[k];
    }
    centres.push_back(centre);
  }
  return centres;
}

void limit_radii(std::span<const double> depths, BallRig& rig) {
  ++rig.frames;
  for (std::size_t i = 0; i < rig.balls.size(); ++i) {
    RigBall& ball = rig.balls[i];
    if (ball.joints.empty()) continue;  // it has no centre
    ball.radius = std::clamp(depths[i], 0.0, ball.radius);
    ball.reach_out = std::max(ball.reach_out, ball.rest_radius - depths[i]);
  }
}

}  // namespace medial_vk
