// The meshes that `medial-vk batch` is given: in folders, in lists, and one by one.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk::cli {

struct BatchMesh {
  std::string file;  ///< As it is opened.
  /// A relative path within any folder, different from those of all other meshes of the run: the path in the folder, if
  /// the only input is one, else the path as it was given, or from the root of the file system if it is absolute or
  /// leads upwards. Line breaks are \n and \r in it.
  std::string name;
  std::string real;   ///< The absolute path of the file, with links followed.
  std::string fault;  ///< Why it cannot be done; empty: nothing is known.
  std::string root;   ///< Where the name begins: the root of the file system, or of a drive; empty: in a folder.
};

/// Inputs are folders, whose meshes are found at any depth and come in the order of their paths; lists, whose names end
/// in .txt or are "-" for standard input, with a path in each line, from the folder of the list; and files. In a folder
/// these are left out: names that begin with a dot, names that end in .medial.ply, the folder `output`, and folders
/// below with a table of this command. Of two paths of one file the first counts. Errors: kUsage if two files have one
/// name, a folder is in `output`, or a line of a list is "-" or a folder; kInvalidMesh if an input does not exist, a
/// folder or a list is unreadable, or there is no mesh; kInterrupted.
Result<std::vector<BatchMesh>> find_meshes(const std::vector<std::string>& inputs, const std::string& output);

/// What a list names the mesh by, so that it has the same name as here: from the folder that was searched, or from the
/// folder of the list; absolute, if the name is the path from the root.
std::string line_of_list(const BatchMesh& mesh);

/// The absolute path of a file with links followed, as far as it exists.
std::string real_path(const std::string& path);

}  // namespace medial_vk::cli
