#include "check_reports/check_agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>

namespace medial_vk {
namespace {

using Voxels = std::set<std::array<std::uint32_t, 3>>;

/// Rounding changes object angles, in radians, and positions, as a fraction of the voxel's side, by far less.
constexpr double kClearAngle = 0.05, kClearDepth = 0.05;

Voxels voxels_of(const Extraction& extraction) {
  Voxels voxels;
  for (const MedialSphere& sphere : extraction.spheres) voxels.insert(sphere.voxel);
  return voxels;
}

/// Distance from a point to the faces of its voxel, as a fraction of the voxel's side.
double depth_in_voxel(const VoxelGrid& grid, const Point& p) {
  double depth = 0.5;
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = (p[k] - grid.origin[k]) / grid.voxel_size;
    const double part = at - std::floor(at);
    depth = std::min({depth, part, 1 - part});
  }
  return depth;
}

/// Whether the points of `here` that are firm have a counterpart in `there`.
CheckLine check_voxels(std::string condition, const Extraction& here, const Extraction& there,
                       std::uint64_t undecided_there, const ExtractionOptions& options) {
  const Voxels found = voxels_of(there);
  CheckLine line;
  line.condition = std::move(condition);
  std::uint64_t firm = 0, clear = 0;
  for (const MedialSphere& sphere : here.spheres) {
    if (static_cast<double>(sphere.object_angle) < options.object_angle + kClearAngle) continue;
    const double depth = depth_in_voxel(here.grid, sphere.centre);
    if (depth <= options.epsilon) continue;
    ++line.tested;
    if (found.contains(sphere.voxel)) continue;
    ++firm;
    if (depth >= kClearDepth) ++clear;
    if (line.first_failure.empty()) {
      line.first_failure = "voxel (" + std::to_string(sphere.voxel[0]) + ", " + std::to_string(sphere.voxel[1]) + ", " +
                           std::to_string(sphere.voxel[2]) + ") has no point";
    }
  }
  const std::uint64_t explained = 1 + here.spheres.size() / 200;
  if (firm > undecided_there || clear > explained) line.failed = firm;
  line.worst = static_cast<double>(firm);
  line.unit = "voxels";
  if (line.failed == 0) line.first_failure.clear();
  return line;
}

CheckLine check_grids(const VoxelGrid& a, const VoxelGrid& b) {
  CheckLine line;
  line.condition = "grid is that of the reference";
  line.tested = 1;
  line.worst = std::abs(a.voxel_size - b.voxel_size);
  line.failed = a.size == b.size && line.worst <= 1e-9 * b.voxel_size ? 0 : 1;
  line.unit = "length";
  if (line.failed > 0) line.first_failure = "the grids differ";
  return line;
}

/// Only rounding makes double precision reject a ball of the device.
CheckLine check_rejections(const CertificateReport& certificate) {
  CheckLine line;
  line.condition = "double precision accepts the balls of the device";
  line.tested = certificate.passed + certificate.rejected;
  line.worst = static_cast<double>(certificate.rejected);
  line.unit = "rejected";
  if (certificate.rejected > line.tested / 100) line.failed = certificate.rejected;
  return line;
}

}  // namespace

CheckReport check_agreement(const CertifiedExtraction& device, const Extraction& reference,
                            const ExtractionOptions& options) {
  const auto undecided = [](const Extraction& extraction) { return extraction.measurements.counters.undecided; };
  CheckReport report;
  report.lines.push_back(check_grids(device.extraction.grid, reference.grid));
  report.lines.push_back(check_rejections(device.certificate));
  report.lines.push_back(check_voxels("voxels with a point of the reference have one of the device", reference,
                                      device.extraction, undecided(device.extraction), options));
  report.lines.push_back(check_voxels("voxels with a point of the device have one of the reference", device.extraction,
                                      reference, undecided(reference), options));
  return report;
}

}  // namespace medial_vk
