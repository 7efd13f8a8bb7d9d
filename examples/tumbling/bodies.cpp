#include "bodies.h"

#include <algorithm>

namespace tumbling {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr int kStepsOfFrame = 6;
constexpr double kBounce = 0.9;     // the share of the speed that a bounce keeps
constexpr double kKept = 0.9995;    // and of all speeds that a step keeps
constexpr double kFastest = 2;      // sides a second
constexpr double kFastestSpin = 4;  // radians a second
// Sides: more than bodies approach each other in a step, at these speeds, with points at most 0.6 sides from the
// middle.
constexpr double kContact = 0.03;
constexpr int kFramesOfGravity = 45;

Vector random_direction(std::mt19937_64& random) {
  std::normal_distribution<> normal;
  const Vector d = {normal(random), normal(random), normal(random)};
  return (1 / length(d)) * d;
}

void limit(Vector& v, double most) {
  if (length(v) > most) v = (most / length(v)) * v;
}

}  // namespace

Tumbling::Tumbling(const medial_vk::Body& solid, double side) : solid_(solid), side_(side), half_(0.95 * side) {
  double mass = 0;
  for (const medial_vk::Ball& ball : solid.inside()) {
    const double m = std::pow(ball.radius, 3);
    mass += m;
    middle_ = middle_ + m * ball.centre;
  }
  middle_ = (1 / mass) * middle_;
  Matrix inertia = {};
  for (const medial_vk::Ball& ball : solid.inside()) {
    const double m = std::pow(ball.radius, 3) / mass;
    const Vector d = ball.centre - middle_;
    for (std::size_t i = 0; i < 3; ++i) {
      inertia[i][i] += m * (dot(d, d) + 0.4 * ball.radius * ball.radius);
      for (std::size_t j = 0; j < 3; ++j) inertia[i][j] -= m * d[i] * d[j];
    }
  }
  inverse_inertia_ = inverse_of(inertia);
  bodies_[0].place = {-0.5 * side, 0, 0.3 * side};
  bodies_[1].place = {0.5 * side, 0, -0.3 * side};
  bodies_[0].spin = {0.6, 0.8, 0.2};
  bodies_[1].spin = {-0.4, 0.9, -0.5};
}

medial_vk::Pose Tumbling::pose(std::size_t body) const {
  const RigidBody& b = bodies_[body];
  const Matrix rotation = rotation_of(b.turn);
  return {rotation, b.place - rotation * middle_};
}

medial_vk::Pose Tumbling::relative_pose() const {
  const medial_vk::Pose a = pose(0), b = pose(1);
  const Matrix to_a = transposed(a.rotation);
  medial_vk::Pose relative;
  for (std::size_t i = 0; i < 3; ++i) relative.rotation[i] = transposed(b.rotation) * to_a[i];
  relative.shift = to_a * (b.shift - a.shift);
  return relative;
}

medial_vk::Status Tumbling::step() {
  for (int i = 0; i < kStepsOfFrame; ++i) {
    if (steps_++ % (kFramesOfGravity * kStepsOfFrame) == 0) gravity_ = 1.2 * side_ * random_direction(random_);
    constexpr double kTime = kFrame / kStepsOfFrame;
    for (RigidBody& body : bodies_) {
      body.velocity = kKept * (body.velocity + kTime * gravity_);
      body.spin = kKept * body.spin;
      limit(body.velocity, kFastest * side_);
      limit(body.spin, kFastestSpin);
      body.place = body.place + kTime * body.velocity;
      body.turn = turned(body.turn, body.spin, kTime);
      bounce_off_walls(body);
    }
    const auto found = medial_vk::distance(solid_, solid_, relative_pose(), {}, last_);
    if (!found) return found.error();
    last_ = found.value();
    if (last_.upper < kContact * side_) bounce_off_each_other(last_);
  }
  return {};
}

/// A torque about the centre of mass, in the world, as a change of the spin.
Vector Tumbling::change_of_spin(const RigidBody& body, const Vector& arm, const Vector& impulse) const {
  const Matrix rotation = rotation_of(body.turn);
  return rotation * (inverse_inertia_ * (transposed(rotation) * cross(arm, impulse)));
}

/// The change of the speed of a point along `normal` for an impulse of 1 there.
double Tumbling::give(const RigidBody& body, const Vector& arm, const Vector& normal) const {
  return 1 + dot(normal, cross(change_of_spin(body, arm, normal), arm));
}

/// The cover holds the solid: no point of the solid passes a wall that its balls do not pass.
void Tumbling::bounce_off_walls(RigidBody& body) {
  const Matrix rotation = rotation_of(body.turn);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double toward : {-1.0, 1.0}) {
      double deepest = 0;
      Vector arm = {0, 0, 0};
      for (const medial_vk::Ball& ball : solid_.cover()) {
        const Vector from = rotation * (ball.centre - middle_);
        const double beyond = toward * (body.place[axis] + from[axis]) + ball.radius - half_;
        if (beyond > deepest) deepest = beyond, arm = from;
      }
      if (deepest == 0) continue;
      body.place[axis] -= toward * deepest;
      Vector normal = {0, 0, 0};
      normal[axis] = -toward;
      const double speed = dot(normal, velocity_at(body, arm));
      if (speed >= 0) continue;
      const Vector impulse = (-(1 + kBounce) * speed / give(body, arm, normal)) * normal;
      body.velocity = body.velocity + impulse;
      body.spin = body.spin + change_of_spin(body, arm, impulse);
    }
  }
}

/// At the nearest points, along the line between them.
void Tumbling::bounce_off_each_other(const medial_vk::Distance& distance) {
  auto& [a, b] = bodies_;
  const medial_vk::Pose to_world = pose(0);
  const Vector on_a = to_world * distance.on_a, on_b = to_world * distance.on_b;
  const Vector apart = distance.lower > 0 ? on_b - on_a : b.place - a.place;
  const Vector normal = (1 / length(apart)) * apart;
  const Vector arm_a = on_a - a.place, arm_b = on_b - b.place;
  const double speed = dot(normal, velocity_at(b, arm_b) - velocity_at(a, arm_a));
  if (speed >= 0) return;
  const double size = -(1 + kBounce) * speed / (give(a, arm_a, normal) + give(b, arm_b, normal));
  a.velocity = a.velocity - size * normal;
  b.velocity = b.velocity + size * normal;
  a.spin = a.spin - change_of_spin(a, arm_a, size * normal);
  b.spin = b.spin + change_of_spin(b, arm_b, size * normal);
}

}  // namespace tumbling
