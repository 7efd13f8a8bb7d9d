#include "boundary_fields/summaries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// The middle of the values in their order; 0 without values.
double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// A third of the area of the triangles around each vertex.
std::vector<double> areas_of_vertices(const Mesh& mesh) {
  std::vector<double> areas(mesh.vertices.size(), 0);
  for (const Triangle& t : mesh.triangles) {
    double shorter = 0;
    const double area =
        0.5 * length(double_area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], shorter));
    for (const std::uint32_t corner : t) areas[corner] += area / 3;
  }
  return areas;
}

std::optional<CurvatureRecord::Range> range_of(const BoundaryField& field) {
  std::optional<CurvatureRecord::Range> range;
  for (const double value : field.values) {
    if (std::isnan(value)) continue;
    if (!range) range = {value, value};
    range->least = std::min(range->least, value);
    range->greatest = std::max(range->greatest, value);
  }
  return range;
}

}  // namespace

double area_of(const Mesh& mesh) {
  const std::vector<double> areas = areas_of_vertices(mesh);
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

double ThicknessRecord::share(ThicknessKind kind) const {
  const auto points = static_cast<double>(std::max<std::size_t>(intervals.size(), 1));
  return static_cast<double>(of_kind[static_cast<std::size_t>(kind)]) / points;
}

ThicknessRecord summarise_thickness(std::span<const Point> points, std::span<const Thickness> at_points,
                                    const ThicknessOptions& how) {
  ThicknessRecord record;
  record.delta = how.delta;
  record.width = how.width;
  record.wall_angle = how.wall_angle;
  record.crease_angle = how.crease_angle;
  std::vector<double> lower, upper;
  record.intervals.reserve(at_points.size());
  lower.reserve(at_points.size());
  upper.reserve(at_points.size());
  for (std::size_t i = 0; i < at_points.size(); ++i) {
    const Bounds& interval = at_points[i].diameter;
    record.intervals.push_back(interval);
    lower.push_back(interval.lower);
    upper.push_back(interval.upper);
    if (interval.upper - interval.lower > kWideInterval * interval.lower) ++record.wide;
    record.greatest = std::max(record.greatest, interval.upper);
    ++record.of_kind[static_cast<std::size_t>(at_points[i].kind)];
    const bool is_wall =
        at_points[i].kind == ThicknessKind::kWall && 2 * at_points[i].ball.radius >= kWallDeltas * how.delta;
    if (is_wall && (!record.least || interval.lower < record.least->lower)) {
      record.least = interval;
      record.least_at = points[i];
    }
  }
  record.median = {median_of(std::move(lower)), median_of(std::move(upper))};
  return record;
}

CurvatureRecord summarise_curvature(const Mesh& mesh, const BoundaryFields& fields) {
  const BoundaryField& kappa_1 = *fields.find(field_names::kKappa1);
  const BoundaryField& kappa_2 = *fields.find(field_names::kKappa2);
  CurvatureRecord record;
  record.kappa_1 = range_of(kappa_1);
  record.kappa_2 = range_of(kappa_2);
  const std::vector<double> areas = areas_of_vertices(mesh);
  const BoundaryField& states = *fields.find(field_names::kCurvatureState);
  double all = 0, unknown = 0, none = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    all += areas[i];
    record.state_shares[static_cast<std::size_t>(states.values[i])] += areas[i];
    if (std::isnan(kappa_1.values[i]) || std::isnan(kappa_2.values[i])) unknown += areas[i];
    if (std::isnan(kappa_1.values[i]) && std::isnan(kappa_2.values[i])) none += areas[i];
  }
  record.unknown_share = all > 0 ? unknown / all : 0;
  record.none_share = all > 0 ? none / all : 0;
  for (double& share : record.state_shares) share = all > 0 ? share / all : 0;
  std::vector<double> errors = fields.find(field_names::kCurvatureError)->values;
  std::erase_if(errors, [](double error) { return std::isnan(error); });
  if (!errors.empty()) record.median_error = median_of(std::move(errors));
  return record;
}

}  // namespace medial_vk
