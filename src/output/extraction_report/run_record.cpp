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

std::uint64_t leading_components(const std::vector<double>& shares) {
  std::uint64_t count = 0;
  for (double held = 0; count < shares.size() && held < kLeadingShare; ++count) held += shares[count];
  return count;
}

}  // namespace

std::optional<Range> range_of_radii(std::span<const MedialSphere> spheres) {
  return range_of(spheres, [](const MedialSphere& sphere) { return sphere.radius; });
}

std::optional<Range> range_of_object_angles(std::span<const MedialSphere> spheres) {
  return range_of(spheres, [](const MedialSphere& sphere) { return static_cast<double>(sphere.object_angle); });
}

void record_analysis(const Analysis& analysis, RunRecord& record) {
  record.grid = analysis.grid;
  record.counters = analysis.measurements.counters;
  record.undecided = analysis.undecided;
  record.device_times = analysis.measurements.device_times;
  record.certify = analysis.certificate;
  record.simplified = analysis.simplified;
  record.points = analysis.spheres.size();
  record.radii = range_of_radii(analysis.spheres);
  record.object_angles = range_of_object_angles(analysis.spheres);
  if (analysis.sheets) record.sheets = *analysis.sheets;
  record.by_significance = analysis.by_significance;
  record.keeping_topology = analysis.keeping_topology;
  record.removal = analysis.removal;
}

UnionRecord record_union(const Significance& significance) {
  return {significance.volume, significance.area, significance.topology, leading_components(significance.of_component)};
}

}  // namespace medial_vk
