// The transform between the coordinates of a mesh and those of the device.
#pragma once

#include <array>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// (x - lower) / longest.
struct UnitTransform {
  Point lower = {0, 0, 0};
  double longest = 1;
  Point operator()(const Point& p) const {
    return {(p[0] - lower[0]) / longest, (p[1] - lower[1]) / longest, (p[2] - lower[2]) / longest};
  }
  /// The inverse.
  Point inverse(const std::array<float, 3>& p) const {
    return {lower[0] + longest * double{p[0]}, lower[1] + longest * double{p[1]}, lower[2] + longest * double{p[2]}};
  }
};

}  // namespace medial_vk
