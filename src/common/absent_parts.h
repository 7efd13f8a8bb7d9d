// Parts of the tool that need a library which this build lacks (cmake/OptionalLibraries.cmake).
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

/// One line for each part that is absent, such as "libzip: no .npz is read or written".
std::vector<std::string> absent_parts();

/// Why files of this path cannot be written by this build: kUsage.
Status check_format_is_built(const std::string& path);

/// For readers and writers: "this build reads no .npz files, for which it needs libzip", and "writes".
std::string not_read(const char* format, const char* library);
std::string not_written(const std::string& format, const char* library);

}  // namespace medial_vk
