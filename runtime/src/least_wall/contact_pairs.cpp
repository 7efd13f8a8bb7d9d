#include "least_wall/contact_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace medial_vk {
namespace {

constexpr Point kNoAxis = {0, 0, 0};

bool is_any(const SpokeCone& cone) { return cone.axis == kNoAxis; }

/// Of the angle between a direction in one cone and one in the other.
Bounds turn_of(const SpokeCone& a, const SpokeCone& b) {
  if (is_any(a) || is_any(b)) return {0, std::numbers::pi};
  const double between = angle_between(a.axis, b.axis), spread = a.angle + b.angle + kAngleRounding;
  return {between - spread, between + spread};
}

/// A quick test: true only if directions in both cones are less than 2 theta, more than a right angle, apart.
bool are_too_close(const SpokeCone& a, const SpokeCone& b, double theta) {
  if (is_any(a) || is_any(b)) return false;
  return dot(a.axis, b.axis) > 0 && a.angle + b.angle + 2 * kAngleRounding < 2 * theta - 0.5 * std::numbers::pi;
}

/// False where the boxes or the planes of both triangles show that they have no point in common.
bool may_meet(const FacingTriangle& a, const FacingTriangle& b, double rounding) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [a_least, a_most] = std::minmax({a.corners[0][axis], a.corners[1][axis], a.corners[2][axis]});
    const auto [b_least, b_most] = std::minmax({b.corners[0][axis], b.corners[1][axis], b.corners[2][axis]});
    if (a_least > b_most || b_least > a_most) return false;
  }
  const auto is_beside = [rounding](const FacingTriangle& of_plane, const FacingTriangle& other) {
    if (is_any(of_plane.normal)) return false;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Point& corner : other.corners) {
      const Point offset = corner - of_plane.corners[0];
      const double height = dot(offset, of_plane.normal.axis);
      const double error = rounding + of_plane.normal.angle * length(offset);
      least = std::min(least, height - error);
      most = std::max(most, height + error);
    }
    return least > 0 || most < 0;
  };
  return !is_beside(a, b) && !is_beside(b, a);
}

SpokeCone cap_at(std::span<const FacingTriangle> triangles, std::size_t of, double rounding,
                 std::vector<const SpokeCone*>& meeting) {
  meeting.clear();
  meeting.reserve(triangles.size());
  Point sum = kNoAxis;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    if (k != of && !may_meet(triangles[of], triangles[k], rounding)) continue;
    if (is_any(triangles[k].normal)) return {};
    meeting.push_back(&triangles[k].normal);
    sum = sum + triangles[k].normal.axis;
  }
  const double size = length(sum);
  // Sums of normals stay in caps that are narrower than a hemisphere.
  constexpr double kWidest = 0.49 * std::numbers::pi;
  if (!(size > 0)) return {};
  SpokeCone cap = {(1 / size) * sum, 0};
  for (const SpokeCone* normal : meeting) {
    cap.angle = std::max(cap.angle, angle_between(cap.axis, normal->axis) + normal->angle + kAngleRounding);
  }
  return cap.angle < kWidest ? cap : SpokeCone{};
}

}  // namespace

double least_radius_around(double d, double h, double theta) {
  if (!(d > h)) return 0;
  const double sine = std::sin(theta), cosine = std::cos(theta);
  const double squared = d * d * (1 - kBoundShare) - h * h * sine * sine;
  const double radius = std::sqrt(std::max(0.0, squared)) - h * cosine;
  return std::max(0.0, radius - kBoundShare * d);
}

void spokes_by_normals(std::span<const FacingTriangle> triangles, double rounding,
                       std::vector<const SpokeCone*>& meeting, std::vector<SpokeCone>& caps) {
  caps.clear();
  caps.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) caps.push_back(cap_at(triangles, i, rounding, meeting));
}

/// For contacts x and y with the spokes u and v: e (x - y) = r e (u - v) <= 2 r, whatever the unit vector e.
double least_radius_by_heights(const PossibleContact& a, const PossibleContact& b, double rounding) {
  double most = 0;
  const auto try_along = [&](const Point& e) {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const Point& corner : a.corners) least = std::min(least, dot(e, corner));
    for (const Point& corner : b.corners) greatest = std::max(greatest, dot(e, corner));
    most = std::max(most, least - greatest);
  };
  if (!is_any(a.by_normals)) try_along(a.by_normals.axis);
  if (!is_any(b.by_normals)) try_along(-1.0 * b.by_normals.axis);
  return std::max(0.0, 0.5 * (most - 2 * rounding));
}

double least_radius_of_pairs(std::vector<PossibleContact>& contacts, double h, double theta, double known,
                             double rounding) {
  std::erase_if(contacts, [](const PossibleContact& contact) {
    return turn_of(contact.by_position, contact.by_normals).lower > 0;
  });
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t j = 1; j < contacts.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const PossibleContact &a = contacts[i], &b = contacts[j];
      if (are_too_close(a.by_position, b.by_position, theta) || are_too_close(a.by_normals, b.by_normals, theta))
        continue;
      const Bounds by_position = turn_of(a.by_position, b.by_position),
                   by_normals = turn_of(a.by_normals, b.by_normals);
      if (!(std::min(by_position.upper, by_normals.upper) >= 2 * theta)) continue;
      const double angle = std::max({theta, 0.5 * by_position.lower, 0.5 * by_normals.lower});
      const double d = std::sqrt(0.5 * (a.distance * a.distance + b.distance * b.distance)) * (1 - kBoundShare);
      const double around = least_radius_around(d, h, angle);
      if (around >= least) continue;
      least = std::min(least, std::max(around, least_radius_by_heights(a, b, rounding)));
      if (least <= known) return known;
    }
  }
  return least;
}

}  // namespace medial_vk
