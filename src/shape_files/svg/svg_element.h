// Attributes and properties of an element of SVG, its style, and lengths with units.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string>
#include <string_view>

#include "medial_vk/plane_shape.h"
#include "shape_files/svg/svg_matrix.h"

namespace medial_vk {

/// The part of the coordinate system that percentages are of; nothing where the file does not state it.
struct SvgViewport {
  std::optional<double> width = {}, height = {};
};

enum class LengthOf { kWidth, kHeight, kDiagonal };

/// What elements inherit, as far as it matters to their areas.
struct SvgStyle {
  bool visible = true;
  bool filled = true;
  FillRule rule = FillRule::kNonZero;
};

/// The value of an attribute; empty if it is missing.
std::string_view svg_attribute(const tinyxml2::XMLElement& element, const char* name);
/// The value of a property: of the attribute `style`, or else of the attribute of that name.
std::string_view svg_property(const tinyxml2::XMLElement& element, std::string_view name);
/// The bytes of all attributes: the work of reading them.
std::uint64_t bytes_of_attributes(const tinyxml2::XMLElement& element);

/// A length in user units: px, in, cm, mm, Q, pt, pc without regard to fonts, or a percentage. Throws SvgFault.
double parse_svg_length(std::string_view text, const SvgViewport& viewport, LengthOf of);
/// That of an attribute; nothing if it is missing or "auto". Throws SvgFault, with the attribute.
std::optional<double> svg_length(const tinyxml2::XMLElement& element, const char* name, const SvgViewport& viewport,
                                 LengthOf of);

/// The style of an element, whose parent has `inherited`.
SvgStyle style_of(const tinyxml2::XMLElement& element, const SvgStyle& inherited);

/// The transformation of an element, from its properties. Throws SvgFault.
SvgMatrix transform_of(const tinyxml2::XMLElement& element);

struct SvgViewBox {
  double x = 0, y = 0, width = 0, height = 0;
};

/// The viewBox of an element; nothing without one. Throws SvgFault: there are not four numbers, or a negative size.
std::optional<SvgViewBox> view_box_of(const tinyxml2::XMLElement& element);

/// From the coordinates of the box to those of a viewport of this size at the origin, by preserveAspectRatio. Both
/// sizes are positive. Throws SvgFault.
SvgMatrix fit_view_box(const tinyxml2::XMLElement& element, const SvgViewBox& box, double width, double height);

}  // namespace medial_vk
