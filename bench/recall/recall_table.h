// The rows of a recall measurement as CSV, for programs, and as markdown tables, for docs/accuracy.md.
#pragma once

#include <string>
#include <vector>

#include "recall_count.h"

namespace medial_vk::bench {

/// One line for each row, radius class and range of object angles.
std::string to_csv(const std::vector<RecallRow>& rows);

/// For each mode: the missed samples, by radius and by object angle; for certified mode also the undecided ones.
std::string to_markdown(const std::vector<RecallRow>& rows, const std::vector<double>& angles);

const char* name_of(Mode mode);

}  // namespace medial_vk::bench
