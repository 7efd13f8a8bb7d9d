// Libraries that are loaded at run time.
#pragma once

#include <string>

namespace medial_vk::platform {

/// Null: `problem` says why. A library is never closed.
void* load_library(const std::string& name, std::string& problem);
/// The Vulkan loader, by the names that volk tries.
void* load_vulkan(std::string& problem);
/// Null: there is no such function.
void* function_of(void* library, const char* name);
/// Its file; empty: unknown.
std::string file_of(void* library);

}  // namespace medial_vk::platform
