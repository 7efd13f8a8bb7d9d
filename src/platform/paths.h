// Paths as this program has them, UTF-8 everywhere, and as the standard library takes them: on Windows in UTF-16, where
// a path that is made from a `char` string would be read in the code page of the system.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace medial_vk::platform {

/// The signs between folders.
#if defined(_WIN32)
inline constexpr const char* kFolderSigns = "/\\";
#else
inline constexpr const char* kFolderSigns = "/";
#endif

inline std::filesystem::path path_of(std::string_view utf8) {
  return std::filesystem::path(std::u8string(utf8.begin(), utf8.end()));
}

/// With `/` between folders, on Windows, too, which takes both: the same names stand in the files of every system.
inline std::string text_of(const std::filesystem::path& path) {
  const std::u8string text = path.generic_u8string();
  return {text.begin(), text.end()};
}

/// The last part of a path, and that part without its extension.
inline std::string file_name_of(std::string_view path) { return text_of(path_of(path).filename()); }
inline std::string stem_of(std::string_view path) { return text_of(path_of(path).stem()); }

}  // namespace medial_vk::platform
