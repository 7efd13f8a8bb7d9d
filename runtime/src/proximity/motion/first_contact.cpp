#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stop_token>

#include "proximity/placement.h"

namespace medial_vk {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d to_eigen(const Point& p) { return {p[0], p[1], p[2]}; }
Point to_point(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Matrix3d matrix_of(const Pose& pose) {
  Matrix3d matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = to_eigen(pose.rotation[static_cast<std::size_t>(i)]);
  return matrix;
}

Pose pose_of(const Matrix3d& rotation, const Vector3d& shift) {
  Pose pose;
  for (int i = 0; i < 3; ++i) pose.rotation[static_cast<std::size_t>(i)] = to_point(rotation.row(i));
  pose.shift = to_point(shift);
  return pose;
}

/// The pivot moves by `along`, and everything turns about it by `angle` about `axis`, at a constant rate.
class Path {
 public:
  explicit Path(const Motion& motion)
      : from_(matrix_of(motion.from)),
        pivot_(to_eigen(motion.pivot)),
        start_(from_ * pivot_ + to_eigen(motion.from.shift)),
        along_(matrix_of(motion.to) * pivot_ + to_eigen(motion.to.shift) - start_) {
    const Eigen::AngleAxisd turn(Eigen::Quaterniond(matrix_of(motion.to) * from_.transpose()).normalized());
    angle_ = turn.angle();
    axis_ = turn.axis();
  }

  Pose at(double t) const {
    const Matrix3d rotation = Eigen::AngleAxisd(t * angle_, axis_).toRotationMatrix() * from_;
    return pose_of(rotation, start_ + t * along_ - rotation * pivot_);
  }

  /// No point within `radius` of the pivot moves farther while t grows by one. A rotation that is one to within 1e-12
  /// stretches lengths by less than 2^-38.
  double speed(double radius) const { return (along_.norm() + angle_ * radius) * (1 + 0x1p-38); }
  /// Of lengths that at() computes with.
  double size() const { return start_.norm() + along_.norm() + pivot_.norm(); }

 private:
  Matrix3d from_;
  Vector3d pivot_, start_, along_;
  double angle_ = 0;
  Vector3d axis_ = Vector3d::UnitZ();
};

/// Conservative advancement: while the distance is at least d, no motion of less than d leads to contact.
class Advance {
 public:
  Advance(const Body& a, const Body& b, const Motion& motion, const ContactOptions& options,
          const std::stop_token& stop)
      : a_(a), b_(b), path_(motion), options_(options), stop_(stop) {
    const BodyImpl& in_b = Internals::of(b);
    const double radius = in_b.surface->tree.nodes().reach() + length(in_b.centre - motion.pivot);
    speed_ = path_.speed(radius);
    // Rotations are exact to 32 u an entry, and a point so to less than 128 u times its lengths.
    error_ = 128 * 0x1p-53 * (path_.size() + radius);
    of_distance_.surfaces_only = options.surfaces_only;
  }

  Result<FirstContact> run() {
    for (double t = 0;;) {
      if (Status status = look(t); !status) return status.error();
      if (is_contact()) {
        contact_.contact_at = t;
        break;
      }
      const double step = (contact_.nearest.lower - options_.clearance - error_) / speed_;
      if (!(step >= options_.tolerance)) break;
      contact_.free_until = std::min(1.0, t + step);
      if (contact_.free_until == 1) return contact_;
      t = contact_.free_until;
    }
    return find_contact();
  }

 private:
  Status look(double t) {
    Result<Distance> found = distance(a_, b_, path_.at(t), of_distance_, contact_.nearest, stop_);
    if (!found) return found.error();
    contact_.nearest = found.value();
    return {};
  }

  bool is_contact() const {
    return contact_.nearest.upper == 0 || contact_.nearest.upper + error_ <= options_.clearance;
  }

  /// The bodies are near, or in contact: tries ever longer steps until they are, then halves the time between.
  Result<FirstContact> find_contact() {
    for (double step = options_.tolerance; contact_.contact_at > 1 && contact_.free_until < 1; step *= 2) {
      const double t = std::min(1.0, contact_.free_until + step);
      if (Status status = look(t); !status) return status.error();
      if (is_contact()) contact_.contact_at = t;
      if (t == 1) break;
    }
    if (contact_.contact_at > 1) return contact_;
    double without = contact_.free_until;
    while (contact_.contact_at - without > options_.tolerance) {
      const double middle = 0.5 * (without + contact_.contact_at);
      if (Status status = look(middle); !status) return status.error();
      (is_contact() ? contact_.contact_at : without) = middle;
    }
    if (Status status = look(contact_.contact_at); !status) return status.error();
    return contact_;
  }

  const Body& a_;
  const Body& b_;
  Path path_;
  const ContactOptions& options_;
  const std::stop_token& stop_;
  DistanceOptions of_distance_;
  double speed_ = 0, error_ = 0;
  FirstContact contact_;
};

Status check(const ContactOptions& options) {
  if (!(options.clearance >= 0)) return Error{ErrorCode::kUsage, "`clearance` must not be negative"};
  if (!(options.tolerance >= 1e-12)) return Error{ErrorCode::kUsage, "`tolerance` of a motion must be at least 1e-12"};
  return {};
}

}  // namespace

Pose pose_at(const Motion& motion, double t) { return Path(motion).at(t); }

Result<FirstContact> first_contact(const Body& a, const Body& b, const Motion& motion, const ContactOptions& options,
                                   const std::stop_token& stop) {
  if (Status status = check(options); !status) return status.error();
  if (!a.has_mesh() || !b.has_mesh()) {
    return Error{ErrorCode::kUsage, "a first contact needs bodies that were created with their meshes"};
  }
  return Advance(a, b, motion, options, stop).run();
}

}  // namespace medial_vk
