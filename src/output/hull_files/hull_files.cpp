#include "output/hull_files/hull_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/tool_errors.h"
#include "output/hull_files/encoders.h"

namespace medial_vk {
namespace {

Result<std::string> encode_in(HullFormat format, const HullRecord& record) {
  switch (format) {
    case HullFormat::kJson:
      break;
    case HullFormat::kCsv:
      return encode_hulls_csv(record);
    case HullFormat::kMa:
      return encode_hulls_ma(record);
    case HullFormat::kUsd:
      return encode_hulls_usd(record);
    case HullFormat::kGlb:
      return encode_hulls_glb(record);
    case HullFormat::kGltf:
      return encode_hulls_gltf(record);
    case HullFormat::kObj:
      return encode_hulls_obj(record);
  }
  return encode_hulls_json(record);
}

}  // namespace

Result<std::string> encode_hulls(HullFormat format, const HullRecord& record) {
  Result<std::string> bytes = encode_in(format, record);
  if (bytes || bytes.error().code != kCannotWrite) return bytes;
  return Error{kCannotWrite, fmt::format("{}: {}; use .json, .csv or .ma", name_of(format), bytes.error().message)};
}

std::string number_text(std::size_t number, std::size_t count) {
  return fmt::format("{:0{}}", number, std::max<std::size_t>(2, fmt::formatted_size("{}", count)));
}

Error with_hull(Error error, std::size_t index) {
  error.message = fmt::format("hull {}: {}", index + 1, error.message);
  return error;
}

Error too_thin() { return {kCannotWrite, "a radius is smaller than what the digits of the format lose"}; }

}  // namespace medial_vk
