#include "cli/options/output_names.h"

#include <fmt/format.h>

#include <filesystem>

#include "common/file_extension.h"
#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;

}  // namespace

bool same_file(const std::string& a, const std::string& b) {
  if (a == "-" || b == "-") return a == b;
  std::error_code error;
  if (fs::equivalent(platform::path_of(a), platform::path_of(b), error)) return true;
  const auto whole = [&error](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(platform::path_of(path), error), error);
  };
  return whole(a) == whole(b);
}

bool may_end_in(const std::string& path, const char* extension) {
  return path.empty() || path == "-" || file_extension(path) == extension;
}

Status check_outputs_differ(std::span<const NamedOutput> outputs, const std::string& input) {
  const auto usage_error = [](std::string message) { return Error{ErrorCode::kUsage, std::move(message)}; };
  for (const NamedOutput& output : outputs) {
    if (output.file->empty()) continue;
    if (*output.file != "-" && same_file(*output.file, input)) {
      return usage_error(fmt::format("{} would overwrite the input {}", output.option, input));
    }
    for (const NamedOutput& other : outputs) {
      if (output.file == other.file || other.file->empty()) continue;
      if (same_file(*output.file, *other.file)) {
        return usage_error(fmt::format("{} and {} are the same file", output.option, other.option));
      }
    }
  }
  return {};
}

Status check_no_stream(std::span<const NamedOutput> outputs) {
  for (const NamedOutput& output : outputs) {
    if (*output.file != "-") continue;
    return Error{ErrorCode::kUsage, fmt::format("--each writes a file for each mesh: {} cannot be -", output.option)};
  }
  return {};
}

std::string with_part(const std::string& path, const std::string& part) {
  const fs::path name = platform::path_of(path);
  fs::path stem = name.stem();
  std::string extension = platform::text_of(name.extension());
  while (stem.extension() == ".medial" || stem.extension() == ".spheres" || stem.extension() == ".foam") {
    extension.insert(0, platform::text_of(stem.extension()));
    stem = stem.stem();
  }
  return platform::text_of(name.parent_path() / platform::path_of(platform::text_of(stem) + "." + part + extension));
}

}  // namespace medial_vk::cli
