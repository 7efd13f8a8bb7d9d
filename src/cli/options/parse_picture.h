// The arguments of --view, --up and --size.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "medial_vk/result.h"
#include "output/picture/panels/options.h"

namespace medial_vk::cli {

/// The direction from the shape to the viewer.
struct ViewChoice {
  std::array<double, 3> direction = PictureView().towards;
  bool is_side = true;  ///< x to the right of the front, y up; --up determines the corresponding axes of the mesh.

  bool operator==(const ViewChoice&) const = default;
};

/// A side (front, back, left, right, top, bottom), iso, or "x,y,z" in the axes of the mesh. Error: kUsage.
Result<ViewChoice> parse_view(const std::string& text);

/// Combines both options, in whichever order they were given.
PictureView view_of(const ViewChoice& choice, UpAxis up);

/// "x", "-z" and so on. Error: kUsage.
Result<UpAxis> parse_up(const std::string& text);

/// "N" for a square or "WxH", pixels. Error: kUsage, with the range.
Result<std::array<std::uint32_t, 2>> parse_size(const std::string& text);

}  // namespace medial_vk::cli
