// A picture as pixels, and as the bytes of a PNG file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

/// Rows from the top, three bytes (red, green, blue) per pixel.
struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;
};

/// The bytes of a PNG file. Error: kOutOfMemory.
Result<std::string> encode_png(const Picture& picture);

}  // namespace medial_vk
