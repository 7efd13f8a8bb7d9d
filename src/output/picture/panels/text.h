// A few letters for the legend of the picture.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace medial_vk::picture {

constexpr std::uint32_t kGlyphWidth = 6;   // With the gap to the next one.
constexpr std::uint32_t kGlyphHeight = 9;  // With the part below the base line.

/// Calls `set_pixel(x, y)` for every dark pixel of the text, from (0, 0) at its upper left. Characters that the font
/// lacks (it has digits, lower case letters and a little punctuation) are left blank.
void draw_text(std::string_view text, const std::function<void(std::uint32_t x, std::uint32_t y)>& set_pixel);

}  // namespace medial_vk::picture
