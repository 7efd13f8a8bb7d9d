// Verdicts on collisions in many poses, by balls alone: docs/theory.md, "Many poses".
#pragma once

#include <span>

#include "medial_vk/pose.h"
#include "medial_vk/proximity.h"

namespace medial_vk {

/// For every pose of `b` relative to `a`: free, hit, or undecided where balls prove neither. The verdicts are those of
/// distance_bounds(), except that a pose may be undecided here where the gap or the overlap of the sets is below 4e-6 M
/// (of distance_bounds()). Each search ends at its proof, so this takes about a tenth of the time of bounds. The
/// verdicts do not depend on the number of threads. Allocates nothing but threads. Preconditions: the poses are as for
/// distance_bounds(), and `verdicts` has their number.
void collide_by_balls(const Body& a, const Body& b, std::span<const Pose> poses, std::span<Collision> verdicts,
                      const BatchOptions& options = {});

/// The same for pairs of `bodies`, whose indices they hold.
void collide_by_balls(std::span<const Body> bodies, std::span<const PosedPair> pairs, std::span<Collision> verdicts,
                      const BatchOptions& options = {});

}  // namespace medial_vk
