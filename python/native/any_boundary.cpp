// Medial spheres of a boundary that functions of Python know.
#include "medial_vk/any_boundary.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>

#include "native/arrays.h"
#include "native/functions.h"
#include "native/handles.h"
#include "native/medial_dicts.h"
#include "native/options.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

using SharedFunctions = std::shared_ptr<Functions>;

/// What the search found, and the sheets of it.
struct FoundOfBoundary {
  BoundaryExtraction found;
  std::optional<Sheets> sheets;
};

/// The answer of a function to points, which may keep what it gets. The name is for messages.
py::object answer_of(const py::object& function, std::span<const Point> points) {
  return function(array_of(std::vector<Point>(points.begin(), points.end())));
}

void require_rows_for(std::size_t rows, std::size_t points, const char* name) {
  if (rows != points) fail_usage(fmt::format("`{}` has {} rows for {} points", name, rows, points));
}

BoundaryFunctions boundary_of(const SharedFunctions& functions, bool has_contains) {
  BoundaryFunctions boundary;
  boundary.nearest = [functions](std::span<const Point> points, std::span<Point> nearest) {
    functions->use([&](const std::vector<py::object>& all) {
      const std::vector<Point> rows = points_of(answer_of(all[0], points), "nearest(points)");
      require_rows_for(rows.size(), points.size(), "nearest(points)");
      std::ranges::copy(rows, nearest.begin());
    });
  };
  if (!has_contains) return boundary;
  boundary.contains = [functions](std::span<const Point> points, std::span<std::uint8_t> is_inside) {
    functions->use([&](const std::vector<py::object>& all) {
      const std::vector<double> rows = numbers_of(answer_of(all[1], points), "contains(points)");
      require_rows_for(rows.size(), points.size(), "contains(points)");
      std::ranges::transform(rows, is_inside.begin(),
                             [](double x) { return x != 0 ? std::uint8_t{1} : std::uint8_t{0}; });
    });
  };
  return boundary;
}

ExtractionOptions search_options(Options& options) {
  ExtractionOptions made;
  options.read("mode", made.mode,
               std::array{Choice<Mode>{"certified", Mode::kCertified}, Choice<Mode>{"thesis", Mode::kThesis}});
  options.read("resolution", made.resolution);
  options.read("object_angle", made.object_angle);
  options.read("radius", made.radius);
  options.read("deep_angle", made.deep_angle);
  options.read("epsilon", made.epsilon);
  options.read("extra_levels", made.extra_levels);
  options.read("threads", made.threads);
  return made;
}

Result<FoundOfBoundary> search(const BoundaryFunctions& boundary, const ExtractionOptions& options, bool with_sheets,
                               const ProgressCallback& progress, const std::stop_token& stop) {
  Result<BoundaryExtraction> made = extract_medial_spheres(boundary, options, progress, stop);
  if (!made) return made.error();
  FoundOfBoundary out = {std::move(made).value(), std::nullopt};
  if (!with_sheets) return out;
  Extraction& extraction = out.found.extraction;
  SheetOptions of_sheets;
  of_sheets.threads = options.threads;
  Result<Sheets> sheets = find_sheets(extraction.spheres, extraction.grid, options, of_sheets);
  if (!sheets) return sheets.error();
  out.sheets = std::move(sheets).value();
  for (std::size_t i = 0; i < extraction.spheres.size(); ++i) extraction.spheres[i].sheet = out.sheets->of_point[i];
  return out;
}

py::dict found_dict(const FoundOfBoundary& all) {
  const Extraction& extraction = all.found.extraction;
  py::dict out;
  out["grid"] = grid_dict(extraction.grid);
  out["spheres"] = spheres_dict(extraction.spheres);
  out["axis_distances"] = array_of(std::vector<double>(all.found.axis_distance));
  out["undecided"] = undecided_dict(extraction.undecided);
  out["sheets"] = sheets_dict(all.sheets);
  out["queries"] = extraction.measurements.counters.queries;
  return out;
}

py::dict search_boundary(const py::object& nearest, const py::object& contains, py::handle lower, py::handle upper,
                         py::dict values, const py::object& progress) {
  if (PyCallable_Check(nearest.ptr()) == 0) fail_usage("`nearest` is not callable");
  if (!contains.is_none() && PyCallable_Check(contains.ptr()) == 0) fail_usage("`contains` is not callable");
  const CallWithProgress reported(progress);
  const ProgressCallback on_progress = reported.of_stage("extract");
  const auto call = reported.call;
  const auto functions = std::make_shared<Functions>(std::vector<py::object>{nearest, contains}, call);
  BoundaryFunctions boundary = boundary_of(functions, !contains.is_none());
  boundary.lower = point_of(lower, "lower");
  boundary.upper = point_of(upper, "upper");
  Options options(std::move(values));
  const ExtractionOptions made = search_options(options);
  bool with_sheets = true;
  options.read("sheets", with_sheets);
  options.read("error", boundary.error);
  options.finish();
  try {
    return found_dict(value_of(run(
        call,
        [boundary = std::move(boundary), made, with_sheets, on_progress, call] {
          return search(boundary, made, with_sheets, on_progress, call->token());
        },
        progress)));
  } catch (const FunctionFailed&) {
    functions->raise();
  }
}

}  // namespace

void bind_any_boundary(py::module_& module) {
  module.def("search_boundary", &search_boundary);
  module.def("end_functions", &Functions::end);
}

}  // namespace medial_vk::python
