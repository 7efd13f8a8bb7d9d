#pragma once

#include <string>
#include <string_view>

namespace medial_vk {

/// A word from a file, or a name, for a message: quoted, cut to a readable length, control characters replaced.
std::string quoted(std::string_view word);

}  // namespace medial_vk
