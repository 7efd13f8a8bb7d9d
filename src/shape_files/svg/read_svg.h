// Areas from SVG.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/result.h"
#include "shape_files/areas/shape_area.h"

namespace medial_vk {

/// Instances of elements that `use` shows, 16 for each byte of the file, and this many.
inline constexpr std::uint64_t kMostSvgInstances = 1u << 20;
/// Elements `use` within one another.
inline constexpr std::size_t kMostSvgUses = 32;
/// Elements within one another, those that `use` shows among them.
inline constexpr int kMostSvgDepth = 256;

struct SvgAreas {
  std::vector<ShapeArea> areas;  ///< One for each element that is filled.
  std::uint64_t open_outlines = 0, curves = 0;
  double flatness = 0;  ///< 0 without curves.
  std::optional<std::array<double, 4>> view_box = {};
  std::vector<std::string> assumptions;
};

/// In the user coordinates of the outermost element, flattened to `flatness`, or to `share` of the longest side of a
/// box around all curves with their control points. Errors: kInvalidMesh, with the line and the element. Throws
/// std::bad_alloc.
Result<SvgAreas> read_svg(std::string_view bytes, const std::string& name, std::optional<double> flatness,
                          double share);

}  // namespace medial_vk
