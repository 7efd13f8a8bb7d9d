// One reader for each text format of shapes, from bytes in memory. All return kInvalidMesh with the file and a line or
// an element, and throw std::bad_alloc.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "medial_vk/result.h"
#include "shape_files/areas/shape_area.h"

namespace medial_vk {

/// Polygons, lines and points as GeoJSON and WKT have them.
class GeometrySet {
 public:
  /// The outline and its holes. Rings that are not closed are.
  void add_polygon(std::vector<PlaneRing> rings);
  /// A line; it is closed by a straight segment if it is not. All lines are one area by the even-odd rule, so that
  /// lines within a line are holes.
  void add_line(PlaneRing line);
  void add_points() { ++points_; }

  /// The areas; nothing is added afterwards.
  std::vector<ShapeArea> take_areas();
  std::uint64_t closed_lines() const { return closed_; }
  std::vector<std::string> assumptions() const;

 private:
  std::vector<ShapeArea> polygons_;
  ShapeArea lines_;
  std::uint64_t closed_ = 0, short_lines_ = 0, points_ = 0, lines_count_ = 0;
};

struct AreasOfFile {
  std::vector<ShapeArea> areas;
  std::uint64_t closed_lines = 0;
  std::vector<std::string> assumptions;
};

/// GeometryCollections within one another, in GeoJSON and in WKT.
inline constexpr int kMostNestedCollections = 64;

Result<AreasOfFile> read_geojson(std::string_view bytes, const std::string& name);
Result<AreasOfFile> read_wkt(std::string_view bytes, const std::string& name);
/// Columns x, y and, if there is one, ring.
Result<AreasOfFile> read_ring_table(std::string_view bytes, const std::string& name);

/// Whether the text begins with a word of WKT.
bool looks_like_wkt(std::string_view text);

}  // namespace medial_vk
