#include "output/picture/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk::picture {
namespace {

constexpr float kAzimuth = 0.62f;    // Radians to the right of the front.
constexpr float kElevation = 0.36f;  // Radians above the horizon.

Eigen::Matrix3f three_quarter_view() {
  const Eigen::AngleAxisf around(-kAzimuth, Eigen::Vector3f::UnitY());
  const Eigen::AngleAxisf above(kElevation, Eigen::Vector3f::UnitX());
  return (above * around).toRotationMatrix();
}

Point centre_of_box(std::span<const Point> points) {
  Point centre = {0, 0, 0};
  for (std::size_t axis = 0; axis < 3 && !points.empty(); ++axis) {
    const auto [least, greatest] = std::minmax_element(
        points.begin(), points.end(), [&](const Point& a, const Point& b) { return a[axis] < b[axis]; });
    centre[axis] = 0.5 * ((*least)[axis] + (*greatest)[axis]);
  }
  return centre;
}

double greatest_distance(std::span<const Point> points, const Point& centre) {
  double greatest = 0;
  for (const Point& p : points) {
    greatest = std::max(greatest, std::hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]));
  }
  return greatest;
}

}  // namespace

Camera::Camera(std::span<const Point> points, const Frame& frame)
    : rotation_(three_quarter_view()), centre_(centre_of_box(points)) {
  const double radius = greatest_distance(points, centre_);
  if (radius > 0) unit_ = static_cast<float>(1.0 / radius);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Frame bounds = {kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (const Point& point : points) {
    const ScreenPoint p = project_to_unit_plane(point);
    bounds = {std::min(bounds.left, p.x), std::min(bounds.top, p.y), std::max(bounds.right, p.x),
              std::max(bounds.bottom, p.y)};
  }
  if (radius <= 0) bounds = {-0.1f, -0.1f, 0.1f, 0.1f};
  const float width = std::max(bounds.right - bounds.left, 1e-6f);
  const float height = std::max(bounds.bottom - bounds.top, 1e-6f);
  pixels_ = std::min((frame.right - frame.left) / width, (frame.bottom - frame.top) / height);
  offset_x_ = 0.5f * (frame.left + frame.right) - 0.5f * pixels_ * (bounds.left + bounds.right);
  offset_y_ = 0.5f * (frame.top + frame.bottom) - 0.5f * pixels_ * (bounds.top + bounds.bottom);
}

ScreenPoint Camera::project_to_unit_plane(const Point& point) const {
  // The difference is taken in double: a small shape far from the origin keeps its digits.
  const Eigen::Vector3f local(static_cast<float>(point[0] - centre_[0]), static_cast<float>(point[1] - centre_[1]),
                              static_cast<float>(point[2] - centre_[2]));
  const Eigen::Vector3f view = rotation_ * (local * unit_);
  const float nearness = 1.0f / (kDistance - view.z());
  return {view.x() * nearness, -view.y() * nearness, nearness};
}

ScreenPoint Camera::project(const Point& point) const {
  const ScreenPoint p = project_to_unit_plane(point);
  return {offset_x_ + pixels_ * p.x, offset_y_ + pixels_ * p.y, p.nearness};
}

}  // namespace medial_vk::picture
