// Balls inside a solid, grown and moved until they cover it, or grown until they reach its boundary.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "spheres/measures/sphere_certificate.h"
#include "spheres/methods/sphere_set.h"

namespace medial_vk {

/// Covers the solid by no more balls than `inside` has, with as little volume beyond it as is found: balls are grown,
/// moved, taken away where others do, and set down where most is to be gained (S. Stolpner, 2011, Section 8.2 grows
/// them only, and covers a part). The result passes prove_cover(), whatever `inside` was; of an open mesh it covers the
/// surface, and no vertex of its envelope has a winding number of 1/2 or more. One set for one number: the first balls
/// of the result cover nothing by themselves, so levels are made by a call for each prefix of `inside`. Deterministic;
/// `threads` 0: all. Does not throw. `progress` gets "cover". Errors: kUsage (no balls; a centre or radius that is no
/// number), kOutOfMemory, kInterrupted.
Result<SphereSet> cover_solid(const Solid& solid, SphereSet inside, unsigned threads = 0,
                              const SphereProgress& progress = {});

/// A cover for each of the numbers. Larger numbers never give a larger volume, also between calls, if the starts are
/// the same as far as they go: by cover_top() (spheres/cover_family.h), balls inside, as many, or fewer for the
/// greatest. Otherwise as cover_solid().
Result<std::vector<SphereSet>> cover_by_counts(const Solid& solid,
                                               const std::map<std::size_t, std::vector<Ball>>& starts,
                                               const std::vector<std::size_t>& counts, unsigned threads = 0,
                                               const SphereProgress& progress = {});

/// S_D+ of Section 8.2: every ball grows until it holds, for each vertex of the envelope that it makes, the point of
/// the boundary nearest to that vertex, and for each arc of two balls that no third one touches, those nearest to two
/// opposite points of the circle. (The source picks the two at random; here one lies farthest along the coordinate axis
/// that is most across the circle's own.) Order and centres stay, so prefixes of `inside` give prefixes of other sets.
/// What is guaranteed: a ball reaches no farther beyond the boundary than it grew; how far that is and how much is
/// uncovered is for measure_distances() to say. Does not throw. Errors: those of measure_ball_union().
Result<SphereSet> dilate_to_boundary(const Solid& solid, SphereSet inside, unsigned threads = 0);

}  // namespace medial_vk
