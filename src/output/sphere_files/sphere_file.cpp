#include "output/sphere_files/sphere_file.h"

#include <fmt/format.h>

#include "common/file_extension.h"
#include "output/sphere_files/encoders.h"

namespace medial_vk {

Result<SphereFormat> sphere_format_of(const std::string& path) {
  const std::string extension = file_extension(path);
  if (extension == ".csv") return SphereFormat::kCsv;
  if (extension == ".json") return SphereFormat::kJson;
  if (extension == ".yml" || extension == ".yaml") return SphereFormat::kCurobo;
  if (extension == ".xrdf") return SphereFormat::kXrdf;
  if (extension == ".urdf") return SphereFormat::kUrdf;
  return Error{
      ErrorCode::kUsage,
      fmt::format("'{}' ends in none of .csv, .json, .urdf, .xrdf, .yml and .yaml; choose one with --format", path)};
}

const char* name_of(SphereFormat format) {
  constexpr const char* kNames[] = {"csv", "json", "foam", "curobo", "xrdf", "urdf"};
  return kNames[static_cast<std::size_t>(format)];
}

bool has_levels(SphereFormat format) {
  return format == SphereFormat::kCsv || format == SphereFormat::kJson || format == SphereFormat::kFoam;
}

Result<std::string> encode_spheres(SphereFormat format, const SphereFile& file) {
  switch (format) {
    case SphereFormat::kCsv:
      return encode_spheres_csv(file);
    case SphereFormat::kJson:
      return encode_spheres_json(file);
    case SphereFormat::kFoam:
      return encode_spheres_foam(file);
    case SphereFormat::kCurobo:
      return encode_spheres_curobo(file);
    case SphereFormat::kXrdf:
      return encode_spheres_xrdf(file);
    case SphereFormat::kUrdf:
      break;
  }
  return encode_spheres_urdf(file);
}

}  // namespace medial_vk
