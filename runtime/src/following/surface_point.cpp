#include "following/surface_point.h"

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

Frame frame_of(const Corners3& corners, double front) {
  Frame frame = {false, corners[1] - corners[0], corners[2] - corners[0], {}, {}, {}};
  double shorter = 0;
  const Point area = double_area(corners[0], corners[1], corners[2], shorter);
  const double size = length(area);
  if (!(size > kAreaRounding * shorter)) return frame;
  frame.has_area = true;
  const Point normal = (1 / size) * area;
  frame.inward = -front * normal;
  frame.dual_ab = (1 / size) * cross(frame.ac, normal);
  frame.dual_ac = (1 / size) * cross(normal, frame.ab);
  return frame;
}

}  // namespace

SurfacePoint surface_point_at(const Point& point, std::uint32_t triangle, const Corners3& corners) {
  const Frame frame = frame_of(corners, 1);
  const Point offset = point - corners[0];
  if (!frame.has_area) {
    // On the longest of the sides, which the triangle hardly leaves.
    const double ab = dot(frame.ab, frame.ab), ac = dot(frame.ac, frame.ac);
    if (!(ab > 0 || ac > 0)) return {triangle, 0, 0};
    const bool along_ab = ab >= ac;
    const double share = std::clamp(dot(offset, along_ab ? frame.ab : frame.ac) / (along_ab ? ab : ac), 0.0, 1.0);
    return {triangle, along_ab ? share : 0, along_ab ? 0 : share};
  }
  const double v = std::clamp(dot(offset, frame.dual_ab), 0.0, 1.0);
  return {triangle, v, std::clamp(dot(offset, frame.dual_ac), 0.0, 1 - v)};
}

Point carried_direction(const Point& direction, const Corners3& corners, double front, const Corners3& new_corners,
                        double new_front) {
  const Frame from = frame_of(corners, front), to = frame_of(new_corners, new_front);
  if (!from.has_area || !to.has_area) return direction;
  const Point image = dot(direction, from.ab) * to.dual_ab + dot(direction, from.ac) * to.dual_ac +
                      dot(direction, from.inward) * to.inward;
  const double size = length(image);
  return size > 0 ? (1 / size) * image : direction;
}

}  // namespace medial_vk
