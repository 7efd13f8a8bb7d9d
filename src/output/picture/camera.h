// Where a point of the mesh lands in the picture.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "medial_vk/mesh_view.h"

namespace medial_vk::picture {

/// A part of the picture in pixels, y down.
struct Frame {
  float left = 0, top = 0, right = 0, bottom = 0;
};

/// A point as the rasteriser wants it: x and y in pixels, `nearness` = 1 / distance along the view. Nearness is linear
/// across a flat triangle on the screen, the distance itself is not.
struct ScreenPoint {
  float x = 0, y = 0, nearness = 0;
};

/// A perspective camera, fitted to points. View space: x to the right, y up, z towards the viewer.
class Camera {
 public:
  /// Looks at the shape from a three-quarter view and fills the frame with it. No points: looks at the origin.
  Camera(std::span<const Point> points, const Frame& frame);

  ScreenPoint project(const Point& point) const;
  /// Turns a direction of the mesh into view space.
  Eigen::Vector3f turn(const Eigen::Vector3f& direction) const { return rotation_ * direction; }
  /// Pixels per unit of the mesh at a nearness.
  float scale_at(float nearness) const { return pixels_ * unit_ * nearness; }
  /// Nearness lost by a step of one pixel's length away from the viewer.
  float nearness_per_pixel(float nearness) const { return nearness / pixels_; }
  /// Nearness of the closest and the farthest point that can be in the picture.
  float greatest_nearness() const { return 1.0f / (kDistance - 1.0f); }
  float least_nearness() const { return 1.0f / (kDistance + 1.0f); }

 private:
  static constexpr float kDistance = 5.0f;  // Of the eye from the centre, in radii of the shape: a long lens.

  /// Coordinates at a distance of 1 from the eye, and the nearness.
  ScreenPoint project_to_unit_plane(const Point& point) const;

  Eigen::Matrix3f rotation_;
  Point centre_ = {0, 0, 0};
  float unit_ = 1;  // One over the radius of the shape around its centre.
  float pixels_ = 1;
  float offset_x_ = 0, offset_y_ = 0;
};

}  // namespace medial_vk::picture
