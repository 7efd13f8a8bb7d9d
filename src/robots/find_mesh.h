// Where the meshes of a robot lie: package://, file:// and relative paths.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

/// Where to look.
struct MeshPlaces {
  std::string folder;  ///< Of the URDF: relative paths start there, and packages may lie around it.
  std::vector<std::pair<std::string, std::string>> packages;  ///< Name and folder, as told.
  std::vector<std::string> search;                            ///< Folders that hold packages, or are one.
};

/// The folder of `urdf`, what ROS_PACKAGE_PATH and AMENT_PREFIX_PATH say, and the packages that were told:
/// "name=folder". Error: kUsage for what has no name or no folder.
Result<MeshPlaces> mesh_places(const std::string& urdf, const std::vector<std::string>& packages);

/// The path of a file that exists. A package is looked for among those told, then along `search`, then among the
/// folders above the URDF and beside those. Error: kInvalidMesh, naming the file or package and what to do.
Result<std::string> find_mesh(const std::string& uri, const MeshPlaces& places);

}  // namespace medial_vk
