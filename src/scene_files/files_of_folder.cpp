#include "scene_files/files_of_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/quoted.h"
#include "platform/paths.h"

namespace medial_vk {
namespace {

/// "a b.bin" of "a%20b.bin": the file names of glTF and COLLADA are URIs.
std::string without_percent_signs(const std::string& uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
  };
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_code = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    name += is_code ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (is_code) i += 2;
  }
  return name;
}

bool is_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

}  // namespace

std::string folder_of_scene(const std::string& path) {
  std::error_code error;
  const std::filesystem::path folder = platform::path_of(path).parent_path();
  return platform::text_of(std::filesystem::canonical(folder.empty() ? "." : folder, error));
}

Result<std::string> file_of_folder(const std::string& folder, const std::string& file) {
  const auto refuse = [&](const char* why) {
    const std::string name = platform::file_name_of(file);
    return Error{ErrorCode::kInvalidMesh, fmt::format("{}, {}", medial_vk::quoted(name), why)};
  };
  if (folder.empty()) return refuse("but has no folder");
  for (const std::string& name : {file, without_percent_signs(file)}) {
    std::error_code error;
    const std::filesystem::path path = std::filesystem::canonical(platform::path_of(name), error);
    if (error) continue;
    if (!is_inside(path, platform::path_of(folder))) return refuse("which is outside of its folder");
    if (std::filesystem::is_regular_file(path, error)) return platform::text_of(path);
  }
  return refuse("which is not there");
}

}  // namespace medial_vk
