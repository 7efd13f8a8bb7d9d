// The size of what a zip contains, before anything of it is expanded.
#pragma once

#include <cstdint>
#include <string_view>

namespace medial_vk {

/// The sum of the lengths that the directory of the zip declares for its files; 0 if the bytes are no zip.
std::uint64_t expanded_size(std::string_view bytes);

}  // namespace medial_vk
