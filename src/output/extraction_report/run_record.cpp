#include "output/extraction_report/run_record.h"

#include <algorithm>

namespace medial_vk {
namespace {

template <class Value>
std::optional<Range> range_of(std::span<const MedialSphere> spheres, const Value& value) {
  if (spheres.empty()) return std::nullopt;
  Range range = {value(spheres[0]), value(spheres[0])};
  for (const MedialSphere& sphere : spheres) {
    range.least = std::min(range.least, value(sphere));
    range.greatest = std::max(range.greatest, value(sphere));
  }
  return range;
}

}  // namespace

std::optional<Range> range_of_radii(std::span<const MedialSphere> spheres) {
  return range_of(spheres, [](const MedialSphere& sphere) { return sphere.radius; });
}

std::optional<Range> range_of_object_angles(std::span<const MedialSphere> spheres) {
  return range_of(spheres, [](const MedialSphere& sphere) { return static_cast<double>(sphere.object_angle); });
}

}  // namespace medial_vk
