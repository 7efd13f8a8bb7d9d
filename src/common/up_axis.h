// The upward axis of a mesh: y by default, z in most parts made in CAD.
#pragma once

#include <array>

namespace medial_vk {

enum class UpAxis { kX, kY, kZ, kMinusX, kMinusY, kMinusZ };

/// The spelling of --up and of the page: "-z".
constexpr const char* axis_name(UpAxis up) {
  switch (up) {
    case UpAxis::kX:
      return "x";
    case UpAxis::kY:
      return "y";
    case UpAxis::kZ:
      return "z";
    case UpAxis::kMinusX:
      return "-x";
    case UpAxis::kMinusY:
      return "-y";
    case UpAxis::kMinusZ:
      return "-z";
  }
  return "";
}

/// Maps a direction seen from the front (x to the right, y up, z towards the viewer) to the axes of a mesh. Shapes are
/// turned by the smallest rotation: with z up, the front faces -y, as in CAD. src/page/viewer.js does the same.
constexpr std::array<double, 3> in_mesh_axes(const std::array<double, 3>& d, UpAxis up) {
  switch (up) {
    case UpAxis::kX:
      return {d[1], -d[0], d[2]};
    case UpAxis::kY:
      return d;
    case UpAxis::kZ:
      return {d[0], -d[2], d[1]};
    case UpAxis::kMinusX:
      return {-d[1], d[0], d[2]};
    case UpAxis::kMinusY:
      return {d[0], -d[1], -d[2]};
    case UpAxis::kMinusZ:
      return {d[0], d[2], -d[1]};
  }
  return d;
}

}  // namespace medial_vk
