// Hulls of balls of which it is known, without any proof, whether they lie inside of a solid.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "medial_vk/ball_hull.h"
#include "medial_vk/mesh.h"

namespace medial_vk::test {

/// A half-space: the points p with normal . p <= bound. Normals have unit length.
struct FarPlane {
  std::array<long double, 3> normal;
  long double bound;
};
/// The common points of some half-spaces.
using ConvexPart = std::vector<FarPlane>;

/// Rotated, scaled and moved, so that no coordinate is a round number.
struct Placement {
  std::array<std::array<long double, 3>, 3> axes;
  long double factor;
  std::array<long double, 3> offset;

  Point of(const Point& p) const;
  BallHull of(const BallHull& hull) const;
};

/// A tetrahedron, a prism, a box, an L, or a plate with a square hole, with its faces divided into many triangles. What
/// is known about hulls is known in a frame in which the longest side is 1; mesh and hulls are then placed, which
/// rounds them by some 2^-53 of the coordinates, at most 1e-14 of the longest side.
class KnownSolid {
 public:
  explicit KnownSolid(std::uint64_t seed);

  /// As placed.
  const Mesh& mesh() const { return placed_; }

  /// The least excess or depth of the hulls below, as a share of the longest side.
  static constexpr double kLeast = 1e-9;
  /// A hull with a point outside of the solid, farther from it than kLeast. Some are outside altogether.
  BallHull outside(std::mt19937_64& random) const;
  /// A hull inside, with a distance from the boundary of at least kLeast. Half of them have little more.
  BallHull inside(std::mt19937_64& random) const;

 private:
  void make_convex(std::mt19937_64& random);
  void make_l_shape(std::mt19937_64& random);
  void make_plate(std::mt19937_64& random);
  void divide(int times);
  ConvexPart random_part(std::mt19937_64& random) const;
  bool is_outside(const Point& p) const;

  Mesh mesh_, placed_;
  Placement placement_;
  /// Their union is the solid.
  std::vector<ConvexPart> cover_;
  /// The sides of notches, on which convex parts of the solid may turn about an edge: corners in x and y.
  std::vector<std::array<double, 2>> notch_;
  ConvexPart box_;
};

}  // namespace medial_vk::test
