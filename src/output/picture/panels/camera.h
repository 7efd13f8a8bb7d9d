// Projection of points of the shape into the picture.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "output/picture/panels/options.h"

namespace medial_vk::picture {

/// A part of the picture in pixels, y down.
struct Frame {
  float left = 0, top = 0, right = 0, bottom = 0;
};

/// A point for the rasteriser: x and y in pixels, `nearness` = 1 / distance along the view. Nearness is linear across a
/// flat triangle on the screen, while distance is not.
struct ScreenPoint {
  float x = 0, y = 0, nearness = 0;
};

/// Rows: the directions to the right, up and towards the viewer, in the axes of the shape.
Eigen::Matrix3f rotation_for(const PictureView& view);

/// A perspective camera, fitted to points of the unit ball. View space: x to the right, y up, z towards the viewer.
class Camera {
 public:
  static constexpr float kDistance = 5.0f;  // From the eye to the centre, in radii of the shape: a long lens.

  /// Views the points from the direction of `view` and fills the frame with them. Without points, it views the origin.
  Camera(std::span<const Eigen::Vector3f> points, const PictureView& view, const Frame& frame);

  /// The same view in a picture without its first rows.
  Camera below(float rows) const {
    Camera other = *this;
    other.offset_y_ -= rows;
    return other;
  }

  ScreenPoint project(const Eigen::Vector3f& point) const;
  /// Turns a direction, or a point, of the shape into view space.
  Eigen::Vector3f turn(const Eigen::Vector3f& direction) const { return rotation_ * direction; }
  /// Pixels per radius of the shape at a nearness.
  float scale_at(float nearness) const { return pixels_ * nearness; }
  /// Nearness lost by a step of one pixel's length away from the viewer.
  float nearness_per_pixel(float nearness) const { return nearness / pixels_; }
  /// Nearness of the closest and the farthest point that can be in the picture.
  static constexpr float greatest_nearness() { return 1.0f / (kDistance - 1.0f); }
  static constexpr float least_nearness() { return 1.0f / (kDistance + 1.0f); }

  const Eigen::Matrix3f& rotation() const { return rotation_; }
  float pixels() const { return pixels_; }  // Per unit at a distance of 1 from the eye.
  float offset_x() const { return offset_x_; }
  float offset_y() const { return offset_y_; }

 private:
  /// Coordinates at a distance of 1 from the eye, and the nearness.
  ScreenPoint project_to_unit_plane(const Eigen::Vector3f& point) const;

  Eigen::Matrix3f rotation_;
  float pixels_ = 1;
  float offset_x_ = 0, offset_y_ = 0;
};

}  // namespace medial_vk::picture
