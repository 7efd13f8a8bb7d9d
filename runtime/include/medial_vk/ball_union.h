// Unions of balls, exactly: volume and surface, each ball's share of them, and the dual complex.
//
// The power diagram cuts a union of balls into convex pieces, one in each ball (S. Stolpner, "Medial Spheres for Shape
// Representation", 2011, Section 1.2.2; docs/theory.md, "Unions of balls"). Each piece has a closed form in double
// precision; which balls border on which is decided exactly, with ties broken the same way everywhere, so duplicated,
// nested, cospherical and coplanar balls are no special cases. On the host, on all cores.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

class Context;

/// Simplices over balls, by their indices, ascending within a simplex and among simplices: the nerve of the balls, each
/// cut down to its power cell (zero alpha complex; H. Edelsbrunner, "The union of balls and its dual shape", 1995). It
/// has the homotopy type of the union. Every face of a simplex is there.
struct DualComplex {
  std::vector<std::uint32_t> vertices;  ///< Balls that are not hidden: those with a piece of the union.
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
};

/// Where three spheres meet on the union's surface.
struct EnvelopeVertex {
  Point at;
  std::array<std::uint32_t, 3> balls;  ///< Ascending.
};

struct BallUnionOptions {
  unsigned threads = 0;  ///< 0: one per core. The result does not depend on it.
  bool complex = false;  ///< Also find the dual complex and the vertices of the envelope.
};

/// What measure_ball_union() finds. Lengths in the units of the balls.
struct BallUnion {
  double volume = 0;  ///< Of the union.
  double area = 0;    ///< Of its surface.
  std::vector<double>
      volumes;  ///< Per ball: of the ball in its power cell, vol(b | P(b)) of equation 6.1; sums to volume.
  std::vector<double> areas;  ///< Per ball: of its sphere on the union's surface; sums to area.
  DualComplex complex;
  std::vector<EnvelopeVertex> vertices;  ///< In the order of their balls; up to two for the same three.
};

/// The number of components, tunnels and cavities.
struct BettiNumbers {
  std::uint64_t components = 0, tunnels = 0, cavities = 0;
  bool operator==(const BettiNumbers&) const = default;
};

/// Measures a union of balls: centres and radii finite, radii not negative, fewer than 2^30 balls. Of balls that are
/// equal, the first counts. Balls of radius 0 are no part of the complex. A point where four spheres or more meet may
/// be among the vertices of the envelope once, several times or not at all. Lengths below 2^-98 of the largest
/// coordinate or radius are rounded to 2^-150 of it. Time: n log n for balls of a solid or along its medial surface,
/// where each has a bounded number of neighbours, and some 700 bytes a ball; where cells of balls that are far apart
/// meet by thousands, as between two rods, each ball by itself, and one that overlaps k others takes k^2. Errors:
/// kUsage (names the ball), kOutOfMemory.
Result<BallUnion> measure_ball_union(std::span<const Ball> balls, const BallUnionOptions& options = {});

/// Of the space that a dual complex triangulates, over Z/2; these are those of the union. The complex is as
/// measure_ball_union() makes it: in space, lists ascending, every face of a simplex there. Error: kOutOfMemory.
Result<BettiNumbers> betti_numbers(const DualComplex& complex);

// On the device: each ball's share of the volume and of the surface in float, with bounds of the errors, faster where
// there is a GPU (docs/theory.md, "Unions of balls", "On the device").

struct DeviceBallUnionOptions {
  unsigned threads = 0;  ///< Of the host, which builds the tree and measures what the device leaves: 0 is one per core.
  /// The greatest error bound that is accepted, as a share of the cube of a ball's radius for its volume, and ten times
  /// that of the square for its surface.
  double tolerance = 1e-3;
};

/// What measure_ball_union() finds on a device. Lengths in the units of the balls. Against the exact figures, each
/// number is wrong by its bound at most; bounds are of the worst case, errors are mostly hundreds of times smaller.
struct DeviceBallUnion {
  double volume = 0;  ///< Of the union.
  double area = 0;    ///< Of its surface.
  double volume_bound = 0;
  double area_bound = 0;
  std::vector<double> volumes;  ///< Per ball, as BallUnion::volumes.
  std::vector<double> areas;    ///< Per ball, as BallUnion::areas.
  std::vector<double> volume_bounds;
  std::vector<double> area_bounds;
  std::vector<std::uint32_t> redone;  ///< Balls that the host measured in double precision, ascending.
};

/// Measures a union of balls on the device; for balls as measure_ball_union() of ball_union.h takes them. Those that
/// the device cannot measure (cells of more than 64 corners, coincidences beyond what float tells apart, bounds above
/// the tolerance) are measured by the host, so the answer holds for all. The same bytes for the same device, whatever
/// `threads`. Errors: kUsage (names the ball; a tolerance that is not positive), kOutOfMemory (of the host or of the
/// device), kInternal (device lost).
Result<DeviceBallUnion> measure_ball_union(Context& context, std::span<const Ball> balls,
                                           const DeviceBallUnionOptions& options = {});

}  // namespace medial_vk
