// The content, the view and the size of a picture, as chosen by the command line.
#pragma once

#include <array>
#include <cstdint>

#include "common/up_axis.h"

namespace medial_vk {

enum class PictureShow {
  kPoints,    ///< The mesh as glass, with the medial points in it as discs.
  kBalls,     ///< The union of the balls.
  kBoth,      ///< Both, side by side.
  kBoundary,  ///< The mesh, opaque, in the colours of what was measured on it (output/picture/boundary_picture.h).
};

enum class PictureColour { kAngle, kRadius, kSheet };

/// Sides of a picture, in pixels. The greatest keeps the number of its bytes below 2^31, a limit of the writer of PNG
/// files.
constexpr std::uint32_t kLeastPictureSide = 16, kGreatestPictureSide = 16384;

/// The view of a picture. In a view along the upward axis, the front points down in the picture, or up.
struct PictureView {
  std::array<double, 3> towards = {0.544, 0.352, 0.762};  ///< From the shape to the viewer, in its axes; any length.
  UpAxis up = UpAxis::kY;

  bool operator==(const PictureView&) const = default;
};

struct PictureOptions {
  /// Width and height, pixels; 0: the default, 1200 x 900 or, side by side, 1800 x 900.
  std::array<std::uint32_t, 2> size = {0, 0};
  PictureView view = {};
  PictureShow show = PictureShow::kPoints;
  PictureColour colour = PictureColour::kAngle;
  bool frame_points = false;  ///< The picture shows all points or balls, not the mesh alone.
  double least_angle = 0.6;   ///< Object angle at the lower end of the colours, radians; the upper end is pi/2.

  bool operator==(const PictureOptions&) const = default;
};

}  // namespace medial_vk
