// Exact measures of unions of balls: volume, area of the envelope, each ball's share of both, and the dual complex.
//
// The power diagram cuts a union of balls into convex parts, one in each ball (S. Stolpner, "Medial Spheres for Shape
// Representation", 2011, Section 1.2.2; docs/theory.md, "Unions of balls"). The measures of each part have a closed
// form, evaluated in double precision. The adjacency of balls is decided exactly, and ties are broken consistently, so
// duplicated, nested, cospherical and coplanar balls are no special cases. The first call runs on the host, the second
// on a device.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/dual_complex.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

class Context;

struct BallUnionOptions {
  unsigned threads = 0;  ///< 0: one per core. The result does not depend on it.
  bool complex = false;  ///< Also find the dual complex and the vertices of the envelope.
};

/// The results of measure_ball_union(). Lengths are in the units of the balls.
struct BallUnion {
  double volume = 0;  ///< Of the union.
  double area = 0;    ///< Of its envelope.
  /// Per ball: of the ball in its power cell, vol(b | P(b)) of equation 6.1; sums to volume.
  std::vector<double> volumes;
  std::vector<double> areas;  ///< Per ball: of the part of its sphere on the envelope; sums to area.
  /// Per ball: the integral of the outward unit normals over that part, by area, as Exposure::vector: if the centre
  /// moves by d, the volume grows by vector . d to first order.
  std::vector<Point> vectors;
  DualComplex complex;
  std::vector<EnvelopeVertex> vertices;  ///< In the order of their balls; up to two for the same three.
};

/// The number of components, tunnels and cavities.
struct BettiNumbers {
  std::uint64_t components = 0, tunnels = 0, cavities = 0;
  bool operator==(const BettiNumbers&) const = default;
};

/// Measures a union of fewer than 2^30 balls, whose centres and radii are finite and whose radii are not negative. Of
/// equal balls, the first counts. Balls of radius 0 are no part of the complex. A point where four spheres or more meet
/// may be among the vertices of the envelope once, several times or not at all. Lengths below 2^-98 of the largest
/// coordinate or radius are rounded to 2^-150 of it. Time for n balls of a solid or along its medial surface, where
/// each has a bounded number of neighbours: n log n; memory: some 800 bytes per ball. Where thousands of cells of
/// distant balls meet, as between two rods, each ball is measured by itself, and one that overlaps k others takes time
/// k^2. Errors: kUsage (names the ball), kOutOfMemory.
Result<BallUnion> measure_ball_union(std::span<const Ball> balls, const BallUnionOptions& options = {});

/// Betti numbers over Z/2 of the space that a dual complex triangulates; they equal those of the union. Precondition: a
/// complex as measure_ball_union() makes it: in space, with ascending lists and every face of its simplices. Error:
/// kOutOfMemory.
Result<BettiNumbers> betti_numbers(const DualComplex& complex);

/// By vertex of such a complex: its component. Components are numbered in the order of their first vertices. Error:
/// kOutOfMemory.
Result<std::vector<std::uint32_t>> component_of_vertices(const DualComplex& complex);

// On the device: each ball's share of the volume and of the area of the envelope in float, with error bounds; faster
// with a GPU (docs/theory.md, "Unions of balls", "On the device").

struct DeviceBallUnionOptions {
  /// Threads of the host, which builds the tree and measures the balls that the device cannot measure; 0: one per core.
  unsigned threads = 0;
  /// The greatest accepted error bounds of a ball of radius r: tolerance r^3 for its volume, 10 tolerance r^2 for its
  /// area.
  double tolerance = 1e-3;
};

/// The results of measure_ball_union() on a device. Lengths are in the units of the balls. The error of each number is
/// at most its bound; bounds are for the worst case, and most errors are hundreds of times smaller.
struct DeviceBallUnion {
  double volume = 0;  ///< Of the union.
  double area = 0;    ///< Of its envelope.
  double volume_bound = 0;
  double area_bound = 0;
  std::vector<double> volumes;  ///< Per ball, as BallUnion::volumes.
  std::vector<double> areas;    ///< Per ball, as BallUnion::areas.
  std::vector<double> volume_bounds;
  std::vector<double> area_bounds;
  std::vector<std::uint32_t> redone;  ///< Balls that the host measured in double precision, ascending.
};

/// Measures a union of balls on the device, under the same conditions for balls. Balls that the device cannot measure
/// (cells of more than 64 corners, near-coincidences that float cannot distinguish, bounds above the tolerance) are
/// measured by the host, so the result is valid for all. On one device, the result is the same to the byte for any
/// `threads`. Errors: kUsage (names the ball; a tolerance that is not positive), kOutOfMemory (of the host or of the
/// device), kInternal (device lost).
Result<DeviceBallUnion> measure_ball_union(std::span<const Ball> balls, const DeviceBallUnionOptions& options,
                                           Context& context);

}  // namespace medial_vk
