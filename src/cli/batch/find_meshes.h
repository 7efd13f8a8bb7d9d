// The meshes that `medial-vk batch` is given: in folders, in lists, and one by one.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

struct BatchMesh {
  std::string file;
  /// A relative path within any folder, different from those of all other meshes of the run. It depends on the input
  /// alone, and not on other meshes: the path in the folder, if the only input is one, else the path as it was given,
  /// or from the root of the file system if it is absolute or leads upwards.
  std::string name;
};

/// Inputs are folders, whose meshes are found at any depth and come in the order of their paths; lists, whose names end
/// in .txt or are "-" for standard input, with a path in each line, from the folder of the list; and files. What is in
/// the folder `output` is no input. A file that is given twice is one mesh. Errors: kUsage if two files have one name,
/// or a folder is in `output`; kInvalidMesh if a folder or a list is unreadable, or there is no mesh.
Result<std::vector<BatchMesh>> find_meshes(const std::vector<std::string>& inputs, const std::string& output);

}  // namespace medial_vk::cli
