// Numbers for readers that tell floats from whole numbers and from words by their dot.
#pragma once

#include <string>
#include <string_view>

namespace medial_vk {

/// The fewest digits that read back as the same double, always with a dot: "1.0", "1.0e-05", which YAML readers take
/// for a float ("1e-05" is a word to many). `x` is finite.
std::string float_text(double x);

/// A word as YAML has it: as it is where no reader can take it for anything else, or in double quotes.
std::string yaml_word(std::string_view word);

}  // namespace medial_vk
