// The proof that hulls of balls lie inside a solid.
#pragma once

#include <cstdint>
#include <span>

#include "medial_vk/ball_hull.h"
#include "medial_vk/hull_proofs.h"
#include "solid/solid.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// The proof for one hull.
struct PlaneProof {
  std::uint64_t planes = 0;
  /// By how much all radii must be smaller for planes between the hull and every triangle; 0: they are there. Infinite:
  /// a point of the hull may be outside.
  double lack = 0;

  bool proved() const { return lack == 0; }
};

/// A hull is connected: if one of its points is inside and no triangle of the boundary meets it, all of it is inside.
/// It does not meet a triangle from which a plane separates it, and such a plane exists, since both are convex. Planes
/// are found by projections and closed forms, but the proof is in separation() alone, which tests each one. A box of
/// the tree that a plane separates from the hull stands for all triangles in it. An open boundary could be passed
/// without a triangle: there, the winding number is bounded on balls around parts of the hull (Solid::side_around()).
PlaneProof prove_hull(const Solid& solid, const BallHull& hull);

/// Of all hulls. Throws Stopped at a stop by `threads`.
HullProof prove_hulls(const Solid& solid, std::span<const BallHull> hulls, const Threads& threads = {});

}  // namespace medial_vk
