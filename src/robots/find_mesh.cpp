#include "robots/find_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "input/text_scanner.h"
#include "platform/machine.h"
#include "platform/paths.h"
#include "platform/processes.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;
using platform::path_of;
using platform::text_of;

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_directory(path, error);
}

/// Adds the parts of a path list, with `below` appended to each.
void add_paths(const char* variable, const char* below, std::vector<std::string>& paths) {
  const std::string value = platform::variable_of(variable).value_or("");
  std::string_view rest = value;
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find(platform::kListSeparator));
    if (!part.empty()) paths.push_back(text_of(path_of(part) / below));
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
  }
}

std::optional<fs::path> find_package(const std::string& name, const MeshPlaces& places) {
  for (const auto& [known, folder] : places.packages) {
    if (known == name) return path_of(folder);
  }
  const auto in = [&](const fs::path& folder) -> std::optional<fs::path> {
    if (is_folder(folder / path_of(name))) return folder / path_of(name);
    if (folder.filename() == path_of(name) && is_folder(folder)) return folder;
    return std::nullopt;
  };
  for (const std::string& folder : places.search) {
    if (auto found = in(path_of(folder))) return found;
  }
  std::error_code error;
  for (fs::path folder = fs::weakly_canonical(path_of(places.folder), error); !folder.empty();
       folder = folder.parent_path()) {
    if (auto found = in(folder)) return found;
    if (folder == folder.parent_path()) break;
  }
  return std::nullopt;
}

Error invalid(std::string message) { return {ErrorCode::kInvalidMesh, std::move(message)}; }

/// `inner` is "name/meshes/a.stl" of package://name/meshes/a.stl. Some files have a third slash before the name.
Result<fs::path> path_in_package(std::string inner, const MeshPlaces& places, const std::string& uri) {
  if (inner.starts_with('/')) inner.erase(0, 1);
  const std::string name = inner.substr(0, inner.find('/'));
  if (name.empty() || name == "." || name == "..") {
    return invalid(fmt::format("{} names no package", medial_vk::quoted(uri)));
  }
  const std::optional<fs::path> folder = find_package(name, places);
  if (folder) return *folder / path_of(inner.size() > name.size() ? inner.substr(name.size() + 1) : "");
  std::string shown = medial_vk::quoted(name);
  shown = shown.substr(1, shown.size() - 2);
  return invalid(
      fmt::format("the package \"{0}\" is not found; name its folder with --package {0}=FOLDER or "
                  "ROS_PACKAGE_PATH",
                  shown));
}

Result<fs::path> path_of_uri(const std::string& uri, const MeshPlaces& places) {
  for (const char* scheme : {"package://", "model://"}) {
    if (uri.starts_with(scheme)) return path_in_package(uri.substr(uri.find("//") + 2), places, uri);
  }
  const bool is_file_uri = uri.starts_with("file://");
  const fs::path path = path_of(is_file_uri ? uri.substr(7) : uri);
  if (path.is_absolute()) return path;
  // A URI with a scheme has no base for a relative path.
  if (uri.find("://") != std::string::npos) {
    return invalid(fmt::format("{} is neither package:// nor file:/// nor a path", medial_vk::quoted(uri)));
  }
  return path_of(places.folder) / path;
}

}  // namespace

Result<MeshPlaces> mesh_places(const std::string& urdf, const std::vector<std::string>& packages) {
  MeshPlaces places;
  places.folder = text_of(path_of(urdf).parent_path());
  if (places.folder.empty()) places.folder = ".";
  for (const std::string& package : packages) {
    const std::size_t sign = package.find('=');
    if (sign == 0 || sign == std::string::npos || sign + 1 == package.size()) {
      return Error{ErrorCode::kUsage, fmt::format("--package: {} is not NAME=FOLDER", medial_vk::quoted(package))};
    }
    places.packages.emplace_back(package.substr(0, sign), package.substr(sign + 1));
  }
  add_paths("ROS_PACKAGE_PATH", "", places.search);
  add_paths("AMENT_PREFIX_PATH", "share", places.search);
  return places;
}

Result<std::string> find_mesh(const std::string& uri, const MeshPlaces& places) {
  if (uri.find('\0') != std::string::npos) return invalid("a file name has a zero byte");
  Result<fs::path> path = path_of_uri(uri, places);
  if (!path) return path.error();
  std::error_code ignored;
  if (fs::is_directory(path.value(), ignored)) {
    return invalid(fmt::format("the mesh {} is a folder", medial_vk::quoted(uri)));
  }
  if (!is_file(path.value())) return invalid(fmt::format("the mesh {} is not there", medial_vk::quoted(uri)));
  return text_of(path.value());
}

}  // namespace medial_vk
