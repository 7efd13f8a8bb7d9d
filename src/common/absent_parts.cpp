#include "common/absent_parts.h"

#include <fmt/format.h>

#include "common/file_extension.h"

namespace medial_vk {
namespace {

#if defined(MEDIAL_VK_HAS_ASSIMP)
constexpr bool kHasAssimp = true;
#else
constexpr bool kHasAssimp = false;
#endif
#if defined(MEDIAL_VK_HAS_ZIP)
constexpr bool kHasZip = true;
#else
constexpr bool kHasZip = false;
#endif
#if defined(MEDIAL_VK_HAS_XML)
constexpr bool kHasXml = true;
#else
constexpr bool kHasXml = false;
#endif

}  // namespace

std::vector<std::string> absent_parts() {
  std::vector<std::string> absent;
  if (!kHasAssimp) absent.emplace_back("assimp: no glTF, 3MF, FBX, COLLADA or other scenes are read");
  if (!kHasZip) absent.emplace_back("libzip: no .npz is read or written");
  if (!kHasXml) absent.emplace_back("tinyxml2: no URDF, SRDF or SVG is read, and no URDF is written");
  return absent;
}

Status check_format_is_built(const std::string& path) {
  const std::string extension = file_extension(path);
  const bool needs_zip = !kHasZip && extension == ".npz", needs_xml = !kHasXml && extension == ".urdf";
  if (!needs_zip && !needs_xml) return {};
  return Error{ErrorCode::kUsage,
               fmt::format("{}: {}", path, not_written(extension, needs_zip ? "libzip" : "tinyxml2"))};
}

std::string not_read(const char* format, const char* library) {
  return fmt::format("this build reads no {} files, for which it needs {}", format, library);
}

std::string not_written(const std::string& format, const char* library) {
  return fmt::format("this build writes no {} files, for which it needs {}", format, library);
}

}  // namespace medial_vk
