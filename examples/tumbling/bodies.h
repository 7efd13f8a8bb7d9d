// Rigid bodies that bounce in a box, with contacts found by the library.
#pragma once

#include <medial_vk/proximity.h>

#include <array>
#include <random>

#include "vectors.h"

namespace tumbling {

/// Mass 1; its inertia is that of the balls inside.
struct RigidBody {
  Vector place = {0, 0, 0};  ///< Of the centre of mass, in the world.
  Quaternion turn = {1, 0, 0, 0};
  Vector velocity = {0, 0, 0}, spin = {0, 0, 0};
};

/// Two copies of a solid in a cube around the origin.
class Tumbling {
 public:
  /// `solid` has a mesh, balls inside and a cover; `side` is its longest side.
  Tumbling(const medial_vk::Body& solid, double side);

  /// Moves on by a sixtieth of a second.
  medial_vk::Status step();

  /// Of the frame of the solid, for both copies.
  medial_vk::Pose pose(std::size_t body) const;
  /// Of the second copy in the frame of the first.
  medial_vk::Pose relative_pose() const;
  double half_of_box() const { return half_; }

 private:
  void bounce_off_walls(RigidBody& body);
  void bounce_off_each_other(const medial_vk::Distance& distance);
  Vector change_of_spin(const RigidBody& body, const Vector& arm, const Vector& impulse) const;
  double give(const RigidBody& body, const Vector& arm, const Vector& normal) const;
  Vector velocity_at(const RigidBody& body, const Vector& arm) const { return body.velocity + cross(body.spin, arm); }

  const medial_vk::Body& solid_;
  double side_, half_;
  Vector middle_ = {0, 0, 0};  // the centre of mass, in the frame of the solid
  Matrix inverse_inertia_ = {};
  std::array<RigidBody, 2> bodies_;
  medial_vk::Distance last_;
  std::mt19937_64 random_{7};
  Vector gravity_ = {0, 0, 0};
  int steps_ = 0;
};

}  // namespace tumbling
