// Shapes in the plane from files: SVG, GeoJSON, WKT and tables of points.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/plane_shape.h"
#include "medial_vk/result.h"

namespace medial_vk {

enum class ShapeFormat : std::uint8_t { kSvg, kGeoJson, kWkt, kCsv };

/// "SVG", "GeoJSON", "WKT" or "CSV".
std::string_view name_of_format(ShapeFormat format);

/// Whether the extension of a name is that of a format of shapes: .svg, .geojson, .json, .wkt or .csv.
bool has_shape_extension(const std::string& path);

/// Of the longest side of the curves: the flatness if none is given. It is 1/50 of the epsilon of an extraction, and
/// the polygon of a circle then turns by 2.3 degrees at its corners, far less than any threshold of the object angle.
inline constexpr double kDefaultFlatness = 1e-4;

struct ShapeFileOptions {
  /// The greatest distance between a curve of an SVG and its polygon, in units of the file.
  std::optional<double> flatness = {};
  /// For each area of the file, instead of the rule of the format or of the element.
  std::optional<FillRule> fill_rule = {};
  unsigned threads = 0;  ///< As for prepare_shape().
  std::stop_token stop = {};
};

struct ShapeFile {
  ShapeFormat format = ShapeFormat::kSvg;
  /// Their inside by `fill_rule` is the union of the areas of the file. Open lines are closed.
  std::vector<PlaneRing> rings;
  FillRule fill_rule = FillRule::kEvenOdd;
  std::uint64_t areas = 0;         ///< Elements or polygons whose union the shape is.
  std::uint64_t closed_lines = 0;  ///< Open lines that were closed by a straight segment.
  std::uint64_t curves = 0;        ///< That were flattened.
  double flatness = 0;             ///< No curve is farther from its polygon, nor the polygon from it; 0 without curves.
  /// The y axis points down, as in SVG. Coordinates are those of the file in any case, so that an SVG of the result
  /// with the same viewBox fits on it.
  bool y_is_down = false;
  /// Of an SVG: x, y, width and height of its viewBox, or of the viewport without one; nothing where it states neither.
  std::optional<std::array<double, 4>> view_box = {};
  std::vector<std::string> assumptions;  ///< Full sentences for people.
};

/// Reads SVG, GeoJSON, WKT or CSV, by the extension, or where that is none of these by the content; "-" is standard
/// input. Errors: kInvalidMesh, with the file and a line or an element; kUsage (a flatness that is not positive),
/// kOutOfMemory, kInterrupted.
Result<ShapeFile> read_shape_file(const std::string& path, const ShapeFileOptions& options = {});

/// The same of the bytes of a file; `name` is used in messages, and its extension.
Result<ShapeFile> parse_shape_file(std::string_view bytes, const std::string& name,
                                   const ShapeFileOptions& options = {});

}  // namespace medial_vk
