// A text in a table (CSV).
#pragma once

#include <string>

namespace medial_vk {

/// As RFC 4180 requires: a text with a comma, a quote or a line end is in quotes, and its quotes are doubled.
std::string csv_cell(const std::string& text);

}  // namespace medial_vk
