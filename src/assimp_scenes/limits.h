// Limits of the process in which assimp runs.
#pragma once

#include <cstdint>

namespace medial_vk {

/// Bounds the memory and the processor time of this process by the length of the file that it reads, and lets it write
/// no file. The process ends with the one that started it.
void limit_this_process(std::uint64_t file_bytes);

/// Allows for another file that belongs to the scene.
void allow_for(std::uint64_t file_bytes);

}  // namespace medial_vk
