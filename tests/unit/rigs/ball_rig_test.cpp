// Balls bound to joints: weights that are known, centres that follow, and radii that are limited by every frame.
#include "rigs/ball_rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rigs/blend_weights.h"
#include "rigs/joint_stretch.h"

namespace medial_vk {
namespace {

AffineMap shift(double x, double y, double z) {
  return AffineMap(AffineMap::Rows{{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}}});
}

AffineMap turn_about_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return AffineMap(AffineMap::Rows{{{c, -s, 0, 0}, {s, c, 0, 0}, {0, 0, 1, 0}}});
}

/// Two joints, at the origin and at (2, 0, 0), and vertices along the x axis from -1 to 5, of which those up to 1 move
/// with the first joint, those from 3 on with the second, and those between with both.
struct Arm {
  MotionRig rig;
  std::vector<Point> vertices;

  Arm() {
    rig.joints.resize(2);
    rig.joints[1].parent = 0;
    rig.joints[1].inverse_bind = shift(-2, 0, 0);
    rig.joints[1].rest = shift(2, 0, 0);
    for (int i = -4; i <= 20; ++i) {
      const double x = 0.25 * i, second = std::min(1.0, std::max(0.0, (x - 1) / 2));
      rig.first_influence.push_back(rig.influences.size());
      if (second < 1) rig.influences.push_back({0, 1 - second});
      if (second > 0) rig.influences.push_back({1, second});
      vertices.push_back({x, 0.5, 0});
    }
    rig.first_influence.push_back(rig.influences.size());
    rig.bind_positions = vertices;
  }

  std::vector<AffineMap> pose(double angle) const { return {shift(0, 1, 0), shift(2, 1, 0) * turn_about_z(angle)}; }
};

constexpr auto kGoOn = [](double) { return true; };

std::vector<std::uint32_t> joints_of(const RigBall& ball) {
  std::vector<std::uint32_t> joints;
  for (const BallJoint& bound : ball.joints) joints.push_back(bound.joint);
  return joints;
}

TEST(BlendWeights, OfPlacesThatOneBlendReaches) {
  // Two joints that move apart along x; the wanted place is a quarter of the way from the second to the first.
  Eigen::MatrixXd offsets(6, 2);
  offsets << 3, -1, 0, 0, 0, 0, 6, -2, 0, 0, 0, 0;
  const Eigen::VectorXd weights = blend_weights(offsets);
  EXPECT_NEAR(weights[0], 0.25, 1e-15);
  EXPECT_NEAR(weights[1], 0.75, 1e-15);
}

