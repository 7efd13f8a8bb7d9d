#include "output/extraction_report/run_record.h"

#include <algorithm>
#include <numbers>
#include <utility>

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

/// The object angle of the extraction, and the multiples of 0.2 above it.
std::vector<double> angles_of_fatness(double least) {
  std::vector<double> angles = {least};
  for (int i = 1; i / 5.0 < 0.5 * std::numbers::pi; ++i) {
    if (i / 5.0 > least + 1e-9) angles.push_back(i / 5.0);
  }
  return angles;
}

/// True if all medial points with the object angle of the extraction are known to lie in the voxels of the points that
/// are written.
bool holds_all_points(const RunRecord& record) {
  const MeshReport& mesh = record.mesh;
  return record.options.mode == Mode::kCertified && record.counters.undecided == 0 && record.simplified == 0 &&
         (!record.removal || record.removal->sheets.empty()) && mesh.closed && mesh.intersections_known &&
         mesh.intersecting_faces == 0 && mesh.sides_known && mesh.faces_within == 0 && mesh.faces_without == 0;
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

Status record_fatness(std::span<const MedialSphere> spheres, unsigned threads, RunRecord& record) {
  FatnessRecord fatness;
  Result<std::vector<Fatness>> of_angles =
      measure_fatness(spheres, record.grid, angles_of_fatness(record.options.object_angle), {.threads = threads});
  if (!of_angles) return of_angles.error();
  fatness.of_angles = std::move(of_angles).value();
  if (holds_all_points(record)) fatness.proved_radius = least_medial_radius(spheres, record.grid);
  record.fatness = std::move(fatness);
  return {};
}

}  // namespace medial_vk
