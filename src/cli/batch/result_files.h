// The files of a mesh in its line of the table, and on the disk.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/options/options.h"

namespace medial_vk::cli {

/// What the names of the files of a mesh have behind its name, with blanks between: ".medial.ply .report.json".
/// `options` are those of the mesh, whose files begin with `stem`.
std::string endings_of(const Options& options, std::string_view stem);

/// Those of both, each once.
std::string endings_of_both(const std::string& first, const std::string& second);

/// The paths of these files. Words that this program does not write as endings, which a table may hold that was edited,
/// are left out: no path leads elsewhere.
std::vector<std::string> paths_of_results(const std::string& stem, std::string_view endings);

/// Removes them as far as they are there, and are no folders.
void remove_results(const std::string& stem, std::string_view endings);

}  // namespace medial_vk::cli
