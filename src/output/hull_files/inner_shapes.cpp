#include "output/hull_files/inner_shapes.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "output/hull_files/encoders.h"

namespace medial_vk {
namespace {

// Doubles that are computed here are sums and products of few terms, fewer than 2^5 roundings of 2^-53 of the greatest
// coordinate or length.
constexpr double kOfDoubles = 0x1p-46;
// Three coordinates are rounded to float by 2^-24 of the greatest at most, so that a point moves by sqrt(3) 2^-24.
constexpr double kOfFloats = 0x1p-23;
// Numbers below the normal floats are rounded by 2^-150 at most, three of them.
constexpr double kOfSmallFloats = 0x1p-148;

double greatest_coordinate(const Point& p) { return std::max({std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}); }

/// The greatest absolute coordinate of any point of the hull, from an origin.
double reach_from(const BallHull& hull, const Point& origin) {
  double reach = 0;
  for (const Ball& ball : hull.balls())
    reach = std::max(reach, greatest_coordinate(ball.centre - origin) + ball.radius);
  return reach;
}

/// How far a point of the hull may be from where it is written, if it is written relative to `origin`.
double loss_of_points(const BallHull& hull, const Point& origin, Digits digits) {
  const double reach = reach_from(hull, origin);
  const double of_doubles = kOfDoubles * (reach + greatest_coordinate(origin));
  return digits == Digits::kDouble ? of_doubles : of_doubles + kOfFloats * reach + kOfSmallFloats;
}

BallHull relative_to(const BallHull& hull, const Point& origin) {
  BallHull moved = hull;
  for (std::uint32_t i = 0; i < hull.count; ++i) moved.corners[i].centre = hull.corners[i].centre - origin;
  return moved;
}

bool holds(const Ball& a, const Ball& b) { return length(a.centre - b.centre) + b.radius <= a.radius; }

/// The image of the axis y by the rotation of a quaternion of any length.
Point axis_of(const std::array<double, 4>& q, double squared_length) {
  const auto& [x, y, z, w] = q;
  return {2 * (x * y - w * z) / squared_length, (w * w - x * x + y * y - z * z) / squared_length,
          2 * (y * z + w * x) / squared_length};
}

}  // namespace

double in_digits(double x, Digits digits) {
  return digits == Digits::kDouble ? x : static_cast<double>(static_cast<float>(x));
}

double at_most(double x, Digits digits) {
  if (digits == Digits::kDouble) return x;
  const auto rounded = static_cast<float>(x);
  return double{rounded} > x ? double{std::nextafter(rounded, 0.0f)} : double{rounded};
}

BallHull without_held_balls(const BallHull& hull) {
  BallHull kept = hull;
  for (std::uint32_t i = 0; i < kept.count;) {
    bool is_held = false;
    for (std::uint32_t j = 0; j < kept.count; ++j) is_held |= j != i && holds(kept.corners[j], kept.corners[i]);
    if (!is_held) {
      ++i;
      continue;
    }
    for (std::uint32_t j = i + 1; j < kept.count; ++j) kept.corners[j - 1] = kept.corners[j];
    kept.corners[--kept.count] = {};
  }
  return kept;
}

std::optional<BallHull> shrunk(const BallHull& hull, double loss) {
  BallHull smaller = hull;
  for (std::uint32_t i = 0; i < hull.count; ++i) {
    smaller.corners[i].radius -= loss;
    if (!(smaller.corners[i].radius > 0)) return std::nullopt;
  }
  return smaller;
}

Point middle_in(const BallHull& hull, const Point& origin, Digits digits) {
  const HullBounds box = bounds_of(hull);
  Point middle;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = in_digits((box.lower[k] - origin[k]) / 2 + (box.upper[k] - origin[k]) / 2, digits);
  }
  return middle;
}

Result<Mesh> inner_mesh(const BallHull& hull, const Point& origin, Digits digits, double share) {
  const std::optional<BallHull> inner = shrunk(without_held_balls(hull), loss_of_points(hull, origin, digits));
  if (!inner) return too_thin();
  double greatest = 0;
  for (const Ball& ball : inner->balls()) greatest = std::max(greatest, ball.radius);
  Result<Mesh> mesh = mesh_of(relative_to(*inner, origin), share * greatest);
  if (!mesh) return mesh.error();
  for (Point& vertex : mesh.value().vertices) {
    for (double& x : vertex) x = in_digits(x, digits);
  }
  return mesh;
}

