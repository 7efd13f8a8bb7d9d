// A lower bound of the depth of two overlapping sets of balls.
#pragma once

#include <cstdint>

#include "proximity/body.h"
#include "proximity/placement.h"

namespace medial_vk {

struct DepthBound {
  double lower = 0;
  BallPair deepest;  ///< Without a translation; none if no balls are proved to overlap.
};

/// After every translation of b that is shorter than `lower`, some ball inside a overlaps one inside b: proved, with
/// all errors. `upper` bounds the depth from above; infinite: unknown. Preconditions: both sets have balls; the
/// placement is in range.
DepthBound bound_depth(const BodyImpl& a, const BodyImpl& b, const Pose& pose, double upper,
                       std::uint64_t most_queries);

}  // namespace medial_vk
