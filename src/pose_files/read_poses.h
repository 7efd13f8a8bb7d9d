// Poses from a table: CSV with a line of names first.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/pose.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// A pose per line. The first line names the columns, in any order: x, y, z, the shift; and qx, qy, qz, qw, the
/// rotation as a quaternion, whose length is 1 to within 1 percent and is made 1, or none of these four: no rotation.
/// No number is beyond 1e18. Other columns are ignored. Blank lines are skipped. `name` is that of the file in
/// messages. Errors: kInvalidMesh, with the line.
Result<std::vector<Pose>> parse_poses(std::string_view text, const std::string& name);

/// The same of a file; "-": standard input. Errors: kInvalidMesh.
Result<std::vector<Pose>> read_poses(const std::string& path);

}  // namespace medial_vk
