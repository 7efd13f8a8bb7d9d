#include <pybind11/stl.h>

#include "medial_vk/curvature.h"
#include "medial_vk/least_wall.h"
#include "medial_vk/thickness.h"
#include "medial_vk/vertex_curvature.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// What measure_curvature() found, with the balls that it belongs to, for curvature_at_vertices().
struct CurvatureHandle {
  std::vector<Ball> balls;
  BoundaryCurvature curvature;
};

/// Fewer points, or balls, are measured on the calling thread.
constexpr std::size_t kFewTips = 16;

void read_side(Options& options, ThicknessSide& side) {
  options.read("side", side,
               std::array{Choice<ThicknessSide>{"walls", ThicknessSide::kWalls},
                          Choice<ThicknessSide>{"gaps", ThicknessSide::kGaps}});
}

ThicknessOptions thickness_options(py::dict values) {
  ThicknessOptions made;
  Options options(std::move(values));
  read_side(options, made.side);
  options.read("delta", made.delta);
  options.read("width", made.width);
  options.read("limit", made.limit);
  options.read("patience", made.patience);
  options.read("queries", made.queries);
  options.read("wall_angle", made.wall_angle);
  options.read("crease_angle", made.crease_angle);
  options.read("threads", made.threads);
  options.finish();
  return made;
}

py::dict thickness(const MeshHandle& mesh, py::handle array, py::dict values, const py::object& progress) {
  std::vector<Point> points = points_of(array, "points");
  const py::array_t<double> read = array_of(std::vector<Point>(points));
  const bool is_short = points.size() <= kFewTips;
  const ThicknessOptions options = thickness_options(std::move(values));
  const CallWithProgress reported(progress);
  const ProgressCallback on_progress = reported.of_stage("thickness");
  const auto call = reported.call;
  const std::vector<Thickness> measured = value_of(run_unless_short(
      is_short, call,
      [mesh = mesh.mesh, points = std::move(points), options, on_progress, call] {
        return measure_thickness(mesh, points, options, on_progress, call->token());
      },
      progress));
  py::dict out;
  out["points"] = read;
  out["lower"] = column(measured, [](const Thickness& at) { return at.diameter.lower; });
  out["upper"] = column(measured, [](const Thickness& at) { return at.diameter.upper; });
  out["centres"] = column(measured, [](const Thickness& at) { return at.ball.centre; });
  out["radii"] = column(measured, [](const Thickness& at) { return at.ball.radius; });
  out["object_angles"] = column(measured, [](const Thickness& at) { return at.object_angle; });
  out["contacts_a"] = column(measured, [](const Thickness& at) { return at.contacts[0]; });
  out["contacts_b"] = column(measured, [](const Thickness& at) { return at.contacts[1]; });
  out["kinds"] = column(measured, [](const Thickness& at) { return static_cast<std::uint8_t>(at.kind); });
  return out;
}

py::dict least_wall(const MeshHandle& mesh, py::dict values, const py::object& progress) {
  LeastWallOptions made;
  Options options(std::move(values));
  read_side(options, made.side);
  options.read("object_angle", made.object_angle);
  options.read("width", made.width);
  options.read("limit", made.limit);
  options.read("cells", made.cells);
  options.read("threads", made.threads);
  options.finish();
  const CallWithProgress reported(progress);
  const ProgressCallback on_progress = reported.of_stage("least wall");
  const auto call = reported.call;
  const LeastWall found = value_of(run(
      call,
      [mesh = mesh.mesh, made, on_progress, call] {
        return measure_least_wall(mesh, made, on_progress, call->token());
      },
      progress));
  py::dict out;
  out["lower"] = found.diameter.lower;
  out["upper"] = found.diameter.upper;
  out["cells"] = found.cells;
  out["thinnest"] = py::none();
  if (found.thinnest) {
    py::dict ball;
    ball["centre"] = array_of(found.thinnest->ball.centre);
    ball["radius"] = found.thinnest->ball.radius;
    ball["contacts"] = column(std::array{found.thinnest->a, found.thinnest->b}, [](const Point& p) { return p; });
    ball["object_angle"] = found.thinnest->object_angle;
    out["thinnest"] = std::move(ball);
  }
  return out;
}

std::vector<SpokePair> spokes_of(py::handle a, py::handle b) {
  if (a.is_none() && b.is_none()) return {};
  const std::vector<Point> from_a = points_of(a, "spokes_a"), from_b = points_of(b, "spokes_b");
  if (from_a.size() != from_b.size()) fail_usage("there are not as many `spokes_a` as `spokes_b`");
  const auto unit = [](const Point& p) {
    const double length = std::hypot(p[0], p[1], p[2]);  // those of an analysis are rounded to float
    return std::abs(length - 1) < 1e-6 ? Point{p[0] / length, p[1] / length, p[2] / length} : p;
  };
  std::vector<SpokePair> spokes(from_a.size());
  for (std::size_t i = 0; i < spokes.size(); ++i) spokes[i] = {unit(from_a[i]), unit(from_b[i])};
  return spokes;
}

