// Paths as this program has them, UTF-8 everywhere, and as the standard library takes them: on Windows in UTF-16, where
// a path that is made from a `char` string would be read in the code page of the system.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "platform/utf16.h"

namespace medial_vk::platform {

/// The signs between folders.
#if defined(_WIN32)
inline constexpr const char* kFolderSigns = "/\\";
#else
inline constexpr const char* kFolderSigns = "/";
#endif

/// Text that is no UTF-8, and names that are no UTF-16, fail nowhere (platform/utf16.h).
inline std::filesystem::path path_of(std::string_view utf8) {
#if defined(_WIN32)
  const std::u16string units = utf16_of(utf8);
  return std::wstring(units.begin(), units.end());
#else
  return std::filesystem::path(utf8);
#endif
}

/// With `/` between folders, on Windows, too, which takes both: the same names stand in the files of every system.
inline std::string text_of(const std::filesystem::path& path) {
#if defined(_WIN32)
  const std::wstring text = path.generic_wstring();
  return utf8_of(std::u16string(text.begin(), text.end()));
#else
  return path.string();
#endif
}

/// The last part of a path, and that part without its extension.
inline std::string file_name_of(std::string_view path) { return text_of(path_of(path).filename()); }
inline std::string stem_of(std::string_view path) { return text_of(path_of(path).stem()); }

}  // namespace medial_vk::platform
