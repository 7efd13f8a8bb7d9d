// Proofs, in double precision, that balls lie inside a solid or cover it. Whatever made the balls, these believe only
// their numbers. (docs/theory.md, "Tight spheres")
#pragma once

#include <cstdint>
#include <span>

#include "mesh/solid.h"
#include "spheres/measures/envelope.h"
#include "spheres/measures/threads.h"

namespace medial_vk {

/// Every centre is inside and every radius at most the exact distance from there to the boundary.
struct InsideProof {
  std::uint64_t tested = 0;
  std::uint64_t failed = 0;
  std::uint32_t first_failure = 0;  ///< Index of a ball, if any failed.
  double worst = 0;  ///< The greatest radius less distance, mesh units, rounding on the side of failure; 0: no ball.

  bool proved() const { return failed == 0; }
};

/// Every triangle is cut into pieces that lie in one ball each, and no vertex of the envelope lies in the solid.
struct CoverProof {
  std::uint64_t triangles = 0;  ///< Of the boundary.
  std::uint64_t uncovered = 0;  ///< Of these: with a point that is in no ball.
  std::uint64_t undecided = 0;  ///< Of these: neither that nor covered by pieces of a reasonable number and size.
  Point first_uncovered{};      ///< Of the first triangle that is uncovered or undecided: a point where it shows.
  std::uint64_t vertices = 0;   ///< Of the envelope.
  std::uint64_t inside = 0;     ///< Of these: in the solid, or too near its boundary to tell: cavities.
  Point first_inside{};         ///< The first of them.
  bool closed = true;           ///< Else only the surface is proved to be covered.

  bool surface_proved() const { return uncovered == 0 && undecided == 0; }
  bool proved() const { return closed && surface_proved() && inside == 0; }
};

/// Throws Stopped if `threads` does not go on.
InsideProof prove_inside(const Solid& solid, std::span<const Ball> balls, const Threads& threads = {});

/// Errors: kOutOfMemory, kInterrupted (`threads` does not go on).
Result<CoverProof> prove_cover(const Solid& solid, const Envelope& envelope, const Threads& threads = {});
/// The same for balls, at least one. Errors: also those of measure_ball_union().
Result<CoverProof> prove_cover(const Solid& solid, std::span<const Ball> balls, const Threads& threads = {});

}  // namespace medial_vk
