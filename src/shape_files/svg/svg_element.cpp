#if defined(MEDIAL_VK_HAS_XML)  // else nothing of tinyxml2 may be needed to build
#include "shape_files/svg/svg_element.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/quoted.h"
#include "shape_files/svg/svg_scanner.h"

namespace medial_vk {
namespace {

/// CSS pixels, 96 to the inch.
constexpr std::array<std::pair<std::string_view, double>, 8> kUnits = {{{"", 1.0},
                                                                        {"px", 1.0},
                                                                        {"in", 96.0},
                                                                        {"cm", 96 / 2.54},
                                                                        {"mm", 96 / 25.4},
                                                                        {"Q", 96 / 101.6},
                                                                        {"pt", 96 / 72.0},
                                                                        {"pc", 16.0}}};

double size_of(const SvgViewport& viewport, LengthOf of) {
  const std::optional<double>& given = of == LengthOf::kHeight ? viewport.height : viewport.width;
  if (!given || (of == LengthOf::kDiagonal && !viewport.height)) {
    throw SvgFault{"a percentage of a size that the file does not state"};
  }
  return of == LengthOf::kDiagonal ? std::hypot(*viewport.width, *viewport.height) / std::sqrt(2.0) : *given;
}

/// The value of a declaration "name: value", without "!important".
std::string_view value_of(std::string_view declaration, std::string_view name) {
  const std::size_t colon = declaration.find(':');
  if (colon == std::string_view::npos || without_svg_blanks(declaration.substr(0, colon)) != name) return {};
  const std::string_view value = declaration.substr(colon + 1);
  return without_svg_blanks(value.substr(0, value.find('!')));
}

/// The share of the space that is left over before the box, from "xMid", "YMax" and the like.
double share_before(std::string_view word) {
  if (word == "Min") return 0;
  if (word == "Mid") return 0.5;
  if (word == "Max") return 1;
  throw SvgFault{"preserveAspectRatio: the alignment is unknown"};
}

std::string_view next_word(std::string_view& rest) {
  rest = without_svg_blanks(rest);
  std::size_t length = 0;
  while (length < rest.size() && !is_svg_blank(rest[length])) ++length;
  const std::string_view word = rest.substr(0, length);
  rest.remove_prefix(length);
  return word;
}

}  // namespace

std::string_view svg_attribute(const tinyxml2::XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

std::string_view svg_property(const tinyxml2::XMLElement& element, std::string_view name) {
  std::string_view found;
  for (std::string_view style = svg_attribute(element, "style"); !style.empty();) {
    const std::size_t end = std::min(style.find(';'), style.size());
    if (const std::string_view value = value_of(style.substr(0, end), name); !value.empty()) found = value;
    style.remove_prefix(std::min(end + 1, style.size()));
  }
  return found.empty() ? without_svg_blanks(svg_attribute(element, std::string(name).c_str())) : found;
}

std::uint64_t bytes_of_attributes(const tinyxml2::XMLElement& element) {
  std::uint64_t bytes = 0;
  for (const tinyxml2::XMLAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    bytes += std::string_view(a->Name()).size() + std::string_view(a->Value()).size();
  }
  return bytes;
}

double parse_svg_length(std::string_view text, const SvgViewport& viewport, LengthOf of) {
  SvgScanner scanner(text);
  const double value = scanner.number_before_unit();
  const std::string_view unit = scanner.letters();
  scanner.skip_blanks();
  if (!scanner.at_end()) throw SvgFault{fmt::format("{} is more than one length", quoted(text))};
  if (unit == "%") return value / 100 * size_of(viewport, of);
  const auto known = std::ranges::find_if(kUnits, [&](const auto& entry) { return entry.first == unit; });
  if (known != kUnits.end()) return value * known->second;
  throw SvgFault{fmt::format("the unit of {} is not supported; px, in, cm, mm, Q, pt, pc and % are", quoted(text))};
}

std::optional<double> svg_length(const tinyxml2::XMLElement& element, const char* name, const SvgViewport& viewport,
                                 LengthOf of) {
  const std::string_view text = svg_property(element, name);
  if (text.empty() || text == "auto") return {};
  try {
    return parse_svg_length(text, viewport, of);
  } catch (const SvgFault& fault) {
    throw SvgFault{fmt::format("{}: {}", name, fault.what)};
  }
}

SvgStyle style_of(const tinyxml2::XMLElement& element, const SvgStyle& inherited) {
  SvgStyle style = inherited;
  const std::string_view fill = svg_property(element, "fill");
  if (!fill.empty() && fill != "inherit") style.filled = fill != "none" && fill != "transparent";
  const std::string_view rule = svg_property(element, "fill-rule");
  if (rule == "evenodd") style.rule = FillRule::kEvenOdd;
  if (rule == "nonzero") style.rule = FillRule::kNonZero;
  const std::string_view visibility = svg_property(element, "visibility");
  if (visibility == "visible") style.visible = true;
  if (visibility == "hidden" || visibility == "collapse") style.visible = false;
  return style;
}

SvgMatrix transform_of(const tinyxml2::XMLElement& element) {
  const std::string_view text = svg_property(element, "transform");
  if (text.empty()) return {};
  try {
    return parse_svg_transform(text);
  } catch (const SvgFault& fault) {
    throw SvgFault{"transform: " + fault.what};
  }
}

std::optional<SvgViewBox> view_box_of(const tinyxml2::XMLElement& element) {
  const std::string_view text = without_svg_blanks(svg_attribute(element, "viewBox"));
  if (text.empty() || text == "none") return {};
  std::vector<double> numbers;
  try {
    numbers = svg_numbers(text);
  } catch (const SvgFault& fault) {
    throw SvgFault{"viewBox: " + fault.what};
  }
  if (numbers.size() != 4) throw SvgFault{fmt::format("viewBox: there are {} numbers instead of 4", numbers.size())};
  if (numbers[2] < 0 || numbers[3] < 0) throw SvgFault{"viewBox: its size is negative"};
  return SvgViewBox{numbers[0], numbers[1], numbers[2], numbers[3]};
}

SvgMatrix fit_view_box(const tinyxml2::XMLElement& element, const SvgViewBox& box, double width, double height) {
  double x = width / box.width, y = height / box.height;
  std::string_view rest = svg_attribute(element, "preserveAspectRatio");
  std::string_view align = next_word(rest);
  if (align == "defer") align = next_word(rest);
  if (align.empty()) align = "xMidYMid";
  double before_x = 0, before_y = 0;
  if (align != "none") {
    if (align.size() != 8 || align[0] != 'x' || align[4] != 'Y') {
      throw SvgFault{fmt::format("preserveAspectRatio: {} is unknown", quoted(align))};
    }
    before_x = share_before(align.substr(1, 3));
    before_y = share_before(align.substr(5, 3));
    x = y = next_word(rest) == "slice" ? std::max(x, y) : std::min(x, y);
  }
  return {x, 0, 0, y, before_x * (width - box.width * x) - box.x * x, before_y * (height - box.height * y) - box.y * y};
}

}  // namespace medial_vk
#endif
