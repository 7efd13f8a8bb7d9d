// A few letters for the legend of the picture.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace medial_vk::picture {

constexpr std::uint32_t kGlyphWidth = 6;   // Includes the gap to the next glyph.
constexpr std::uint32_t kGlyphHeight = 9;  // Includes the part below the base line.

/// Calls `set_pixel(x, y)` for every dark pixel of the text, from (0, 0) at its upper left. Characters that the font
/// lacks (it has digits, lower case letters and some punctuation) stay blank.
void draw_text(std::string_view text, const std::function<void(std::uint32_t x, std::uint32_t y)>& set_pixel);

}  // namespace medial_vk::picture
