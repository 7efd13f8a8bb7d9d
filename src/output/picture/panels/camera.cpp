#include "output/picture/panels/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk::picture {

Eigen::Matrix3f rotation_for(const PictureView& view) {
  const Eigen::Vector3d towards = Eigen::Vector3d(view.towards.data()).stableNormalized();
  const Eigen::Vector3d above(in_mesh_axes({0, 1, 0}, view.up).data());
  const Eigen::Vector3d front(in_mesh_axes({0, 0, 1}, view.up).data());
  // In a view from above or below, the front of the shape points down in the picture, or up.
  constexpr double kAlongUp = 0.9999;
  const double height = towards.dot(above);
  const Eigen::Vector3d up = std::abs(height) < kAlongUp ? above : (height > 0 ? -front : front).eval();
  const Eigen::Vector3d right = up.cross(towards).normalized();
  Eigen::Matrix3d rows;
  rows << right.transpose(), towards.cross(right).transpose(), towards.transpose();
  return rows.cast<float>();
}

Camera::Camera(std::span<const Eigen::Vector3f> points, const PictureView& view, const Frame& frame)
    : rotation_(rotation_for(view)) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Frame bounds = {kInfinity, kInfinity, -kInfinity, -kInfinity};
  for (const Eigen::Vector3f& point : points) {
    const ScreenPoint p = project_to_unit_plane(point);
    bounds = {std::min(bounds.left, p.x), std::min(bounds.top, p.y), std::max(bounds.right, p.x),
              std::max(bounds.bottom, p.y)};
  }
  const bool has_size = std::max(bounds.right - bounds.left, bounds.bottom - bounds.top) > 1e-6f;
  if (!has_size) bounds = {-0.1f, -0.1f, 0.1f, 0.1f};
  const float width = std::max(bounds.right - bounds.left, 1e-6f);
  const float height = std::max(bounds.bottom - bounds.top, 1e-6f);
  pixels_ = std::min((frame.right - frame.left) / width, (frame.bottom - frame.top) / height);
  offset_x_ = 0.5f * (frame.left + frame.right) - 0.5f * pixels_ * (bounds.left + bounds.right);
  offset_y_ = 0.5f * (frame.top + frame.bottom) - 0.5f * pixels_ * (bounds.top + bounds.bottom);
}

ScreenPoint Camera::project_to_unit_plane(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f view = rotation_ * point;
  const float nearness = 1.0f / (kDistance - view.z());
  return {view.x() * nearness, -view.y() * nearness, nearness};
}

ScreenPoint Camera::project(const Eigen::Vector3f& point) const {
  const ScreenPoint p = project_to_unit_plane(point);
  return {offset_x_ + pixels_ * p.x, offset_y_ + pixels_ * p.y, p.nearness};
}

}  // namespace medial_vk::picture
