// Balls that the joints of an animated mesh move, blended as its vertices are.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "motion_files/mesh_motion.h"

namespace medial_vk {

/// The greatest number of joints of a ball: that of a vertex in most engines.
constexpr std::size_t kMostInfluences = 4;

/// What moves a ball.
enum class BallBinding : std::uint8_t {
  kBlended,   ///< Up to kMostInfluences joints, as a vertex.
  kOneJoint,  ///< One joint, as a node below it.
};

/// A joint of a ball.
struct BallJoint {
  std::uint32_t joint = 0;
  double weight = 0;
  Point place = {0, 0, 0};  ///< Of the ball's centre at rest, in the frame of the joint.
};

struct RigBall {
  /// 1 to kMostInfluences; the weights are positive, and their sum is 1. Where G are the joints of a frame, the centre
  /// there is the sum of weight * G[joint](place). None: no joint at rest has an inverse.
  std::vector<BallJoint> joints;
  double rest_radius = 0;  ///< Of the ball that follows the mesh, at rest.
  /// With it the ball is proved to be inside in every frame; 0: its centre leaves the solid in one of them.
  double radius = 0;
  /// An upper bound of the distance by which a ball of `rest_radius` reaches out of the solid in any frame.
  double reach_out = 0;
};

struct BallRig {
  std::vector<RigBall> balls;
  std::uint64_t frames = 0;  ///< For which the radii are proved: the rest pose and those of the motion.
  /// By joint: the greatest factor by which it lengthens a vector of its frame, in any of these frames.
  std::vector<double> joint_stretches;

  double greatest_reach_out() const;
};

/// The joints of one frame, and where the balls that follow the mesh are in it; radius 0: lost.
struct RiggedFrame {
  std::vector<AffineMap> joints;
  std::vector<Ball> balls;
};

/// Binds balls to the joints: of those that move the surface near a ball at rest, up to kMostInfluences, with the
/// weights for which the centre comes nearest to that of the ball that follows the mesh, in the least squares over all
/// frames; or to that one of them with which it comes nearest. At rest both are the same. `frames` begins with the rest
/// pose; `vertices` are those of the mesh there, as the rig has them. The radii are still to be limited. `goes_on` gets
/// the finished share and returns false to stop.
BallRig bind_balls(const MotionRig& rig, std::span<const Point> vertices, std::span<const RiggedFrame> frames,
                   BallBinding binding, const std::function<bool(double)>& goes_on);

/// The centres of the balls with the joints of a frame.
std::vector<Point> posed_centres(const BallRig& rig, std::span<const AffineMap> joints);

/// Takes a frame into account, of whose solid `depths` has a lower bound of the depth of each centre.
void limit_radii(std::span<const double> depths, BallRig& rig);

}  // namespace medial_vk
