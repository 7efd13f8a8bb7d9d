// Shapes in the plane, queries of their boundaries, and their medial axis as the source publishes it.
#include <pybind11/stl.h>

#include <cmath>

#include "medial_vk/plane_thesis.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"
#include "native/plane/plane_handles.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

SharedShape make_shape(const py::list& arrays, py::dict values) {
  std::vector<PlaneRing> rings;
  rings.reserve(arrays.size());
  for (const py::handle array : arrays) rings.push_back(plane_points_of(array, "rings"));
  FillRule rule = FillRule::kNonZero;
  unsigned threads = 0;
  Options options(std::move(values));
  options.read(
      "fill", rule,
      std::array{Choice<FillRule>{"nonzero", FillRule::kNonZero}, Choice<FillRule>{"evenodd", FillRule::kEvenOdd}});
  options.read("threads", threads);
  options.finish();
  const auto call = std::make_shared<Call>();
  return value_of(run(call, [rings = std::move(rings), rule, threads, call]() -> Result<SharedShape> {
    Result<PreparedShape> shape = prepare_shape(rings, rule, threads, call->token());
    if (!shape) return shape.error();
    Result<PlaneBoundary> boundary = PlaneBoundary::build(shape.value());
    if (!boundary) return boundary.error();
    return std::make_shared<ShapeHandle>(ShapeHandle{std::move(shape).value(), std::move(boundary).value()});
  }));
}

py::dict shape_report(const ShapeHandle& handle) {
  const ShapeReport& report = handle.shape.report;
  py::dict out;
  out["rings"] = report.rings;
  out["segments"] = report.segments;
  out["merged_points"] = report.merged_points;
  out["degenerate_rings"] = report.degenerate_rings;
  out["crossings"] = report.crossings;
  out["touching_points"] = report.touching_points;
  out["inner_segments"] = report.inner_segments;
  out["tolerance"] = report.tolerance;
  out["area"] = report.area;
  out["perimeter"] = report.perimeter;
  out["lower"] = array_of(report.lower);
  out["upper"] = array_of(report.upper);
  out["assumptions"] = report.assumptions;
  return out;
}

/// Beyond this size squares of coordinates could overflow.
constexpr double kFarthestInPlane = 1e150;
/// Fewer points are queried on the calling thread.
constexpr std::size_t kFewPlanePoints = 32;

Result<std::vector<NearestBoundary>> find_nearest(const PlaneBoundary& boundary, const std::vector<PlanePoint>& points,
                                                  const std::stop_token& stop) {
  std::vector<NearestBoundary> found(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (stop.stop_requested()) return Error{ErrorCode::kInterrupted, "stopped"};
    if (!(std::abs(points[i][0]) + std::abs(points[i][1]) <= kFarthestInPlane)) {
      return Error{ErrorCode::kUsage, "row " + std::to_string(i) + " of `points` is not finite, or beyond 1e150"};
    }
    found[i] = boundary.nearest(points[i]);
  }
  return found;
}

py::dict nearest_points(const SharedShape& handle, py::handle array) {
  std::vector<PlanePoint> points = plane_points_of(array, "points");
  const bool is_short = points.size() <= kFewPlanePoints;
  const auto call = std::make_shared<Call>();
  const std::vector<NearestBoundary> found =
      value_of(run_unless_short(is_short, call, [handle, points = std::move(points), call] {
        return find_nearest(handle->boundary, points, call->token());
      }));
  py::dict out;
  out["points"] = column(found, [](const NearestBoundary& at) { return at.foot; });
  out["directions"] = column(found, [](const NearestBoundary& at) { return at.direction; });
  out["distances"] = column(found, [](const NearestBoundary& at) { return at.distance; });
  out["inside"] = column(found, [](const NearestBoundary& at) { return static_cast<std::uint8_t>(at.is_inside); });
  return out;
}

