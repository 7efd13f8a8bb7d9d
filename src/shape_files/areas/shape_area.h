// Areas in the plane, each with its rings and its rule, and their union.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "medial_vk/plane_shape.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// No coordinate of a shape is beyond this, so that squares are finite.
inline constexpr double kMostPlaneCoordinate = 1e150;
/// No shape has as many points or more, flattened curves included.
inline constexpr std::uint64_t kMostShapePoints = 1u << 24;

/// A polygon with holes, an element of a drawing, or all rings of a table.
struct ShapeArea {
  std::vector<PlaneRing> rings;
  FillRule rule = FillRule::kEvenOdd;
};

/// Rings whose inside by `rule` is the union of areas.
struct UnitedAreas {
  std::vector<PlaneRing> rings;
  FillRule rule = FillRule::kEvenOdd;
  std::uint64_t areas = 0;      ///< With an inside.
  std::uint64_t empty = 0;      ///< Areas that enclose nothing, left out.
  std::uint64_t crossings = 0;  ///< Points at which segments of the same area crossed, and were cut; of several areas.
};

/// One area keeps its rings and its rule. Of several, each is resolved by its own rule first, with its inside on the
/// left of every ring, so that together, by the non-zero rule, the rings enclose the union. Errors: kInvalidMesh (no
/// area encloses anything), kOutOfMemory, kInterrupted.
Result<UnitedAreas> unite_areas(std::vector<ShapeArea> areas, unsigned threads, const std::stop_token& stop);

/// Adds "1 line is ..." or "2 lines are ...", of any words, unless the count is 0.
void add_sentence(std::vector<std::string>& sentences, std::uint64_t count, const char* one, const char* many);

}  // namespace medial_vk
