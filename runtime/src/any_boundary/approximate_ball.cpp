#include "any_boundary/approximate_ball.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "any_boundary/unit_vector.h"
#include "base/point_ops.h"

namespace medial_vk::any_boundary {
namespace {

std::array<float, 3> as_floats(const Point& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

double object_angle(const Contacts& contacts) {
  const Point a = unit(contacts.a - contacts.at), b = unit(contacts.b - contacts.at);
  return std::atan2(length(a - b), length(a + b));
}

double axis_distance(const Contacts& contacts, double error) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double near = length(contacts.nearest - contacts.at) - error;
  const double to_a = length(contacts.a - contacts.at), to_b = length(contacts.b - contacts.at);
  const double far = std::max(to_a, to_b) + error;
  if (!(near > 0 && error < std::min(to_a, to_b))) return kNone;
  // The directions to the points of the boundary that a and b stand for turn by that much at most.
  const double angle = object_angle(contacts) - std::asin(error / std::min(to_a, to_b));
  const double slope = near - far * std::cos(std::max(angle, 0.0));
  return slope > 0 ? std::max(0.0, (far + near) * (far - near)) / (2 * slope) : kNone;
}

std::optional<ApproximateBall> ball_at(const Contacts& contacts, std::uint64_t voxel, const Salience& salience,
                                       double error, double most) {
  const double radius = length(contacts.nearest - contacts.at) - error;
  if (!(radius > 0)) return std::nullopt;
  const double angle = object_angle(contacts);
  if (!(angle > salience.least_angle(radius))) return std::nullopt;
  const double distance = axis_distance(contacts, error);
  if (!(distance <= most)) return std::nullopt;
  const bool a_first = length(contacts.a - contacts.at) <= length(contacts.b - contacts.at);
  ApproximateBall found;
  found.sphere.centre = contacts.at;
  found.sphere.radius = radius;
  found.sphere.spoke_a = as_floats(unit((a_first ? contacts.a : contacts.b) - contacts.at));
  found.sphere.spoke_b = as_floats(unit((a_first ? contacts.b : contacts.a) - contacts.at));
  found.sphere.object_angle = static_cast<float>(angle);
  found.sphere.voxel = cell_of_code(voxel);
  found.axis_distance = distance;
  return found;
}

}  // namespace medial_vk::any_boundary
