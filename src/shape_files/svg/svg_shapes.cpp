#if defined(MEDIAL_VK_HAS_XML)  // else nothing of tinyxml2 may be needed to build
#include "shape_files/svg/svg_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "shape_files/svg/svg_path.h"
#include "shape_files/svg/svg_scanner.h"

namespace medial_vk {
namespace {

using tinyxml2::XMLElement;

constexpr std::array<std::string_view, 6> kShapes = {"path", "rect", "circle", "ellipse", "polygon", "polyline"};

double length_or_zero(const XMLElement& element, const char* name, const SvgViewport& viewport, LengthOf of) {
  return svg_length(element, name, viewport, of).value_or(0);
}

std::optional<double> checked_size(const XMLElement& element, const char* name, const SvgViewport& viewport,
                                   LengthOf of) {
  const std::optional<double> size = svg_length(element, name, viewport, of);
  if (size && *size < 0) throw SvgFault{fmt::format("{} is negative", name)};
  return size;
}

void add_line(Outline& outline, const SvgMatrix& matrix, const PlanePoint& end) {
  PlaneCurve curve;
  curve.end = matrix * end;
  outline.curves.push_back(curve);
}

std::vector<Outline> rectangle(const XMLElement& element, const SvgMatrix& matrix, const SvgViewport& viewport) {
  const double x = length_or_zero(element, "x", viewport, LengthOf::kWidth);
  const double y = length_or_zero(element, "y", viewport, LengthOf::kHeight);
  const double width = checked_size(element, "width", viewport, LengthOf::kWidth).value_or(0);
  const double height = checked_size(element, "height", viewport, LengthOf::kHeight).value_or(0);
  if (width == 0 || height == 0) return {};
  const std::optional<double> given_x = checked_size(element, "rx", viewport, LengthOf::kWidth);
  const std::optional<double> given_y = checked_size(element, "ry", viewport, LengthOf::kHeight);
  double rx = given_x.value_or(given_y.value_or(0)), ry = given_y.value_or(rx);
  rx = std::min(rx, width / 2);
  ry = std::min(ry, height / 2);
  if (rx == 0 || ry == 0) rx = ry = 0;
  // Each side in turn, and the quarter ellipse after it.
  const std::array<std::array<PlanePoint, 2>, 4> sides = {{{{{x + rx, y}, {x + width - rx, y}}},
                                                           {{{x + width, y + ry}, {x + width, y + height - ry}}},
                                                           {{{x + width - rx, y + height}, {x + rx, y + height}}},
                                                           {{{x, y + height - ry}, {x, y + ry}}}}};
  Outline outline;
  outline.start = matrix * sides[0][0];
  outline.closed = true;
  for (std::size_t k = 0; k < 4; ++k) {
    add_line(outline, matrix, sides[k][1]);
    if (rx > 0) add_arc(outline, matrix, sides[k][1], sides[(k + 1) % 4][0], rx, ry, 0, false, true);
  }
  return {outline};
}

std::vector<Outline> circle_or_ellipse(const XMLElement& element, std::string_view kind, const SvgMatrix& matrix,
                                       const SvgViewport& viewport) {
  const PlanePoint centre = {length_or_zero(element, "cx", viewport, LengthOf::kWidth),
                             length_or_zero(element, "cy", viewport, LengthOf::kHeight)};
  double rx = 0, ry = 0;
  if (kind == "circle") {
    rx = ry = checked_size(element, "r", viewport, LengthOf::kDiagonal).value_or(0);
  } else {
    const std::optional<double> given_x = checked_size(element, "rx", viewport, LengthOf::kWidth);
    const std::optional<double> given_y = checked_size(element, "ry", viewport, LengthOf::kHeight);
    rx = given_x.value_or(given_y.value_or(0));
    ry = given_y.value_or(rx);
  }
  if (rx == 0 || ry == 0) return {};
  return {ellipse_outline(matrix, centre, rx, ry)};
}

std::vector<Outline> polygon(const XMLElement& element, std::string_view kind, const SvgMatrix& matrix) {
  const std::vector<double> numbers = svg_numbers(svg_attribute(element, "points"));
  if (numbers.size() % 2 != 0)
    throw SvgFault{fmt::format("points: the number of coordinates, {}, is odd", numbers.size())};
  if (numbers.empty()) return {};
  Outline outline;
  outline.start = matrix * PlanePoint{numbers[0], numbers[1]};
  outline.curves.reserve(numbers.size() / 2);
  for (std::size_t i = 2; i < numbers.size(); i += 2) add_line(outline, matrix, {numbers[i], numbers[i + 1]});
  outline.closed = kind == "polygon";
  return {outline};
}

}  // namespace

bool is_svg_shape(std::string_view kind) { return std::ranges::find(kShapes, kind) != kShapes.end(); }

std::vector<Outline> outlines_of(const XMLElement& element, std::string_view kind, const SvgMatrix& matrix,
                                 const SvgViewport& viewport) {
  if (kind == "rect") return rectangle(element, matrix, viewport);
  if (kind == "circle" || kind == "ellipse") return circle_or_ellipse(element, kind, matrix, viewport);
  if (kind == "polygon" || kind == "polyline") return polygon(element, kind, matrix);
  std::string_view data = svg_attribute(element, "d");
  try {
    return parse_svg_path(data, matrix);
  } catch (const SvgFault& fault) {
    throw SvgFault{"d: " + fault.what};
  }
}

}  // namespace medial_vk
#endif
