// The basic shapes of SVG as outlines.
#pragma once

#include <tinyxml2.h>

#include <string_view>
#include <vector>

#include "shape_files/svg/svg_curves.h"
#include "shape_files/svg/svg_element.h"

namespace medial_vk {

/// Of <path>, <rect>, <circle>, <ellipse>, <polygon> and <polyline>, by the name without a prefix; none where the
/// element has no extent. Throws SvgFault.
std::vector<Outline> outlines_of(const tinyxml2::XMLElement& element, std::string_view kind, const SvgMatrix& matrix,
                                 const SvgViewport& viewport);

/// Whether outlines_of() knows the kind.
bool is_svg_shape(std::string_view kind);

}  // namespace medial_vk
