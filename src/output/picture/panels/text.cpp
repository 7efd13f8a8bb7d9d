#include "output/picture/panels/text.h"

namespace medial_vk::picture {
namespace {

/// Nine rows of five pixels, '#' is dark. The seventh row is the base line.
struct Glyph {
  char character;
  const char* rows;
};

// clang-format off
constexpr Glyph kGlyphs[] = {
    {'0', " ### " "#   #" "#  ##" "# # #" "##  #" "#   #" " ### " "     " "     "},
    {'1', "  #  " " ##  " "  #  " "  #  " "  #  " "  #  " " ### " "     " "     "},
    {'2', " ### " "#   #" "    #" "   # " "  #  " " #   " "#####" "     " "     "},
    {'3', " ### " "#   #" "    #" "  ## " "    #" "#   #" " ### " "     " "     "},
    {'4', "   # " "  ## " " # # " "#  # " "#####" "   # " "   # " "     " "     "},
    {'5', "#####" "#    " "#### " "    #" "    #" "#   #" " ### " "     " "     "},
    {'6', " ### " "#    " "#    " "#### " "#   #" "#   #" " ### " "     " "     "},
    {'7', "#####" "    #" "   # " "  #  " "  #  " "  #  " "  #  " "     " "     "},
    {'8', " ### " "#   #" "#   #" " ### " "#   #" "#   #" " ### " "     " "     "},
    {'9', " ### " "#   #" "#   #" " ####" "    #" "    #" " ### " "     " "     "},
    {'.', "     " "     " "     " "     " "     " " ##  " " ##  " "     " "     "},
    {',', "     " "     " "     " "     " "     " " ##  " " ##  " "  #  " " #   "},
    {'(', "   # " "  #  " " #   " " #   " " #   " "  #  " "   # " "     " "     "},
    {')', " #   " "  #  " "   # " "   # " "   # " "  #  " " #   " "     " "     "},
    {'+', "     " "     " "  #  " "  #  " "#####" "  #  " "  #  " "     " "     "},
    {'-', "     " "     " "     " " ### " "     " "     " "     " "     " "     "},
    {'a', "     " "     " " ### " "    #" " ####" "#   #" " ####" "     " "     "},
    {'b', "#    " "#    " "# ## " "##  #" "#   #" "#   #" "#### " "     " "     "},
    {'c', "     " "     " " ### " "#    " "#    " "#   #" " ### " "     " "     "},
    {'d', "    #" "    #" " ## #" "#  ##" "#   #" "#   #" " ####" "     " "     "},
    {'e', "     " "     " " ### " "#   #" "#####" "#    " " ### " "     " "     "},
    {'g', "     " "     " " ####" "#   #" "#   #" "#   #" " ####" "    #" " ### "},
    {'h', "#    " "#    " "# ## " "##  #" "#   #" "#   #" "#   #" "     " "     "},
    {'i', "  #  " "     " " ##  " "  #  " "  #  " "  #  " " ### " "     " "     "},
    {'j', "   # " "     " "  ## " "   # " "   # " "   # " "   # " "#  # " " ##  "},
    {'l', " ##  " "  #  " "  #  " "  #  " "  #  " "  #  " " ### " "     " "     "},
    {'m', "     " "     " "## # " "# # #" "# # #" "# # #" "# # #" "     " "     "},
    {'n', "     " "     " "# ## " "##  #" "#   #" "#   #" "#   #" "     " "     "},
    {'o', "     " "     " " ### " "#   #" "#   #" "#   #" " ### " "     " "     "},
    {'p', "     " "     " "#### " "#   #" "#   #" "##  #" "# ## " "#    " "#    "},
    {'r', "     " "     " "# ## " "##  #" "#    " "#    " "#    " "     " "     "},
    {'s', "     " "     " " ####" "#    " " ### " "    #" "#### " "     " "     "},
    {'t', " #   " " #   " "###  " " #   " " #   " " #  #" "  ## " "     " "     "},
    {'u', "     " "     " "#   #" "#   #" "#   #" "#  ##" " ## #" "     " "     "},
};
// clang-format on

const char* rows_of(char character) {
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.character == character) return glyph.rows;
  }
  return nullptr;
}

}  // namespace

void draw_text(std::string_view text, const std::function<void(std::uint32_t x, std::uint32_t y)>& set_pixel) {
  constexpr std::uint32_t kColumns = kGlyphWidth - 1;
  std::uint32_t left = 0;
  for (const char character : text) {
    const char* rows = rows_of(character);
    for (std::uint32_t i = 0; rows != nullptr && i < kColumns * kGlyphHeight; ++i) {
      if (rows[i] == '#') set_pixel(left + i % kColumns, i / kColumns);
    }
    left += kGlyphWidth;
  }
}

}  // namespace medial_vk::picture
