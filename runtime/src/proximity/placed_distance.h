// distance() of two bodies whose placement is known.
#pragma once

#include "proximity/placement.h"

namespace medial_vk {

/// Preconditions: both bodies have meshes; the options are good; the placement is in range.
Distance distance_of(const BodyImpl& a, const BodyImpl& b, const Placement& placement, const DistanceOptions& options,
                     const Distance& start);

/// Bounds by balls, below `most`: docs/theory.md, "Many bodies". No two balls of the covers are closer than the lower
/// bound; `pair` becomes the closest, if it is closer than `most`, and is where the search starts. Preconditions: both
/// bodies have such balls; the placement is in range.
double lower_bound(const BodyTree& a, const BodyTree& b, const Placement& placement, double most, BallPair& pair);
/// Two balls inside are as close, or `most` is less.
double upper_bound(const BodyImpl& a, const BodyImpl& b, const Placement& placement, double most, BallPair& pair);

}  // namespace medial_vk
