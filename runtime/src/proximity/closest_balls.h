// The closest two balls of two trees: docs/theory.md, "Distances".
#pragma once

#include <array>

#include "medial_vk/pose.h"
#include "medial_vk/proximity.h"
#include "proximity/body_tree.h"

namespace medial_vk {

/// A pose between the frames of two trees, whose origins are the centres of their bodies.
struct FloatPose {
  std::array<std::array<float, 3>, 3> rows;  ///< Of the rotation.
  std::array<float, 3> shift;

  explicit FloatPose(const Pose& pose);

  std::array<float, 3> to_a(const std::array<float, 3>& p) const {
    std::array<float, 3> out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = rows[i][0] * p[0] + rows[i][1] * p[1] + rows[i][2] * p[2] + shift[i];
    return out;
  }
};

/// The separation of two balls is the distance between their centres less both radii: negative if they overlap.
struct ClosestBalls {
  float separation = 0;
  BallPair balls;
};

/// The greatest error of a computed separation of two balls of the trees, where the origins of the two frames are
/// `distance` apart. Let M be the sum of the two reaches and `distance`, which bounds every length below, and u =
/// 2^-24. A centre in the other frame costs, in each coordinate, one rounding of the entries of the rotation and of the
/// shift, and four of products and sums: 5.1 u times a sum of absolute values that is at most M. The vector so has an
/// error of sqrt(3) 5.1 u M < 9 u M, its difference to the other centre one of u M more, its length 4 u M more, and the
/// sum of the radii and the last difference 2 u M more: 16 u M. A comparison of squares, of a distance and of a sum of
/// a separation and two radii, in the place of a square root has no more roundings. Rows that are perpendicular unit
/// vectors only to within 1e-12 add less than u M. Squares may underflow, also to zero where a program has no subnormal
/// numbers: each by less than 2^-125, and a length by less than 2^-61.
inline double separation_error(const BodyTree& a, const BodyTree& b, double distance) {
  return 18 * 0x1p-24 * (a.reach() + b.reach() + distance) + 0x1p-60;
}

/// The closest two balls, by computed separations, or, once a computed separation is at most `enough`, some two with
/// such a separation. Preconditions: no tree is empty; `start` names two balls, or none. Allocates nothing.
ClosestBalls closest_balls(const BodyTree& a, const BodyTree& b, const FloatPose& pose, const BallPair& start,
                           float enough);

}  // namespace medial_vk
