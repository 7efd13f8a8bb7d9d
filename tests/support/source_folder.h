#pragma once

#include <filesystem>

namespace medial_vk::test {

/// The root of the source tree.
std::filesystem::path source_folder();

}  // namespace medial_vk::test
