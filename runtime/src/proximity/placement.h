// Two bodies in a pose, the errors of numbers computed from it, and their distance.
#pragma once

#include <stop_token>

#include "base/point_ops.h"
#include "medial_vk/pose.h"
#include "proximity/body.h"
#include "proximity/tree_search.h"

namespace medial_vk {

/// No coordinate of a body is beyond.
constexpr double kLargestCoordinate = 1e18;

/// Where the frame of b lies in the frame of a, whose lengths are measured from the origin.
class Placement {
 public:
  /// No point of b is farther than `error` from where the pose takes it. All errors in double are at least 2^-49 of
  /// lengths(), which therefore grow.
  Placement(const BodyImpl& a, const BodyImpl& b, const Pose& pose, double error = 0)
      : pose_(pose),
        centre_a_(a.centre),
        centre_b_(b.centre),
        shift_(pose * b.centre - a.centre),
        distance_(length(shift_)),
        lengths_(length(a.centre) + length(b.centre) + length(pose.shift) + 0x1p49 * error),
        error_(error),
        float_pose_(is_in_range() ? Pose{pose.rotation, shift_} : Pose{}) {}

  const Pose& pose() const { return pose_; }
  /// The origins of the frames of the trees, each in the frame of its body.
  const Point& centre_a() const { return centre_a_; }
  const Point& centre_b() const { return centre_b_; }
  /// Of the frames of the trees.
  const FloatPose& float_pose() const { return float_pose_; }
  /// Of the centre of b from that of a, in the frame of a.
  const Point& shift() const { return shift_; }
  /// Between the origins of the frames of the trees.
  double distance() const { return distance_; }
  double error() const { return error_; }
  /// Of both origins and the shift. Lengths in double have errors that are small shares of this and the trees' reaches.
  double lengths() const { return lengths_; }

  /// False where squares of lengths may be too large for float. With numbers up to kLargestCoordinate each of three
  /// vectors is shorter than 2 kLargestCoordinate. A body reaches by less than 4 kLargestCoordinate from its centre, so
  /// no two of its points and those of the other one are farther apart than 14 kLargestCoordinate, and (14e18)^2 is a
  /// float.
  bool is_in_range() const { return distance_ <= 6 * kLargestCoordinate && lengths_ <= 6 * kLargestCoordinate; }

  /// The greatest difference between a computed separation of two balls of the trees, in float, and the separation of
  /// what they hold.
  double separation_error_of(const NodeTree& a, const NodeTree& b) const {
    return separation_error(a, b, distance_) + 0x1p-48 * lengths_;
  }

 private:
  const Pose& pose_;
  const Point& centre_a_;
  const Point& centre_b_;
  Point shift_;  // of the centre of b from that of a
  double distance_;
  double lengths_;
  double error_;
  FloatPose float_pose_;
};

/// distance(). Preconditions: both bodies have meshes; the options are good; the placement is in range. Throws
/// LoopStopped after a request to `stop`.
Distance distance_of(const BodyImpl& a, const BodyImpl& b, const Placement& placement, const DistanceOptions& options,
                     const Distance& start, const std::stop_token& stop = {});

/// Bounds by balls, below `most`: docs/theory.md, "Many bodies". No two balls of the covers are closer than the lower
/// bound; `pair` becomes the closest, if it is closer than `most`, and is where the search starts. Preconditions: both
/// bodies have such balls; the placement is in range.
double lower_bound(const BodyTree& a, const BodyTree& b, const Placement& placement, double most, BallPair& pair);
/// Two balls inside are as close, or `most` is less.
double upper_bound(const BodyImpl& a, const BodyImpl& b, const Placement& placement, double most, BallPair& pair);

}  // namespace medial_vk
