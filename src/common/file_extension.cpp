#include "common/file_extension.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "platform/paths.h"

namespace medial_vk {

std::string file_extension(const std::string& path) {
  std::string extension = platform::text_of(platform::path_of(path).extension());
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace medial_vk
