#include "following/surface/surface_point.h"

#include <algorithm>

namespace medial_vk {
namespace {

/// The edges from corner 0 and the inward unit normal of a triangle, and the vectors dual to these three: each has the
/// product 1 with its own and 0 with the others. `has_area` is false where the edges have no meaningful normal.
struct Frame {
  bool has_area;
  Point ab, ac, inward;
  Point dual_ab, dual_ac;
};

/// Twice the area, along the normal; 0 where rounding leaves no direction.
Point meaningful_area(const Corners3& corners) {
  double shorter = 0;
  const Point area = double_area(corners[0], corners[1], corners[2], shorter);
  return length(area) > kAreaRounding * shorter ? area : Point{0, 0, 0};
}

Frame frame_of(const Corners3& corners, double front) {
  Frame frame = {false, corners[1] - corners[0], corners[2] - corners[0], {}, {}, {}};
  const Point area = meaningful_area(corners);
  const double size = length(area);
  if (!(size > 0)) return frame;
  frame.has_area = true;
  const Point normal = (1 / size) * area;
  frame.inward = -front * normal;
  frame.dual_ab = (1 / size) * cross(frame.ac, normal);
  frame.dual_ac = (1 / size) * cross(normal, frame.ab);
  return frame;
}

/// The share of the way from `from` along `side` at which `point` lies.
double share_along(const Point& point, const Point& from, const Point& side) {
  return std::clamp(dot(point - from, side) / dot(side, side), 0.0, 1.0);
}

/// On the longest side, which a triangle without an area does not leave.
SurfacePoint point_on_side(const Point& point, std::uint32_t triangle, const Corners3& corners) {
  const Point ab = corners[1] - corners[0], ac = corners[2] - corners[0], bc = corners[2] - corners[1];
  const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  if (!(longest > 0)) return {triangle, 0, 0};
  if (dot(ab, ab) == longest) return {triangle, share_along(point, corners[0], ab), 0};
  if (dot(ac, ac) == longest) return {triangle, 0, share_along(point, corners[0], ac)};
  const double w = share_along(point, corners[1], bc);
  return {triangle, 1 - w, w};
}

}  // namespace

SurfacePoint surface_point_at(const Point& point, std::uint32_t triangle, const Corners3& corners) {
  const Frame frame = frame_of(corners, 1);
  if (!frame.has_area) return point_on_side(point, triangle, corners);
  const Point offset = point - corners[0];
  const double v = std::clamp(dot(offset, frame.dual_ab), 0.0, 1.0);
  return {triangle, v, std::clamp(dot(offset, frame.dual_ac), 0.0, 1 - v)};
}

Point inward_normal_of(const Corners3& corners, double front) {
  const Point area = meaningful_area(corners);
  const double size = length(area);
  return size > 0 ? (-front / size) * area : area;
}

std::optional<Point> carried_direction(const Point& direction, const Corners3& corners, double front,
                                       const Corners3& new_corners, double new_front) {
  const Frame from = frame_of(corners, front), to = frame_of(new_corners, new_front);
  if (!from.has_area || !to.has_area) return std::nullopt;
  const Point image = dot(direction, from.ab) * to.dual_ab + dot(direction, from.ac) * to.dual_ac +
                      dot(direction, from.inward) * to.inward;
  const double size = length(image);
  if (!(size > 0)) return std::nullopt;
  return (1 / size) * image;
}

}  // namespace medial_vk
