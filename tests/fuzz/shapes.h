// What the targets of the readers of shapes share.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/require.h"
#include "shape_files/areas/shape_area.h"
#include "shape_files/read_shape_file.h"

namespace medial_vk::fuzz {

inline std::uint64_t require_rings(std::span<const PlaneRing> rings) {
  std::uint64_t points = 0;
  for (const PlaneRing& ring : rings) {
    points += ring.size();
    for (const PlanePoint& p : ring) {
      require(std::fabs(p[0]) <= kMostPlaneCoordinate && std::fabs(p[1]) <= kMostPlaneCoordinate,
              "coordinates are finite and bounded");
    }
  }
  return points;
}

inline void require_sentences(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) {
    require(sentence.size() <= 200 && sentence.ends_with('.'), "assumptions are sentences");
  }
}

/// A message of one line that begins with the name.
inline void require_message(const Error& error, const std::string& name) {
  require_clear(error, ErrorCode::kInvalidMesh);
  require(error.message.starts_with(name + ":"), "a message begins with the name of the file");
}

/// A shape, or a clear message that begins with the name.
inline void require_shape(std::string_view text, const std::string& name) {
  const Result<ShapeFile> shape = parse_shape_file(text, name);
  if (!shape.ok()) return require_message(shape.error(), name);
  const ShapeFile& file = shape.value();
  require(file.areas > 0 && require_rings(file.rings) >= 3, "a shape has areas and points");
  require((file.flatness > 0) == (file.curves > 0), "curves have a flatness");
  require_sentences(file.assumptions);
}

}  // namespace medial_vk::fuzz
