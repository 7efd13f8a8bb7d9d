#include "medial_vk/sheets.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>
#include <numeric>

#include "base/host_memory.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "sheets/absorb_components.h"
#include "sheets/check_sheet_options.h"
#include "sheets/grow_components.h"
#include "sheets/join_components.h"
#include "sheets/rim.h"
#include "sheets/tangent_frame.h"
#include "sheets/voxel_graph.h"
#include "sheets/voxel_section.h"

namespace medial_vk {
namespace {

/// Numbers of sheets for components with any numbers: by decreasing number of points, of equals by first voxels.
std::vector<std::int32_t> number_sheets(const std::vector<std::uint32_t>& component_of, std::size_t& sheets) {
  std::vector<std::uint64_t> points(component_of.size(), 0);
  std::vector<std::uint32_t> components;  // in the order of their first voxels
  for (const std::uint32_t component : component_of) {
    if (points[component]++ == 0) components.push_back(component);
  }
  std::stable_sort(components.begin(), components.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return points[a] > points[b]; });
  std::vector<std::int32_t> number(component_of.size(), -1);
  for (std::size_t i = 0; i < components.size(); ++i) number[components[i]] = static_cast<std::int32_t>(i);
  std::vector<std::int32_t> sheet_of(component_of.size());
  for (std::size_t position = 0; position < component_of.size(); ++position)
    sheet_of[position] = number[component_of[position]];
  sheets = components.size();
  return sheet_of;
}

/// In voxels squared: the area of the sheet in the voxel of a point, where the plane through the point perpendicular to
/// its normal approximates the sheet. The plane is known to within epsilon along its normal, and the area is the mean
/// for the two extreme positions. So where a sheet lies in a wall between two voxels and both have a point of it, each
/// receives half of the area.
double area_in_voxel(const MedialSphere& sphere, const VoxelGrid& grid, double epsilon) {
  const Point normal = sheet_normal(sphere);
  const double norm = length(normal);
  if (!(norm > 0)) return 0;
  Point position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    position[axis] = (sphere.centre[axis] - grid.origin[axis]) / grid.voxel_size - sphere.voxel[axis];
  }
  const Point aside = epsilon / norm * normal;
  return 0.5 * (section_area(position + aside, normal) + section_area(position - aside, normal));
}

std::uint8_t marks_of(const VoxelGraph& graph, const std::vector<std::int32_t>& sheet_of, std::uint32_t position) {
  const auto neighbours = graph.neighbours(position);
  const bool seam =
      std::ranges::any_of(neighbours, [&](std::uint32_t other) { return sheet_of[other] != sheet_of[position]; });
  return static_cast<std::uint8_t>((seam ? kSeam : 0) | (is_rim(graph, position) ? kRim : 0));
}

/// Sums in voxel order, so that they do not depend on the order of the points.
void describe(const VoxelGraph& graph, const std::vector<std::int32_t>& sheet_of, std::size_t count, unsigned threads,
              Sheets& out) {
  std::vector<std::uint8_t> marks(graph.size());
  parallel_for(graph.size(), 1024, threads, [&](std::size_t i) {
    const auto position = static_cast<std::uint32_t>(i);
    marks[i] = marks_of(graph, sheet_of, position);
  });
  out.sheets.resize(count);
  out.of_point.resize(graph.size());
  out.marks.resize(graph.size());
  for (std::uint32_t position = 0; position < graph.size(); ++position) {
    Sheet& sheet = out.sheets[static_cast<std::size_t>(sheet_of[position])];
    ++sheet.points;
    sheet.mean_radius += graph.sphere(position).radius;
    sheet.mean_object_angle += double{graph.sphere(position).object_angle};
    out.of_point[graph.index(position)] = sheet_of[position];
    out.marks[graph.index(position)] = marks[position];
    if (marks[position] & kSeam) ++out.seam_points;
    if (marks[position] & kRim) ++out.rim_points;
  }
  for (Sheet& sheet : out.sheets) {
    sheet.mean_radius /= static_cast<double>(sheet.points);
    sheet.mean_object_angle /= static_cast<double>(sheet.points);
    if (sheet.points >= kFragmentPoints) continue;
    ++out.fragments;
    out.fragment_points += sheet.points;
  }
}

/// Sums in voxel order, too. Precondition: describe() has run.
void measure_areas(const VoxelGraph& graph, const VoxelGrid& grid, double epsilon,
                   const std::vector<std::int32_t>& sheet_of, unsigned threads, Sheets& out) {
  const double voxel_area = grid.voxel_size * grid.voxel_size;
  out.areas.resize(graph.size());
  parallel_for(graph.size(), 1024, threads, [&](std::size_t i) {
    const auto position = static_cast<std::uint32_t>(i);
    const std::uint32_t point = graph.index(position);
    const double share = out.marks[point] & kRim ? 0.5 : 1;
    out.areas[point] = share * voxel_area * area_in_voxel(graph.sphere(position), grid, epsilon);
  });
  for (std::uint32_t position = 0; position < graph.size(); ++position)
    out.sheets[static_cast<std::size_t>(sheet_of[position])].area += out.areas[graph.index(position)];
}

}  // namespace

Result<Sheets> find_sheets(std::span<const MedialSphere> spheres, const VoxelGrid& grid,
                           const ExtractionOptions& extraction, const SheetOptions& options) try {
  if (Status status = check_sheet_options(options); !status) return status.error();
  const VoxelGraph graph(spheres, options.threads);
  std::vector<std::uint32_t> component_of = grow_components(graph, extraction.object_angle, options);
  join_components(graph, options, component_of);
  Sheets out;
  for (const std::uint32_t component : component_of)
    out.components = std::max(out.components, std::uint64_t{component} + 1);
  const Absorbed absorbed = absorb_components(graph, grid.voxel_size, options, component_of);
  out.absorbed_components = absorbed.components;
  out.absorbed_points = absorbed.points;
  std::size_t count = 0;
  const std::vector<std::int32_t> sheet_of = number_sheets(component_of, count);
  describe(graph, sheet_of, count, options.threads, out);
  for (std::uint32_t position = 0; position < graph.size(); ++position) {
    if (absorbed.is_small[position]) out.marks[graph.index(position)] |= kSmall;
  }
  if (options.areas) measure_areas(graph, grid, extraction.epsilon, sheet_of, options.threads, out);
  return out;
} catch (const std::bad_alloc&) {
  return out_of_memory("finding sheets", "try a lower `resolution`");
}

}  // namespace medial_vk
