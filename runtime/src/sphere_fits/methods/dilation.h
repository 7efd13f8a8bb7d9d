// Balls inside a solid, grown and moved until they cover it, or grown until they reach its boundary.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "sphere_fits/methods/sphere_set.h"
#include "sphere_fits/quality/sphere_certificate.h"

namespace medial_vk {

/// Covers the solid by no more balls than `inside` has, with as little added volume as the search finds: balls are
/// grown, moved, removed where others suffice, and placed where the gain is greatest (S. Stolpner, 2011, Section 8.2
/// only grows them, and covers a part). The result passes prove_cover() for any `inside`; for an open mesh it covers
/// the surface, and no vertex of its envelope has a winding number of 1/2 or more. Prefixes of the result are not
/// covers, so levels require a call for each prefix of `inside`. Deterministic; `threads` 0: all. Does not throw.
/// `progress` gets "cover". Errors: kUsage (no balls; a centre or radius that is not a number), kOutOfMemory,
/// kInterrupted.
Result<SphereSet> cover_solid(const Solid& solid, SphereSet inside, unsigned threads = 0,
                              const SphereProgress& progress = {});

/// A cover for each of the numbers. Larger numbers never give a larger volume, even in separate calls, if the starts
/// that both calls use are equal. `starts` holds, by values of cover_top() (sphere_fits/cover/cover_family.h), that
/// number of balls inside the solid, or fewer for the greatest value. Otherwise as cover_solid().
Result<std::vector<SphereSet>> cover_by_counts(const Solid& solid,
                                               const std::map<std::size_t, std::vector<Ball>>& starts,
                                               const std::vector<std::size_t>& counts, unsigned threads = 0,
                                               const SphereProgress& progress = {});

/// S_D+ of Section 8.2: every ball grows until it holds, for each vertex of the envelope that it makes, the point of
/// the boundary nearest to that vertex, and for each arc of two balls that no third one touches, those nearest to two
/// opposite points of the circle. (The source picks the two at random; here one lies farthest along the coordinate axis
/// that is most across the circle's own.) Order and centres stay, so prefixes of `inside` give prefixes of other sets.
/// Guarantee: a ball reaches no farther beyond the boundary than it grew; measure_distances() gives that distance and
/// the uncovered parts. Does not throw. Errors: those of measure_ball_union().
Result<SphereSet> dilate_to_boundary(const Solid& solid, SphereSet inside, unsigned threads = 0);

}  // namespace medial_vk
