// Resolves the meshes of a robot: package://, file:// and relative paths.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

/// The locations to search.
struct MeshPlaces {
  std::string folder;  ///< Of the URDF: the base of relative paths; packages may lie around it.
  std::vector<std::pair<std::string, std::string>> packages;  ///< Name and folder, as given by the user.
  std::vector<std::string> search;                            ///< Folders of packages, or packages themselves.
};

/// The folder of `urdf`, the folders in ROS_PACKAGE_PATH and AMENT_PREFIX_PATH, and the packages given as
/// "name=folder". Error: kUsage for one without a name or a folder.
Result<MeshPlaces> mesh_places(const std::string& urdf, const std::vector<std::string>& packages);

/// The path of a file that exists. A package is searched among those given, then along `search`, then among the folders
/// above the URDF and beside those. Error: kInvalidMesh, with the file or package and a remedy.
Result<std::string> find_mesh(const std::string& uri, const MeshPlaces& places);

}  // namespace medial_vk