std::optional<PosedCapsule> posed_capsule(const BallHull& hull, const Point& origin, Digits digits) {
  Ball bottom = hull.corners[0], top = hull.corners[1];
  if (top.centre[1] < bottom.centre[1]) std::swap(bottom, top);  // so that w below is at least 1
  const Point along = top.centre - bottom.centre;
  const double exact_height = length(along);
  if (!(exact_height > 0)) return std::nullopt;
  const Point d = (1 / exact_height) * along;
  const double scale = 1 / std::sqrt(2 * (1 + d[1]));
  PosedCapsule posed;
  posed.rotation = {d[2] * scale, 0, -d[0] * scale, (1 + d[1]) * scale};
  for (double& x : posed.rotation) x = in_digits(x, digits);
  for (std::size_t k = 0; k < 3; ++k) {
    posed.middle[k] = in_digits((bottom.centre[k] - origin[k]) / 2 + (top.centre[k] - origin[k]) / 2, digits);
  }
  posed.height = in_digits(exact_height, digits);

  // Where the written ends are, with the quaternion normalised.
  double squared = 0;
  for (const double x : posed.rotation) squared += x * x;
  const Point half = (posed.height / 2) * axis_of(posed.rotation, squared);
  const Point to_bottom = posed.middle - half - (bottom.centre - origin);
  const Point to_top = posed.middle + half - (top.centre - origin);
  // A program that does not normalise it applies R' = I + q^2 (R - I) instead of R, where q^2 is the squared length. It
  // moves a point p by |q^2 - 1| |R p - p|, at most twice |q^2 - 1| |p|. Points of the capsule, by either reading of
  // the radii, are within half the height and 2.5 radii of the middle.
  const double radius = std::max(bottom.radius, top.radius);
  const double not_normalised = 2 * std::fabs(squared - 1) * (exact_height / 2 + 2.5 * radius);
  const double moved = std::max(length(to_bottom), length(to_top)) + not_normalised;
  // Of radii that are read as those of rims, with the slope tan f of the cone between them, a ball at an end has the
  // radius r / cos f, with its centre r tan f from the rim: if r is smaller by e, it has room for e (1 - sin f) / cos
  // f. With tan f < 1 this is more than e / 2.5.
  const double loss = 2.5 * moved + kOfDoubles * (reach_from(hull, origin) + greatest_coordinate(origin));
  posed.radius_bottom = at_most(bottom.radius - loss, digits);
  posed.radius_top = at_most(top.radius - loss, digits);
  if (!(posed.radius_bottom > 0 && posed.radius_top > 0 && posed.height > 0)) return std::nullopt;
  return posed;
}

// With R > r the radii, L the distance of the centres and s = (R - r) / L, the ball of the hull at t from the centre of
// the larger one has the radius R - s t. Written are the ball at t = s b with the radius b = R / (1 + s^2), which is
// that ball, and the smaller one. Read as rims, the slope is (b - r) / (L - s b) = s, since b - r = s L - s^2 b: the
// balls are at t = 0 with the radius b sqrt(1 + s^2) = R / sqrt(1 + s^2) < R, and at t = L - s r with r sqrt(1 + s^2)
// <= r (1 + s^2), which is the radius of the hull's ball there. Both readings are hulls of balls of the hull.
std::optional<BallHull> for_both_readings(const BallHull& hull) {
  Ball larger = hull.corners[0], smaller = hull.corners[1];
  if (smaller.radius > larger.radius) std::swap(larger, smaller);
  if (larger.radius == smaller.radius) return hull;
  const Point along = smaller.centre - larger.centre;
  const double extent = length(along);
  const double slope = (larger.radius - smaller.radius) / extent;
  const double radius = larger.radius / (1 + slope * slope);
  if (!(slope < 1 && radius > smaller.radius && slope * radius < extent)) return std::nullopt;
  return hull_of(Ball{larger.centre + (slope * radius / extent) * along, radius}, smaller);
}

}  // namespace medial_vk
