// Sets whose goal is a distance: balls inside that leave a narrow gap, and covers that reach out little.
#pragma once

#include <vector>

#include "medial_vk/indexed_mesh.h"
#include "sphere_fits/methods/sphere_set.h"
#include "sphere_fits/spread/spread.h"

namespace medial_vk {

/// kVolume or kDistance; for options that check_distances() refuses, the aim that they have. Throws std::bad_alloc.
SphereAim aim_for(const Solid& solid, const SphereFitOptions& options);
/// The same. Errors: those of Solid::build().
Result<SphereAim> aim_for(const IndexedMesh& mesh, const SphereFitOptions& options);

/// Errors: kUsage (a goal or an aim that the others exclude).
Status check_distances(const Solid& solid, const SphereFitOptions& options);

/// The sets of SphereAim::kDistance, with levels the smallest first. Errors: kUsage (more balls than `count` are needed
/// for `max_gap`), kInvalidMesh (no ball fits), kOutOfMemory, kInterrupted. Throws std::bad_alloc and Stopped.
Result<std::vector<SphereSet>> sets_by_distance(const Solid& solid, const SphereFitOptions& options,
                                                const SphereProgress& progress);
/// Likewise, by `count` alone, from balls that may have been spread before.
Result<std::vector<SphereSet>> sets_by_distance(BallSpread& spread, const SphereFitOptions& options);

/// The cover of `max_reach`. Errors likewise.
Result<std::vector<SphereSet>> cover_by_reach(const Solid& solid, const SphereFitOptions& options,
                                              const SphereProgress& progress);

}  // namespace medial_vk
