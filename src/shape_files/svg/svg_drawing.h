// The elements of an SVG that are shown, and their outlines.
#pragma once

#include <tinyxml2.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shape_files/svg/svg_curves.h"
#include "shape_files/svg/svg_element.h"

namespace medial_vk {

/// The outlines of one element.
struct SvgFigure {
  std::vector<Outline> outlines;
  FillRule rule = FillRule::kNonZero;
  bool filled = true;
  const tinyxml2::XMLElement* element = nullptr;
};

struct SvgDrawing {
  std::vector<SvgFigure> figures;
  std::optional<std::array<double, 4>> view_box = {};
  double stretched = 1;  ///< How much wider than high user units are shown.
  // Elements that are left out, or shown otherwise than a browser does.
  std::uint64_t hidden = 0, lines = 0, texts = 0, images = 0, foreign = 0, clipped = 0, broken_links = 0;
  bool has_style_sheet = false;
};

/// A fault with the element at fault.
struct SvgElementFault {
  const tinyxml2::XMLElement* element = nullptr;
  std::string what;
};

/// Of the outermost element, of a file of so many bytes. Throws SvgElementFault.
SvgDrawing collect_figures(const tinyxml2::XMLElement& root, std::uint64_t bytes);

}  // namespace medial_vk
