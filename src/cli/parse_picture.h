// What --view and --size take.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "medial_vk/result.h"

namespace medial_vk::cli {

/// A side (front, back, left, right, top, bottom), iso, or "x,y,z": the direction from the shape to the viewer.
/// Error: kUsage.
Result<std::array<double, 3>> parse_view(const std::string& text);

/// "N" for a square or "WxH", pixels. Error: kUsage, with the range.
Result<std::array<std::uint32_t, 2>> parse_size(const std::string& text);

}  // namespace medial_vk::cli
