// The convex hull of one, two or three balls: ball, capsule, cone-sphere or slab (S. Stolpner, "Medial Spheres for
// Shape Representation", 2011, Section 8.7.3; docs/theory.md, "Hulls of balls").
//
// The balls of a hull span a simplex of centres, its axis: a point, a segment or a triangle. Over the axis the radius
// is linear, and the hull is the union of the balls B(c(l), r(l)) of all weights l of the simplex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// What a hull is called, by the number of its balls and by their radii.
enum class HullKind : std::uint8_t {
  kBall,     ///< One ball: 4 parameters.
  kCapsule,  ///< Two balls of one radius, also called line swept sphere: 7 parameters.
  kCone,     ///< Two balls, also called cone-sphere or tapered capsule: 8 parameters.
  kSlab,     ///< Three balls, also called fat triangle: 12 parameters.
};

/// How many numbers describe a hull of a kind.
std::size_t parameters_of(HullKind kind);

/// The convex hull of its first `count` balls, 1 to 3, in mesh units. Radii are not negative. Balls may lie in each
/// other, and centres may coincide or be on one line.
struct BallHull {
  std::array<Ball, 3> corners = {};
  std::uint32_t count = 1;

  std::span<const Ball> balls() const { return {corners.data(), count}; }
};

/// The hull of one ball, of two or of three.
BallHull hull_of(const Ball& a);
BallHull hull_of(const Ball& a, const Ball& b);
BallHull hull_of(const Ball& a, const Ball& b, const Ball& c);

/// By the number of balls; two balls of exactly the same radius are a capsule.
HullKind kind_of(const BallHull& hull);

/// The distance from `p` to the surface of the hull, negative inside: the minimum of |p - c(l)| - r(l) over the axis,
/// by a closed form. It is a convex function of `p`.
double signed_distance(const BallHull& hull, const Point& p);

/// The greatest product of `direction`, of any length, with a point of the hull.
double support(const BallHull& hull, const Point& direction);
/// A point of the hull that has it; `direction` is not zero.
Point support_point(const BallHull& hull, const Point& direction);

/// The least box with sides along the axes that holds the hull.
struct HullBounds {
  Point lower, upper;
};
HullBounds bounds_of(const BallHull& hull);

/// The volume of one hull in cubed mesh units, by a closed form.
double volume_of(const BallHull& hull);

/// The distance of two hulls if it is positive; otherwise they meet, and the number only says so: it is not the depth
/// of penetration. The minimum of |c(l) - c'(m)| - r(l) - r'(m), by a closed form.
double distance_between(const BallHull& a, const BallHull& b);

/// A closed triangle mesh whose vertices are on the surface of the hull, so that it lies in the hull, and whose surface
/// is nowhere farther than `tolerance`, in mesh units, from that of the hull. Triangles are counter-clockwise seen from
/// outside. Errors: kUsage (a tolerance that is not positive, more than 2^24 triangles, a hull without volume),
/// kOutOfMemory.
Result<Mesh> mesh_of(const BallHull& hull, double tolerance);

}  // namespace medial_vk
