// Text by fmt's format strings, for messages. fmt's code is in its headers, and is compiled in format_text.cpp alone:
// each room that calls fmt::format() would compile it again, for four seconds.
#pragma once

#include <fmt/core.h>

#include <string>

namespace medial_vk {

std::string format_text_of(fmt::string_view format, fmt::format_args values);

/// As fmt::format().
template <typename... Values>
std::string format_text(fmt::format_string<Values...> format, Values&&... values) {
  return format_text_of(format, fmt::make_format_args(values...));
}

}  // namespace medial_vk