CurvatureOptions curvature_options(py::dict values) {
  CurvatureOptions made;
  Options options(std::move(values));
  options.read("method", made.method,
               std::array{Choice<CurvatureMethod>{"fits", CurvatureMethod::kFits},
                          Choice<CurvatureMethod>{"differences", CurvatureMethod::kDifferences}});
  options.read("spacing", made.spacing);
  options.read("step", made.step);
  options.read("smooth", made.smooth);
  options.read("threads", made.threads);
  options.finish();
  return made;
}

std::shared_ptr<CurvatureHandle> curvature(py::handle centres, py::handle radii, py::handle spokes_a,
                                           py::handle spokes_b, py::dict values, const py::object& progress) {
  auto made = std::make_shared<CurvatureHandle>();
  made->balls = balls_of(centres, radii);
  const bool is_short = made->balls.size() <= kFewTips;
  const std::vector<SpokePair> spokes = spokes_of(spokes_a, spokes_b);
  const CurvatureOptions options = curvature_options(std::move(values));
  const CallWithProgress reported(progress);
  const StageProgress on_progress = reported.stages();
  const auto call = reported.call;
  made->curvature = value_of(run_unless_short(
      is_short, call,
      [made, spokes, options, on_progress, call] {
        return measure_curvature(made->balls, options, spokes, on_progress, call->token());
      },
      progress));
  return made;
}

py::dict tips(const CurvatureHandle& handle, std::size_t tip) {
  const std::vector<BallCurvature>& balls = handle.curvature.balls;
  const auto of = [&](auto get) {
    return column(balls, [tip, get](const BallCurvature& ball) { return get(ball.tips[tip]); });
  };
  py::dict out;
  out["states"] = of([](const TipCurvature& at) { return static_cast<std::uint8_t>(at.state); });
  out["normals"] = of([](const TipCurvature& at) { return at.normal; });
  out["kappa"] = of([](const TipCurvature& at) { return at.kappa; });
  out["directions_1"] = of([](const TipCurvature& at) { return at.directions[0]; });
  out["directions_2"] = of([](const TipCurvature& at) { return at.directions[1]; });
  out["errors"] = of([](const TipCurvature& at) { return at.error; });
  out["normal_errors"] = of([](const TipCurvature& at) { return at.normal_error; });
  out["windows"] = of([](const TipCurvature& at) { return at.window; });
  return out;
}

py::dict at_vertices(const std::shared_ptr<CurvatureHandle>& handle, const MeshHandle& mesh, py::dict values,
                     const py::object& progress) {
  VertexCurvatureOptions made;
  Options options(std::move(values));
  options.read("assignment", made.assignment,
               std::array{Choice<CurvatureAssignment>{"along_surface", CurvatureAssignment::kAlongSurface},
                          Choice<CurvatureAssignment>{"voronoi", CurvatureAssignment::kVoronoi}});
  options.read("object_angle", made.object_angle);
  options.read("threads", made.threads);
  options.finish();
  const CallWithProgress reported(progress);
  const StageProgress on_progress = reported.stages();
  const auto call = reported.call;
  const std::vector<VertexCurvature> measured = value_of(run(
      call,
      [mesh = mesh.mesh, handle, made, on_progress, call] {
        return curvature_at_vertices(mesh, handle->balls, handle->curvature, made, on_progress, call->token());
      },
      progress));
  py::dict out;
  out["states"] = column(measured, [](const VertexCurvature& at) { return static_cast<std::uint8_t>(at.state); });
  out["normals"] = column(measured, [](const VertexCurvature& at) { return at.normal; });
  out["kappa"] = column(measured, [](const VertexCurvature& at) { return at.kappa; });
  out["directions_1"] = column(measured, [](const VertexCurvature& at) { return at.directions[0]; });
  out["directions_2"] = column(measured, [](const VertexCurvature& at) { return at.directions[1]; });
  out["errors"] = column(measured, [](const VertexCurvature& at) { return at.error; });
  return out;
}

}  // namespace

void bind_boundary(py::module_& module) {
  py::class_<CurvatureHandle, std::shared_ptr<CurvatureHandle>>(module, "Curvature")
      .def("tips", &tips)
      .def("spacing", [](const CurvatureHandle& handle) { return handle.curvature.spacing; })
      .def("object_angles",
           [](const CurvatureHandle& handle) {
             return column(handle.curvature.balls, [](const BallCurvature& ball) { return ball.object_angle; });
           })
      .def("at_vertices", &at_vertices);
  module.def("measure_thickness", &thickness);
  module.def("measure_least_wall", &least_wall);
  module.def("measure_curvature", &curvature);
}

}  // namespace medial_vk::python