TEST(BlendWeights, AreNotNegative) {
  // The line through both leads to the wanted place only beyond the first.
  Eigen::MatrixXd offsets(3, 2);
  offsets << 1, 3, 0, 0, 0, 0;
  EXPECT_EQ(blend_weights(offsets), Eigen::Vector2d(1, 0));
  // Joints that move alike: any weights would do, and the first subset is taken.
  EXPECT_EQ(blend_weights(Eigen::MatrixXd::Ones(3, 3)), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(blend_weights(Eigen::MatrixXd::Zero(3, 4)), Eigen::Vector4d(1, 0, 0, 0));
}

TEST(BlendWeights, OfFourJointsAreTheMinimum) {
  Eigen::MatrixXd offsets(9, 4);
  for (Eigen::Index i = 0; i < offsets.size(); ++i) offsets.data()[i] = std::sin(7.0 * static_cast<double>(i) + 1);
  const Eigen::VectorXd best = blend_weights(offsets);
  EXPECT_NEAR(best.sum(), 1, 1e-15);
  EXPECT_GE(best.minCoeff(), 0);
  const double least = (offsets * best).squaredNorm();
  for (int a = 0; a <= 10; ++a) {
    for (int b = 0; a + b <= 10; ++b) {
      for (int c = 0; a + b + c <= 10; ++c) {
        const Eigen::Vector4d other(0.1 * a, 0.1 * b, 0.1 * c, 0.1 * (10 - a - b - c));
        EXPECT_GE((offsets * other).squaredNorm(), least * (1 - 1e-12));
      }
    }
  }
}

AffineMap scaled(double x, double y, double z) {
  return AffineMap(AffineMap::Rows{{{x, 0, 0, 9}, {0, y, 0, 9}, {0, 0, z, 9}}});
}

TEST(JointStretch, IsTheLargestSingularValue) {
  EXPECT_EQ(greatest_stretch(AffineMap()), 1);
  EXPECT_EQ(greatest_stretch(scaled(1, -4, 2)), 4) << "of a reflection, too, and without the translation";
  EXPECT_EQ(greatest_stretch(scaled(0, 0, 0)), 0);
  // A turn before or after changes nothing but roundings: some ten operations on numbers up to the square of 4.
  const double some_roundings = 64 * std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(greatest_stretch(turn_about_z(0.7) * scaled(1, 4, 2) * turn_about_z(-2)), 4, some_roundings);
  // A shear by 1: the squares of its singular values solve s^2 - 3 s + 1 = 0, so the larger value is the golden ratio.
  const AffineMap shear(AffineMap::Rows{{{1, 1, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}});
  EXPECT_NEAR(greatest_stretch(shear), 0.5 + std::sqrt(1.25), some_roundings);
  // Squares of these numbers are no doubles.
  EXPECT_NEAR(greatest_stretch(scaled(1e200, 1e-200, 0)) / 1e200, 1, some_roundings);
  EXPECT_NEAR(greatest_stretch(scaled(1e-200, 1e-201, 0)) / 1e-200, 1, some_roundings);
  EXPECT_EQ(greatest_stretch(scaled(1, std::numeric_limits<double>::infinity(), 1)),
            std::numeric_limits<double>::infinity());
}

TEST(JointStretch, IsTheGreatestOfAllFrames) {
  const Arm arm;
  const Ball ball = {{-0.5, 1.1, 0}, 0.3};
  // The first joint stretches at rest, the second in a later frame.
  const std::vector<RiggedFrame> frames = {{{scaled(1, 4, 1), scaled(1, 1, 0.5)}, {ball}},
                                           {{scaled(2, 1, 1), scaled(1, 1, 3)}, {ball}},
                                           {{scaled(1, 1, 1), scaled(0.25, 0.5, 1)}, {ball}}};
  for (const BallBinding binding : {BallBinding::kBlended, BallBinding::kOneJoint}) {
    const BallRig bound = bind_balls(arm.rig, arm.vertices, frames, binding, kGoOn);
    EXPECT_EQ(bound.joint_stretches, (std::vector<double>{4, 3}));
  }
}

TEST(BallRig, RigidPartsFollowTheirJointExactly) {
  const Arm arm;
  const std::vector<RiggedFrame> frames = {
      {arm.pose(0), {{{-0.5, 1.1, 0}, 0.3}, {{4.5, 1, 0.1}, 0.25}}},
      {arm.pose(1), {{{-0.5, 1.1, 0}, 0.3}, {arm.pose(1)[1]({2.5, 0, 0.1}), 0.25}}}};
  const BallRig bound = bind_balls(arm.rig, arm.vertices, frames, BallBinding::kBlended, kGoOn);
  ASSERT_EQ(bound.balls.size(), 2u);
  EXPECT_EQ(joints_of(bound.balls[0]), std::vector<std::uint32_t>{0});
  EXPECT_EQ(joints_of(bound.balls[1]), std::vector<std::uint32_t>{1});
  EXPECT_NEAR(bound.balls[1].joints[0].place[0], 2.5, 1e-12) << "in the frame of the joint";
  for (const RiggedFrame& frame : frames) {
    const std::vector<Point> centres = posed_centres(bound, frame.joints);
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(centres[i][k], frame.balls[i].centre[k], 1e-12);
    }
  }
}

TEST(BallRig, NearTheJointBothMoveABall) {
  const Arm arm;
  // The ball that follows moves as the blend of both, half and half.
  std::vector<RiggedFrame> frames;
  for (const double angle : {0.0, 0.3, 0.6}) {
    const std::vector<AffineMap> joints = arm.pose(angle);
    const Point first = joints[0]({2.2, 0.1, 0}), second = joints[1]({0.2, 0.1, 0});
    Point centre;
    for (std::size_t k = 0; k < 3; ++k) centre[k] = 0.5 * (first[k] + second[k]);
    frames.push_back({joints, {{centre, 0.4}}});
  }
  const BallRig bound = bind_balls(arm.rig, arm.vertices, frames, BallBinding::kBlended, kGoOn);
  ASSERT_EQ(bound.balls[0].joints.size(), 2u);
  EXPECT_NEAR(bound.balls[0].joints[0].weight, 0.5, 1e-9);
  for (const RiggedFrame& frame : frames) {
    const Point centre = posed_centres(bound, frame.joints)[0];
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(centre[k], frame.balls[0].centre[k], 1e-9);
  }
}

TEST(BallRig, OneJointIsTheOneThatStaysNearest) {
  const Arm arm;
  // The ball that follows is nearer to the first joint: three quarters of its motion are that of the first.
  std::vector<RiggedFrame> frames;
  for (const double angle : {0.0, 0.3, 0.6}) {
    const std::vector<AffineMap> joints = arm.pose(angle);
    const Point first = joints[0]({2.2, 0.1, 0}), second = joints[1]({0.2, 0.1, 0});
    Point centre;
    for (std::size_t k = 0; k < 3; ++k) centre[k] = 0.75 * first[k] + 0.25 * second[k];
    frames.push_back({joints, {{centre, 0.4}}});
  }
  const BallRig bound = bind_balls(arm.rig, arm.vertices, frames, BallBinding::kOneJoint, kGoOn);
  EXPECT_EQ(joints_of(bound.balls[0]), std::vector<std::uint32_t>{0});
  EXPECT_EQ(bound.balls[0].joints[0].weight, 1);
  const Point centre = posed_centres(bound, frames[0].joints)[0];
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(centre[k], frames[0].balls[0].centre[k], 1e-12) << "at rest";
}

TEST(BallRig, NodesWithFramesOfTheirOwnKeepTheirBalls) {
  // Two nodes whose frames differ move two parts that touch: each ball belongs to one node, whole.
  MotionRig rig;
  rig.joints.resize(2);
  rig.joints[1].rest = shift(7, 0, 0) * turn_about_z(2);
  const std::vector<Point> vertices = {{0, 0, 0}, {1, 0, 0}, {1.1, 0, 0}, {2, 0, 0}};
  rig.influences = {{0, 1}, {0, 1}, {1, 1}, {1, 1}};
  rig.first_influence = {0, 1, 2, 3, 4};
  std::vector<RiggedFrame> frames;
  for (const double t : {0.0, 0.5, 1.0}) {
    const AffineMap first = shift(0, t, 0), second = shift(0, 0, 3 * t) * turn_about_z(t);
    frames.push_back({{first, second * rig.joints[1].rest}, {{first({0.6, 0, 0}), 0.5}, {second({1.5, 0, 0}), 0.5}}});
  }
  const BallRig bound = bind_balls(rig, vertices, frames, BallBinding::kBlended, kGoOn);
  for (const RiggedFrame& frame : frames) {
    const std::vector<Point> centres = posed_centres(bound, frame.joints);
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(centres[i][k], frame.balls[i].centre[k], 1e-12);
    }
  }
}

