// Which programs the last run needed, kept beside the pipeline cache: the next run makes them before they are asked
// for. A driver's cache does not hold all of its work (Mesa's lavapipe translates every shader anew, a quarter of a
// second for an extraction), but threads can share it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "program.h"

namespace medial_vk {

/// Beside the file of the pipeline cache; none (empty) if there is none.
std::string program_list_file(const std::string& pipeline_cache_file);
/// In the order of their first use. Empty if the file is missing, damaged, or of other shaders than the embedded ones.
std::vector<ProgramKey> read_program_list(const std::string& file);
/// Replaces the file, whole or not at all; failing to is no error, the list is only there to save time.
void write_program_list(const std::string& file, const std::vector<ProgramKey>& keys);

}  // namespace medial_vk
