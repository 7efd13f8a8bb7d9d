// Patterns that stand for a sequence of files.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

/// True if the last part of the path has one of the forms of files_of_pattern(), and no file has just this name.
bool is_frame_pattern(const std::string& path);

/// The files that a pattern stands for. Its last part, the name of the file, has one of three forms:
/// - walk_%04d.obj: a number with leading zeros, of at least 4 digits; %d: without leading zeros. %% is a percent sign.
/// - walk_####.obj: the same as %04d, a digit for each #.
/// - walk_*.obj, walk_0[1-9].obj: any characters for *, one for ?, and one of those in brackets, as in a shell.
/// Files of the first two are in the order of their numbers, from the least to the greatest that exists, and none
/// between may be missing; those of the third in natural order, where 9 comes before 10, whatever is missing. Errors:
/// kInvalidMesh (no file; names the first missing one; a folder that cannot be read), kUsage (no pattern: two numbers,
/// another directive, wildcards in the name of a folder; too many files).
Result<std::vector<std::string>> files_of_pattern(const std::string& pattern);

/// The order of names in which digits count as numbers: less than 0 if a comes first. 0 for equal names only.
int compare_naturally(std::string_view a, std::string_view b);

}  // namespace medial_vk
