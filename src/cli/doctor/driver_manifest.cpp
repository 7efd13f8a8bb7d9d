#include "cli/doctor/driver_manifest.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <string>

#include <nlohmann/json.hpp>

#include "platform/paths.h"

namespace medial_vk::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Far more than any driver file has.
constexpr std::size_t kMostBytes = std::size_t{1} << 20;

/// A path with a slash is relative to the file; a name alone is left to the system's search.
std::string resolved(const std::string& library, const std::string& file) {
  if (library.find('/') == std::string::npos || library.starts_with('/')) return library;
  return platform::text_of((platform::path_of(file).parent_path() / platform::path_of(library)).lexically_normal());
}

/// The text under a key of an object; empty: there is none.
std::string text_at(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// What the loader requires of "ICD"; fills the library and the version.
std::string problem_of(const Json& icd, DriverRecord& driver) {
  driver.library = resolved(text_at(icd, "library_path"), driver.file);
  driver.api_version = text_at(icd, "api_version");
  if (driver.library.empty()) return "the file has no \"library_path\" in \"ICD\"";
  if (driver.api_version.empty()) return "the file has no \"api_version\" in \"ICD\"";
  const std::string bits = text_at(icd, "library_arch");
  const char* const ours = sizeof(void*) == 8 ? "64" : "32";
  if (!bits.empty() && bits != ours) return fmt::format("its library is for programs of {} bits", bits);
  const auto portability = icd.find("is_portability_driver");
  if (portability != icd.end() && portability->is_boolean() && portability->get<bool>())
    return "it is a driver without all of Vulkan (\"is_portability_driver\"), which is not used";
  return {};
}

}  // namespace

void read_manifest(std::string_view bytes, DriverRecord& driver) {
  const Json json = Json::parse(bytes, nullptr, false);
  const auto icd = json.is_object() ? json.find("ICD") : json.end();
  if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    driver.problem = "the file is empty";
  } else if (!json.is_object()) {
    driver.problem = json.is_discarded() ? "the file is not JSON" : "the file is not a JSON object";
    driver.stops_loader = true;
  } else if (text_at(json, "file_format_version").empty()) {
    driver.problem = "the file has no \"file_format_version\"";
  } else if (icd == json.end() || !icd->is_object()) {
    driver.problem = "the file has no object \"ICD\"";
  } else {
    driver.problem = problem_of(*icd, driver);
  }
}

void read_manifest(DriverRecord& driver) {
  driver.is_broken = true;  // until it has been read
  std::error_code error;
  std::ifstream file(platform::path_of(driver.file), std::ios::binary);
  const int reason = errno;
  const bool is_folder = fs::is_directory(platform::path_of(driver.file), error);
  if (!file || is_folder) {
    driver.problem = fmt::format("the file cannot be read: {}", std::strerror(is_folder ? EISDIR : reason));
    return;
  }
  std::string bytes(kMostBytes + 1, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.size() > kMostBytes) {
    driver.problem = "the file is too long for a driver file";
    return;
  }
  read_manifest(bytes, driver);
  driver.is_broken = !driver.problem.empty();
}

}  // namespace medial_vk::cli
