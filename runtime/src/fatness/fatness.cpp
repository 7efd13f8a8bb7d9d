#include "medial_vk/fatness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/host_memory.h"
#include "base/point_ops.h"
#include "sheets/voxel_graph.h"

namespace medial_vk {
namespace {

constexpr double kUnit = 0x1p-53;

/// The components of the graph's points that `is_in` names.
template <class IsIn>
std::uint64_t components_of(const VoxelGraph& graph, const IsIn& is_in) {
  std::uint64_t components = 0;
  std::vector<bool> is_seen(graph.size(), false);
  std::vector<std::uint32_t> open;
  for (std::uint32_t first = 0; first < graph.size(); ++first) {
    if (is_seen[first] || !is_in(graph.sphere(first))) continue;
    ++components;
    is_seen[first] = true;
    open.assign(1, first);
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      for (const std::uint32_t next : graph.neighbours(at)) {
        if (is_seen[next] || !is_in(graph.sphere(next))) continue;
        is_seen[next] = true;
        open.push_back(next);
      }
    }
  }
  return components;
}

Fatness fatness_at(const VoxelGraph& graph, double object_angle, double voxel) {
  const auto is_in = [&](const MedialSphere& sphere) {
    return static_cast<double>(sphere.object_angle) >= object_angle;
  };
  Fatness fatness;
  fatness.object_angle = object_angle;
  fatness.least_radius = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    if (!is_in(graph.sphere(i))) continue;
    ++fatness.spheres;
    fatness.least_radius = std::min(fatness.least_radius, graph.sphere(i).radius);
  }
  if (fatness.spheres == 0) fatness.least_radius = 0;
  fatness.largest_voxel = fatness.least_radius * std::numbers::inv_sqrt3;
  fatness.components = components_of(graph, is_in);
  // Centres in voxels with a common corner are at most 2 sqrt(3) voxel sides apart, and the spheres touch if both radii
  // are at least half of that. The margin is for the rounding of this comparison.
  fatness.proves_connected = fatness.components == 1 && fatness.largest_voxel >= voxel * (1 + 0x1p-30);
  return fatness;
}

}  // namespace

Result<std::vector<Fatness>> measure_fatness(std::span<const MedialSphere> spheres, const VoxelGrid& grid,
                                             std::span<const double> object_angles, const FatnessOptions& options) {
  if (!std::ranges::all_of(object_angles, [](double angle) { return std::isfinite(angle); })) {
    return Error{ErrorCode::kUsage, "`object_angles` must be numbers"};
  }
  return catch_out_of_memory("measuring how fat a solid is", [&]() -> Result<std::vector<Fatness>> {
    const VoxelGraph graph(spheres, options.threads);
    std::vector<Fatness> all;
    // A centre may lie outside its voxel by the roundings of the voxel's corners, whose indices are below 2^20.
    const auto& o = grid.origin;
    const double rounding = 0x1p-49 * (std::fabs(o[0]) + std::fabs(o[1]) + std::fabs(o[2]));
    const double voxel = grid.voxel_size * (1 + 0x1p-28) + rounding;
    for (const double angle : object_angles) all.push_back(fatness_at(graph, angle, voxel));
    return all;
  });
}

double least_medial_radius(std::span<const MedialSphere> spheres, const VoxelGrid& grid) {
  double least = std::numeric_limits<double>::infinity();
  for (const MedialSphere& sphere : spheres) {
    // The distance from the boundary changes by no more than that of two points: here from the centre to the farthest
    // corner of the voxel.
    Point farthest;
    for (std::size_t k = 0; k < 3; ++k) {
      const double from = grid.origin[k] + sphere.voxel[k] * grid.voxel_size, to = from + grid.voxel_size;
      const double error = 8 * kUnit * (std::fabs(grid.origin[k]) + std::fabs(to));
      farthest[k] = std::max(sphere.centre[k] - from, to - sphere.centre[k]) + error;
    }
    least = std::min(least, sphere.radius - length(farthest) * (1 + 8 * kUnit));
  }
  return std::isfinite(least) ? std::max(0.0, least * (1 - 8 * kUnit)) : 0;
}

}  // namespace medial_vk
