#include "common/hull_format.h"

#include <fmt/format.h>

#include "common/file_extension.h"

namespace medial_vk {

const char* name_of(HullFormat format) {
  switch (format) {
    case HullFormat::kJson:
      break;
    case HullFormat::kCsv:
      return "csv";
    case HullFormat::kMa:
      return "ma";
    case HullFormat::kUsd:
      return "usda";
    case HullFormat::kGlb:
      return "glb";
    case HullFormat::kGltf:
      return "gltf";
    case HullFormat::kObj:
      return "obj";
  }
  return "json";
}

Result<HullFormat> hull_format_of(const std::string& path) {
  const std::string extension = file_extension(path);
  std::string known;
  for (const HullFormat format : kHullFormats) {
    if (extension == std::string(".") + name_of(format)) return format;
    known += fmt::format("{}.{}", known.empty() ? "" : ", ", name_of(format));
  }
  return Error{ErrorCode::kUsage, fmt::format("'{}' ends in none of {}", path, known)};
}

}  // namespace medial_vk
