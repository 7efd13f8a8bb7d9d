// Proofs, in double precision, that balls lie inside a solid or cover it. The proofs depend only on the numbers of the
// balls, not on the method that found them. (docs/theory.md, "Tight spheres")
#pragma once

#include <cstdint>
#include <span>

#include "medial_vk/sphere_measures.h"
#include "solid/solid.h"
#include "sphere_fits/quality/envelope.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// Throws Stopped at a stop by `threads`.
InsideProof prove_inside(const Solid& solid, std::span<const Ball> balls, const Threads& threads = {});

/// Errors: kOutOfMemory, kInterrupted (a stop by `threads`).
Result<CoverProof> prove_cover(const Solid& solid, const Envelope& envelope, const Threads& threads = {});
/// The same for balls, at least one. Errors: also those of measure_ball_union().
Result<CoverProof> prove_cover(const Solid& solid, std::span<const Ball> balls, const Threads& threads = {});

}  // namespace medial_vk
