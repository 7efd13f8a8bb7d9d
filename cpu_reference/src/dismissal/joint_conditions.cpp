#include "dismissal/joint_conditions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

constexpr int kJointSteps = 24;
constexpr double kOverstep = 1.3;    // of a step to the plane of the condition that is violated most
constexpr double kWidestAxis = 0.7;  // half-angle of a cap whose axis bounds distances
// Spokes to faces are within kFaceAngle of normals, which are right to 5e-10, and axes of caps to as much.
constexpr double kTurn = 4 * kFaceAngle;

/// c + v . x for x from the centre of the box.
struct Linear {
  Vector3d v;
  double c;

  Linear operator-(const Linear& other) const { return {v - other.v, c - other.c}; }
  Linear operator*(double factor) const { return {v * factor, c * factor}; }
};

struct JointCondition {
  Linear value;  // not below -error
  double error;
};

Linear half_space(const Vector3d& direction, const Vector3d& start) { return {direction, -direction.dot(start)}; }

/// Linear bounds of the distance of a point with a spoke to a carrier.
struct Bounds {
  Linear lower, upper;
  double error;
};

class Conditions {
 public:
  Conditions(const Box& box, double angle, double rounding) : box_(box), angle_(angle), rounding_(rounding) {}

  void add_pair(const Carrier& a, const Carrier& b) {
    const Bounds of_a = bounds_of(a), of_b = bounds_of(b);
    add(of_a.upper - of_b.lower, of_a.error + of_b.error);
    add(of_b.upper - of_a.lower, of_a.error + of_b.error);
    add_feet(a);
    add_feet(b);
    add_turn(a, b, of_b);
    add_turn(b, a, of_a);
  }

  void add_third(const Carrier& a, const Carrier& third) {
    if (third.distance <= 0) return;
    const Bounds of_a = bounds_of(a);
    add(tangent(third, bend(third)) - of_a.lower, of_a.error + 8 * rounding_);
  }

  /// False if a mixture of them with positive weights is negative in the whole box.
  bool can_hold() const {
    Vector3d x = Vector3d::Zero();
    Linear sum = {Vector3d::Zero(), 0};
    double sum_error = 0;
    for (int step = 0; step < kJointSteps; ++step) {
      const auto excess = [&](const JointCondition& k) {
        return (k.value.c + k.value.v.dot(x) + k.error) / std::max(k.value.v.norm(), 1e-9);
      };
      const auto worst = std::ranges::min_element(all_, {}, excess);
      if (excess(*worst) >= 0) return true;
      const double weight = -excess(*worst) / std::max(worst->value.v.norm(), 1e-9);
      const Linear next = worst->value * weight;
      sum = {sum.v + next.v, sum.c + next.c};
      sum_error += weight * worst->error;
      if (sum.c + box_.support(sum.v) * (1 + 1e-12) + sum_error < 0) return false;
      x = (x + kOverstep * next.v).cwiseMin(box_.half).cwiseMax(-box_.half);
    }
    return true;
  }

 private:
  void add(const Linear& value, double error) { all_.push_back({value, error}); }

  static bool is_trusted(const Carrier& k) { return k.triangle_corners[0] < 0; }
  Vector3d corner(const Carrier& k, int i) const { return k.corners[i] - box_.centre; }
  Vector3d along(const Carrier& edge) const { return (edge.corners[1] - edge.corners[0]).normalized(); }

  double error_at(const Carrier& k) const {
    double reach = box_.reach();
    for (int i = 0; i < k.corner_count; ++i) reach = std::max(reach, corner(k, i).norm() + box_.reach());
    return 8 * rounding_ + kTurn * reach;
  }

  double bend(const Carrier& k) const { return box_.half.squaredNorm() / (2 * std::max(k.distance, 1e-300)); }
  Linear tangent(const Carrier& k, double bend) const { return {-k.direction, k.distance + bend}; }

  /// By the axis of its cap, if that is perpendicular to the carrier, or by the tangent at the nearest point.
  Bounds bounds_of(const Carrier& k) const {
    const bool has_axis = k.spokes.angle < kWidestAxis && (k.spokes.axis - k.direction).norm() > 1e-9;
    // The direction has an error of 2 rounding / distance.
    const double turn = k.distance > 0 ? box_.reach() / k.distance : 0;
    if (!has_axis) return {tangent(k, 0), tangent(k, bend(k)), 8 * rounding_ * (1 + turn)};
    const Linear lower = half_space(-k.spokes.axis, corner(k, 0));
    return {lower, lower * (1 / k.spokes.cosine), 2 * error_at(k)};
  }

  /// The foot is inside the face or the edge, and spokes to an edge are between the normals beside it.
  void add_feet(const Carrier& k) {
    const double error = error_at(k);
    if (k.corner_count == 3 && k.normal_count == 1 && is_trusted(k)) {
      for (int i = 0; i < 3; ++i) {
        const Vector3d side = (k.corners[(i + 1) % 3] - k.corners[i]).normalized();
        add(half_space(k.normals[0].cross(side), corner(k, i)), error);
      }
    }
    if (k.corner_count != 2) return;
    const Vector3d u = along(k);
    add(half_space(u, corner(k, 0)), error);
    add(half_space(-u, corner(k, 1)), error);
    if (k.normal_count != 2 || !is_trusted(k)) return;
    add(half_space(-k.normals[0].cross(u), corner(k, 0)), error);
    add(half_space(k.normals[1].cross(u), corner(k, 0)), error);
  }

  /// The spoke to the edge or vertex a is 2 * angle from one of the cap of b.
  void add_turn(const Carrier& a, const Carrier& b, const Bounds& of_b) {
    const double least = std::max(0.0, 2 * angle_ - b.spokes.angle);
    if (a.corner_count == 3 || b.spokes.holds_all() || least >= std::numbers::pi / 2) return;
    Vector3d across = b.spokes.axis;
    if (a.corner_count == 2) across -= across.dot(along(a)) * along(a);
    const Linear value = half_space(across, corner(a, 0)), most = of_b.upper * std::cos(least);
    add({value.v + most.v, value.c + most.c}, error_at(a) + of_b.error);
  }

  const Box& box_;
  double angle_, rounding_;
  std::vector<JointCondition> all_;
};

}  // namespace

bool can_hold_jointly(const Carrier& a, const Carrier& b, std::span<const Carrier> others, const Box& box, double angle,
                      double rounding) {
  Conditions conditions(box, angle, rounding);
  conditions.add_pair(a, b);
  for (const Carrier& third : others) {
    if (&third == &a || &third == &b) continue;
    conditions.add_third(a, third);
    conditions.add_third(b, third);
  }
  return conditions.can_hold();
}

}  // namespace medial_vk::reference
