#include "medial_vk/sheets.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "sheets/absorb_pieces.h"
#include "sheets/grow_pieces.h"
#include "sheets/join_pieces.h"
#include "sheets/rim.h"
#include "sheets/tangent_frame.h"
#include "sheets/voxel_graph.h"
#include "sheets/voxel_section.h"

namespace medial_vk {
namespace {

/// Numbers of sheets for components with any numbers: by decreasing number of points, of equals by first voxels.
std::vector<std::int32_t> number_sheets(const std::vector<std::uint32_t>& piece_of, std::size_t& sheets) {
  std::vector<std::uint64_t> points(piece_of.size(), 0);
  std::vector<std::uint32_t> pieces;  // in the order of their first voxels
  for (const std::uint32_t piece : piece_of) {
    if (points[piece]++ == 0) pieces.push_back(piece);
  }
  std::stable_sort(pieces.begin(), pieces.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return points[a] > points[b]; });
  std::vector<std::int32_t> number(piece_of.size(), -1);
  for (std::size_t i = 0; i < pieces.size(); ++i) number[pieces[i]] = static_cast<std::int32_t>(i);
  std::vector<std::int32_t> sheet_of(piece_of.size());
  for (std::size_t place = 0; place < piece_of.size(); ++place) sheet_of[place] = number[piece_of[place]];
  sheets = pieces.size();
  return sheet_of;
}

/// In voxels squared: the area of the sheet in the voxel of a point, where the plane through the point perpendicular to
/// its normal approximates the sheet. The plane is known to within epsilon along its normal, and the area is the mean
/// for the two extreme positions. So where a sheet lies in a wall between two voxels and both have a point of it, each
/// gets half.
double area_in_voxel(const MedialSphere& sphere, const VoxelGrid& grid, double epsilon) {
  const Point normal = sheet_normal(sphere);
  const double norm = length(normal);
  if (!(norm > 0)) return 0;
  Point place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place[axis] = (sphere.centre[axis] - grid.origin[axis]) / grid.voxel_size - sphere.voxel[axis];
  }
  const Point aside = epsilon / norm * normal;
  return 0.5 * (section_area(place + aside, normal) + section_area(place - aside, normal));
}

std::uint8_t marks_of(const VoxelGraph& graph, const std::vector<std::int32_t>& sheet_of, std::uint32_t place) {
  const auto neighbours = graph.neighbours(place);
  const bool seam =
      std::ranges::any_of(neighbours, [&](std::uint32_t other) { return sheet_of[other] != sheet_of[place]; });
  return static_cast<std::uint8_t>((seam ? kSeam : 0) | (is_rim(graph, place) ? kRim : 0));
}

/// Sums in voxel order, so that they do not depend on the order of the points.
void describe(const VoxelGraph& graph, const std::vector<std::int32_t>& sheet_of, std::size_t count, unsigned threads,
              Sheets& out) {
  std::vector<std::uint8_t> marks(graph.size());
  parallel_for(graph.size(), 1024, threads, [&](std::size_t i) {
    const auto place = static_cast<std::uint32_t>(i);
    marks[i] = marks_of(graph, sheet_of, place);
  });
  out.sheets.resize(count);
  out.of_point.resize(graph.size());
  out.marks.resize(graph.size());
  for (std::uint32_t place = 0; place < graph.size(); ++place) {
    Sheet& sheet = out.sheets[static_cast<std::size_t>(sheet_of[place])];
    ++sheet.points;
    sheet.mean_radius += graph.sphere(place).radius;
    sheet.mean_object_angle += double{graph.sphere(place).object_angle};
    out.of_point[graph.index(place)] = sheet_of[place];
    out.marks[graph.index(place)] = marks[place];
    if (marks[place] & kSeam) ++out.seam_points;
    if (marks[place] & kRim) ++out.rim_points;
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
    const auto place = static_cast<std::uint32_t>(i);
    const std::uint32_t point = graph.index(place);
    const double share = out.marks[point] & kRim ? 0.5 : 1;
    out.areas[point] = share * voxel_area * area_in_voxel(graph.sphere(place), grid, epsilon);
  });
  for (std::uint32_t place = 0; place < graph.size(); ++place)
    out.sheets[static_cast<std::size_t>(sheet_of[place])].area += out.areas[graph.index(place)];
}

}  // namespace

Sheets find_sheets(std::span<const MedialSphere> spheres, const VoxelGrid& grid, const ExtractionOptions& extraction,
                   const SheetOptions& options, SheetAreas areas) {
  const VoxelGraph graph(spheres, options.threads);
  std::vector<std::uint32_t> piece_of = grow_pieces(graph, extraction.object_angle, options);
  join_pieces(graph, options, piece_of);
  Sheets out;
  for (const std::uint32_t piece : piece_of) out.pieces = std::max(out.pieces, std::uint64_t{piece} + 1);
  const Absorbed absorbed = absorb_pieces(graph, grid.voxel_size, options, piece_of);
  out.absorbed_pieces = absorbed.pieces;
  out.absorbed_points = absorbed.points;
  std::size_t count = 0;
  const std::vector<std::int32_t> sheet_of = number_sheets(piece_of, count);
  describe(graph, sheet_of, count, options.threads, out);
  for (std::uint32_t place = 0; place < graph.size(); ++place) {
    if (absorbed.is_small[place]) out.marks[graph.index(place)] |= kSmall;
  }
  if (areas == SheetAreas::kMeasured) measure_areas(graph, grid, extraction.epsilon, sheet_of, options.threads, out);
  return out;
}

}  // namespace medial_vk
