// Hulls in the shapes and the digits of other programs, inside the hulls that they stand for.
//
// If all radii of a hull are smaller by e, each of its points can move by e without leaving the hull: the hull is the
// union of balls, and B(c, r - e) + B(0, e) = B(c, r). So what a format loses is bounded first, and taken off the
// radii.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "medial_vk/ball_hull.h"
#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The type of a format's numbers.
enum class Digits : std::uint8_t { kDouble, kFloat };

/// A number in these digits, to nearest.
double in_digits(double x, Digits digits);
/// A positive number in these digits, rounded down.
double at_most(double x, Digits digits);

/// The hull of the balls that no other ball of the hull holds. It is never larger.
BallHull without_held_balls(const BallHull& hull);

/// The hull with radii that are smaller by `loss`; none if a radius is not greater than that.
std::optional<BallHull> shrunk(const BallHull& hull, double loss);

/// The least and the greatest coordinates of a hull have this middle, relative to `origin` and in these digits.
Point middle_in(const BallHull& hull, const Point& origin, Digits digits);

/// A mesh with vertices relative to `origin`, in these digits, all of which lie in the hull: so does the mesh, since
/// the hull is convex. Its surface is nowhere farther from that of the hull than `share` of the greatest radius, and
/// what the digits lose. Errors: kCannotWrite (a radius is smaller than this), those of mesh_of().
Result<Mesh> inner_mesh(const BallHull& hull, const Point& origin, Digits digits, double share);

/// A capsule with two radii along the axis y of a frame.
struct PosedCapsule {
  Point middle;                    ///< Of the two centres, relative to an origin.
  std::array<double, 4> rotation;  ///< A quaternion x, y, z, w from that frame.
  double height = 0;               ///< The distance of the centres.
  double radius_bottom = 0;        ///< At y = -height / 2.
  double radius_top = 0;           ///< At y = height / 2.
};

/// The hull of two balls, none of which holds the other, with all numbers in these digits: it lies in the hull, whether
/// a program normalises the quaternion or not. None if a radius is smaller than what the digits lose.
std::optional<PosedCapsule> posed_capsule(const BallHull& hull, const Point& origin, Digits digits);

/// Two balls in the hull of two balls, of which none holds the other, such that the capsule with their centres and
/// radii lies in the hull by both readings of the radii: those of the balls at the ends, or those of the rims of the
/// cone between these (OpenUSD has read those of Capsule_1 in both ways). None if there are no such balls by the
/// construction of docs/formats.md, "Hulls": the hull is nearly its larger ball.
std::optional<BallHull> for_both_readings(const BallHull& hull);

}  // namespace medial_vk
