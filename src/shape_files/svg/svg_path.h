// The data of <path>: all commands of SVG.
#pragma once

#include <string_view>
#include <vector>

#include "shape_files/svg/svg_curves.h"

namespace medial_vk {

/// Outlines after `matrix`, one for each part that a command M or Z begins. Throws SvgFault.
std::vector<Outline> parse_svg_path(std::string_view data, const SvgMatrix& matrix);

}  // namespace medial_vk
