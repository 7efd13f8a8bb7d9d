// Numbers for readers that distinguish floats from integers and from words by their dot.
#pragma once

#include <string>
#include <string_view>

namespace medial_vk {

/// The fewest digits that read back as the same double, always with a dot: "1.0", "1.0e-05", which YAML readers parse
/// as a float (many parse "1e-05" as a word). `x` is finite.
std::string float_text(double x);

/// A word in YAML: plain where no reader can interpret it differently, else in double quotes.
std::string yaml_word(std::string_view word);

}  // namespace medial_vk
