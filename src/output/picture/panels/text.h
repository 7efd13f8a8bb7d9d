// Letters for the legend of the picture.
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace medial_vk::picture {

constexpr std::uint32_t kGlyphWidth = 6;   // Includes the gap to the next glyph.
constexpr std::uint32_t kGlyphHeight = 9;  // Includes the part below the base line.

/// The width of a text in UTF-8, one glyph for each character.
std::uint32_t text_width(std::string_view text);

/// Calls `set_pixel(x, y)` for every dark pixel of the text, from (0, 0) at its upper left. A character that the font
/// lacks (it has digits, the letters of ASCII and some punctuation) is a box.
void draw_text(std::string_view text, const std::function<void(std::uint32_t x, std::uint32_t y)>& set_pixel);

}  // namespace medial_vk::picture