TEST(BallRig, JointsWithoutAnInverseMoveNothing) {
  const Arm arm;
  std::vector<AffineMap> flat = arm.pose(0);
  flat[1] = AffineMap(AffineMap::Rows{{{0, 0, 0, 2}, {0, 1, 0, 1}, {0, 0, 1, 0}}});
  const std::vector<RiggedFrame> frames = {{flat, {{{4.5, 1, 0}, 0.25}}}};
  const BallRig bound = bind_balls(arm.rig, arm.vertices, frames, BallBinding::kBlended, kGoOn);
  EXPECT_TRUE(bound.balls[0].joints.empty());
  EXPECT_EQ(bound.balls[0].radius, 0);
}

TEST(BallRig, EveryFrameLimitsTheRadii) {
  BallRig rig;
  rig.balls.resize(3);
  for (RigBall& ball : rig.balls) {
    ball.rest_radius = ball.radius = 1;
    ball.joints = {{0, 1, {0, 0, 0}}};
  }
  limit_radii(std::vector<double>{1, 1, 2}, rig);
  limit_radii(std::vector<double>{0.75, -0.5, 1.5}, rig);
  limit_radii(std::vector<double>{0.875, 1, 1}, rig);
  EXPECT_EQ(rig.frames, 3u);
  EXPECT_EQ(rig.balls[0].radius, 0.75);
  EXPECT_EQ(rig.balls[0].reach_out, 0.25);
  EXPECT_EQ(rig.balls[1].radius, 0) << "its centre is outside in one frame";
  EXPECT_EQ(rig.balls[1].reach_out, 1.5);
  EXPECT_EQ(rig.balls[2].radius, 1);
  EXPECT_EQ(rig.balls[2].reach_out, 0);
  EXPECT_EQ(rig.greatest_reach_out(), 1.5);
}

TEST(BallRig, ALostBallBindsByTheOtherFrames) {
  const Arm arm;
  const std::vector<RiggedFrame> frames = {{arm.pose(0), {{{4.5, 1, 0}, 0.25}}}, {arm.pose(1), {{{9, 9, 9}, 0}}}};
  const BallRig bound = bind_balls(arm.rig, arm.vertices, frames, BallBinding::kBlended, kGoOn);
  EXPECT_EQ(joints_of(bound.balls[0]), std::vector<std::uint32_t>{1});
}

}  // namespace
}  // namespace medial_vk