py::dict decision_dict(const CircleDecision& decision) {
  const auto of = [&](auto get) {
    return column(decision.points, [get](const CirclePoint& point) { return get(point); });
  };
  py::dict out;
  out["has_medial_point"] = decision.decision == MedialDecision::kTrue;
  out["line"] = static_cast<int>(decision.reason);
  out["found"] = column(decision.decision == MedialDecision::kTrue
                            ? std::vector<std::uint32_t>{decision.found[0], decision.found[1]}
                            : std::vector<std::uint32_t>{},
                        [](std::uint32_t i) { return i; });
  out["points"] = of([](const CirclePoint& point) { return point.point; });
  out["feet"] = of([](const CirclePoint& point) { return point.nearest.foot; });
  out["directions"] = of([](const CirclePoint& point) { return point.nearest.direction; });
  out["opposites"] = of([](const CirclePoint& point) { return point.opposite; });
  return out;
}

py::dict decide_circle(const SharedShape& handle, py::handle centre, double radius, const py::object& samples) {
  const PlaneCircle circle = {plane_point_of(centre, "centre"), radius};
  if (PyLong_Check(samples.ptr()) != 0) {
    unsigned count = 0;
    py::dict values;
    values["samples"] = samples;
    Options options(std::move(values));
    options.read("samples", count);
    return decision_dict(
        value_of(run([handle, circle, count] { return decide_medial_axis(handle->boundary, circle, count); })));
  }
  const std::vector<double> angles = numbers_of(samples, "samples");
  return decision_dict(
      value_of(run([handle, circle, angles] { return decide_medial_axis(handle->boundary, circle, angles); })));
}

PlaneThesisOptions thesis_options(py::dict values) {
  PlaneThesisOptions made;
  Options options(std::move(values));
  options.read("object_angle", made.object_angle);
  options.read("radius", made.radius);
  options.read("samples", made.samples);
  options.read("largest_disc", made.largest_disc);
  options.read("least_disc", made.least_disc);
  options.read("epsilon", made.epsilon);
  options.read("threads", made.threads);
  options.finish();
  return made;
}

py::dict axis_as_published(const SharedShape& handle, py::dict values, const py::object& progress) {
  const PlaneThesisOptions options = thesis_options(std::move(values));
  const CallWithProgress reported(progress);
  const ProgressCallback on_progress = reported.of_stage("axis");
  const auto call = reported.call;
  const PublishedAxis axis = value_of(run(
      call,
      [handle, options, on_progress, call] {
        return find_plane_axis_as_published(handle->shape, options, on_progress, call->token());
      },
      progress));
  py::dict out;
  out["points"] = column(axis.points, [](const PublishedPoint& at) { return at.point; });
  out["radii"] = column(axis.points, [](const PublishedPoint& at) { return at.radius; });
  out["feet_a"] = column(axis.points, [](const PublishedPoint& at) { return at.feet[0]; });
  out["feet_b"] = column(axis.points, [](const PublishedPoint& at) { return at.feet[1]; });
  out["object_angles"] = column(axis.points, [](const PublishedPoint& at) { return at.object_angle; });
  out["discs"] = axis.discs;
  out["undetermined"] = axis.undetermined;
  out["decided"] = py::make_tuple(axis.decided[0], axis.decided[1], axis.decided[2]);
  out["samples"] = axis.samples;
  out["missed_angle"] = axis.missed_angle;
  out["missed_radius"] = axis.missed_radius;
  return out;
}

}  // namespace

void bind_plane(py::module_& module) {
  py::class_<ShapeHandle, SharedShape>(module, "PlaneShape")
      .def("points", [](const ShapeHandle& handle) { return array_of(std::vector<PlanePoint>(handle.shape.points)); })
      .def("segments",
           [](const ShapeHandle& handle) {
             return array_of(std::vector<std::array<std::uint32_t, 2>>(handle.shape.segments));
           })
      .def("report", &shape_report)
      .def("nearest", &nearest_points)
      .def("decide_circle", &decide_circle)
      .def("axis_as_published", &axis_as_published);
  module.def("make_shape", &make_shape);
}

}  // namespace medial_vk::python
