#include "robots/find_mesh.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>

#include "mesh/text_scanner.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_directory(path, error);
}

/// The parts of a path list, with `below` added to each.
void add_paths(const char* variable, const char* below, std::vector<std::string>& paths) {
  const char* value = std::getenv(variable);
  std::string_view rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find(':'));
    if (!part.empty()) paths.push_back((fs::path(part) / below).string());
    rest.remove_prefix(std::min(part.size() + 1, rest.size()));
  }
}

std::optional<fs::path> find_package(const std::string& name, const MeshPlaces& places) {
  for (const auto& [known, folder] : places.packages) {
    if (known == name) return folder;
  }
  const auto in = [&](const fs::path& folder) -> std::optional<fs::path> {
    if (is_folder(folder / name)) return folder / name;
    if (folder.filename() == name && is_folder(folder)) return folder;
    return std::nullopt;
  };
  for (const std::string& folder : places.search) {
    if (auto found = in(folder)) return found;
  }
  std::error_code error;
  for (fs::path folder = fs::weakly_canonical(places.folder, error); !folder.empty(); folder = folder.parent_path()) {
    if (auto found = in(folder)) return found;
    if (folder == folder.parent_path()) break;
  }
  return std::nullopt;
}

}  // namespace

Result<MeshPlaces> mesh_places(const std::string& urdf, const std::vector<std::string>& packages) {
  MeshPlaces places;
  places.folder = fs::path(urdf).parent_path().string();
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
  if (uri.find('\0') != std::string::npos) return Error{ErrorCode::kInvalidMesh, "a file name has a zero byte"};
  fs::path path;
  if (uri.starts_with("package://") || uri.starts_with("model://")) {
    const std::string inner = uri.substr(uri.find("//") + 2);
    const std::string name = inner.substr(0, inner.find('/'));
    if (name.empty() || name == "." || name == "..") {
      return Error{ErrorCode::kInvalidMesh, fmt::format("{} names no package", medial_vk::quoted(uri))};
    }
    const std::optional<fs::path> folder = find_package(name, places);
    if (!folder) {
      return Error{
          ErrorCode::kInvalidMesh,
          fmt::format("the package {} is found nowhere; say where it is with "
                      "--package {}=FOLDER or ROS_PACKAGE_PATH",
                      medial_vk::quoted(name), medial_vk::quoted(name).substr(1, medial_vk::quoted(name).size() - 2))};
    }
    path = *folder / (inner.size() > name.size() ? inner.substr(name.size() + 1) : "");
  } else if (uri.starts_with("file://")) {
    path = uri.substr(7);
  } else if (uri.find("://") != std::string::npos) {
    return Error{ErrorCode::kInvalidMesh,
                 fmt::format("{} is neither package:// nor file:// nor a path", medial_vk::quoted(uri))};
  } else {
    path = uri;
  }
  if (path.is_relative()) path = uri.find("://") == std::string::npos ? fs::path(places.folder) / path : path;
  if (!is_file(path)) {
    return Error{ErrorCode::kInvalidMesh, fmt::format("the mesh {} is not there", medial_vk::quoted(path.string()))};
  }
  return path.string();
}

}  // namespace medial_vk
