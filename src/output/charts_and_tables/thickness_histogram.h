// The distribution of a solid's thickness over its boundary, as a drawing and as a table.
#pragma once

#include <string>

#include "boundary_fields/summaries.h"

namespace medial_vk {

/// Bars by the lower ends of the intervals and steps by the upper ends, as shares of the area: where both agree, the
/// thickness is known to the width of a bar.
std::string encode_thickness_svg(const ThicknessRecord& record);
/// `lower,upper,share_by_lower_ends,share_by_upper_ends`, one row for each bar.
std::string encode_thickness_csv(const ThicknessRecord& record);

}  // namespace medial_vk
