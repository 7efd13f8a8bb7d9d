// Positions of joints from a table: CSV with a line of names first.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

/// A configuration per line, in radians and metres. The first line names the columns, in any order: each of `joints`,
/// whose names are not empty and differ. Other columns are ignored, and blank lines are skipped. No number is beyond
/// 1e18. The result has the positions of the joints in their order, configuration after configuration. `name` is that
/// of the file in messages. Errors: kInvalidMesh with the line (two columns for a joint; none: a position that is left
/// out is more likely a mistake than a zero), and with the name of the column.
Result<std::vector<std::vector<double>>> parse_joint_values(std::string_view text, const std::string& name,
                                                            std::span<const std::string> joints);

/// The same of a file; "-": standard input. Errors: kInvalidMesh.
Result<std::vector<std::vector<double>>> read_joint_values(const std::string& path,
                                                           std::span<const std::string> joints);

}  // namespace medial_vk
