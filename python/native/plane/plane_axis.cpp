// The medial axis in the plane, curves between sites there, and their roadmap.
#include "medial_vk/plane_axis.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial_vk/plane_centre_line.h"
#include "medial_vk/plane_roadmap.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"
#include "native/plane/plane_handles.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

using SharedAxis = std::shared_ptr<PlaneAxisHandle>;

/// A roadmap, and what its curves are between.
struct PlaneRoadmapHandle {
  PlaneRoadmap roadmap;
  SharedAxis curves;
};

SharedAxis axis_of_shape(const SharedShape& shape, py::dict values, const py::object& progress) {
  PlaneAxisOptions made;
  Options options(std::move(values));
  options.read(
      "side", made.side,
      std::array{Choice<PlaneSide>{"inside", PlaneSide::kInside}, Choice<PlaneSide>{"outside", PlaneSide::kOutside},
                 Choice<PlaneSide>{"both", PlaneSide::kBoth}});
  options.read("object_angle", made.object_angle);
  options.read("radius", made.radius);
  options.read("margin", made.margin);
  options.read("threads", made.threads);
  options.finish();
  const CallWithProgress reported(progress);
  const ProgressCallback on_progress = reported.of_stage("axis");
  const auto call = reported.call;
  PlaneAxis axis = value_of(run(
      call,
      [shape, made, on_progress, call] { return find_plane_axis(shape->shape, made, on_progress, call->token()); },
      progress));
  return std::make_shared<PlaneAxisHandle>(
      PlaneAxisHandle{std::move(axis), shape->shape.report.longest_side(), std::nullopt, {}});
}

double longest_side_of(const std::vector<PlanePoint>& points) {
  double longest = 0;
  for (std::size_t k = 0; k < 2 && !points.empty(); ++k) {
    const auto [least, greatest] = std::ranges::minmax(points, {}, [k](const PlanePoint& p) { return p[k]; });
    longest = std::max(longest, greatest[k] - least[k]);
  }
  return longest;
}

/// The sites that are shapes, and their numbers.
struct ShapesOfSites {
  std::vector<SharedShape> shapes;
  std::vector<std::uint32_t> sites;
};

/// The points and segments of shapes, and of lines given by their points, with their numbers as sites.
PlaneSites plane_sites_of(const py::list& elements, ShapesOfSites& solid) {
  PlaneSites sites;
  std::uint32_t number = 0;
  for (const py::handle element : elements) {
    const auto first = static_cast<std::uint32_t>(sites.points.size());
    if (py::isinstance<ShapeHandle>(element)) {
      solid.shapes.push_back(element.cast<SharedShape>());
      solid.sites.push_back(number);
      const PreparedShape& shape = solid.shapes.back()->shape;
      sites.points.insert(sites.points.end(), shape.points.begin(), shape.points.end());
      for (const auto& [a, b] : shape.segments) sites.segments.push_back({first + a, first + b});
    } else {
      const std::vector<PlanePoint> line = plane_points_of(element, "sites");
      if (line.empty()) fail_usage("site " + std::to_string(number) + " has no point");
      sites.points.insert(sites.points.end(), line.begin(), line.end());
      for (std::uint32_t i = 1; i < line.size(); ++i) sites.segments.push_back({first + i - 1, first + i});
    }
    sites.site_of_point.resize(sites.points.size(), number);
    sites.site_of_segment.resize(sites.segments.size(), number);
    ++number;
  }
  return sites;
}

bool is_in_box(const PlanePoint& p, const ShapeReport& of) {
  return of.lower[0] <= p[0] && p[0] <= of.upper[0] && of.lower[1] <= p[1] && p[1] <= of.upper[1];
}

/// That no shape holds a point of another site, whose lines do not meet those of the shape.
Status check_outside(const PlaneSites& sites, const ShapesOfSites& solid, const std::stop_token& stop) {
  for (std::size_t i = 0; i < sites.points.size(); ++i) {
    const std::uint32_t site = sites.site_of_point[i];
    if (stop.stop_requested()) return Error{ErrorCode::kInterrupted, "stopped"};
    for (std::size_t k = 0; k < solid.shapes.size(); ++k) {
      const ShapeHandle& shape = *solid.shapes[k];
      if (solid.sites[k] == site || !is_in_box(sites.points[i], shape.shape.report)) continue;
      if (!shape.boundary.nearest(sites.points[i]).is_inside) continue;
      return Error{ErrorCode::kInvalidMesh, "site " + std::to_string(site) + " lies in site " +
                                                std::to_string(solid.sites[k]) + "; sites in the plane must be apart"};
    }
  }
  return {};
}

SharedAxis curves_between(const py::list& elements, py::dict values, const py::object& progress) {
  ShapesOfSites solid;
  PlaneSites sites = plane_sites_of(elements, solid);
  PlaneVoronoiOptions made;
  Options options(std::move(values));
  options.read("object_angle", made.object_angle);
  options.read("margin", made.margin);
  options.read("threads", made.threads);
  options.finish();
  const CallWithProgress reported(progress);
  const ProgressCallback on_progress = reported.of_stage("curves");
  const auto call = reported.call;
  PlaneAxis axis = value_of(run(
      call,
      [sites, solid, made, on_progress, call]() -> Result<PlaneAxis> {
        Result<PlaneAxis> found = find_plane_voronoi(sites, made, on_progress, call->token());
        if (!found) return found;
        if (const Status status = check_outside(sites, solid, call->token()); !status) return status.error();
        return found;
      },
      progress));
  const double longest_side = longest_side_of(sites.points);
  return std::make_shared<PlaneAxisHandle>(
      PlaneAxisHandle{std::move(axis), longest_side, std::move(sites), std::move(solid.shapes)});
}

py::dict nodes_dict(const std::vector<AxisNode>& nodes) {
  py::dict out;
  out["points"] = column(nodes, [](const AxisNode& node) { return node.point; });
  out["radii"] = column(nodes, [](const AxisNode& node) { return node.radius; });
  out["object_angles"] = column(nodes, [](const AxisNode& node) { return node.object_angle; });
  out["kinds"] = column(nodes, [](const AxisNode& node) { return static_cast<std::uint8_t>(node.kind); });
  out["degrees"] = column(nodes, [](const AxisNode& node) { return node.degree; });
  return out;
}

py::dict arcs_dict(const std::vector<AxisArc>& arcs) {
  const auto of = [&](auto get) { return column(arcs, [get](const AxisArc& arc) { return get(arc.curve); }); };
  py::dict out;
  out["nodes"] = column(arcs, [](const AxisArc& arc) { return arc.nodes; });
  out["t"] = column(arcs, [](const AxisArc& arc) { return arc.t; });
  out["contacts"] = column(arcs, [](const AxisArc& arc) {
    return std::array{arc.contacts[0].index, arc.contacts[1].index};
  });
  out["contact_is_point"] = column(arcs, [](const AxisArc& arc) {
    return std::array{static_cast<std::uint8_t>(arc.contacts[0].is_point),
                      static_cast<std::uint8_t>(arc.contacts[1].is_point)};
  });
  out["kinds"] = of([](const PlaneCurve& curve) { return static_cast<std::uint8_t>(curve.kind); });
  out["origins"] = of([](const PlaneCurve& curve) { return curve.origin; });
  out["along"] = of([](const PlaneCurve& curve) { return curve.along; });
  out["up"] = of([](const PlaneCurve& curve) { return curve.up; });
  out["focus"] = of([](const PlaneCurve& curve) { return curve.focus; });
  out["radii"] = of([](const PlaneCurve& curve) { return curve.radius; });
  out["slopes"] = of([](const PlaneCurve& curve) { return curve.slope; });
  out["object_angles"] = of([](const PlaneCurve& curve) { return curve.angle; });
  return out;
}

/// Lists of different lengths one after the other: list i begins at first[i], and ends where the next one begins.
template <class Range, class Get>
py::array_t<std::uint64_t> first_of(const Range& lists, Get size_of) {
  std::vector<std::uint64_t> first = {0};
  first.reserve(lists.size() + 1);
  for (const auto& list : lists) first.push_back(first.back() + size_of(list));
  return array_of(std::move(first));
}

py::dict branches_dict(const PlaneAxis& axis) {
  std::vector<std::uint32_t> arcs;
  std::vector<std::uint8_t> reversed;
  arcs.reserve(axis.arcs.size());
  reversed.reserve(axis.arcs.size());
  for (const AxisBranch& branch : axis.branches) {
    arcs.insert(arcs.end(), branch.arcs.begin(), branch.arcs.end());
    for (const bool is_reversed : branch.reversed) reversed.push_back(is_reversed ? 1 : 0);
  }
  py::dict out;
  out["ends"] = column(axis.branches, [](const AxisBranch& branch) { return branch.ends; });
  out["lengths"] = column(axis.branches, [](const AxisBranch& branch) { return branch.length; });
  out["significance"] = column(axis.branches, [&axis](const AxisBranch& branch) {
    return is_end_branch(axis, branch) ? significance_of(axis, branch) : std::numeric_limits<double>::quiet_NaN();
  });
  out["first"] = first_of(axis.branches, [](const AxisBranch& branch) { return branch.arcs.size(); });
  out["arcs"] = array_of(std::move(arcs));
  out["reversed"] = array_of(std::move(reversed));
  return out;
}

py::dict axis_results(const PlaneAxisHandle& handle) {
  py::dict out;
  out["nodes"] = nodes_dict(handle.axis.nodes);
  out["arcs"] = arcs_dict(handle.axis.arcs);
  out["branches"] = branches_dict(handle.axis);
  out["junctions"] = handle.axis.junctions();
  out["epsilon"] = handle.axis.epsilon;
  out["cells"] = handle.axis.cells;
  return out;
}

py::dict sites_dict(const PlaneAxisHandle& handle) {
  const PlaneSites& sites = handle.sites.value();
  py::dict out;
  out["points"] = array_of(std::vector<PlanePoint>(sites.points));
  out["segments"] = array_of(std::vector<std::array<std::uint32_t, 2>>(sites.segments));
  out["site_of_point"] = array_of(std::vector<std::uint32_t>(sites.site_of_point));
  out["site_of_segment"] = array_of(std::vector<std::uint32_t>(sites.site_of_segment));
  return out;
}

SharedAxis pruned(const SharedAxis& handle, double length, double significance) {
  PlaneAxis axis = value_of(run([handle, length, significance] {
    return prune_plane_axis(handle->axis, {.length = length, .significance = significance});
  }));
  return std::make_shared<PlaneAxisHandle>(PlaneAxisHandle{std::move(axis), handle->longest_side, std::nullopt, {}});
}

py::tuple longest_paths(const SharedAxis& handle) {
  const auto call = std::make_shared<Call>();
  PlaneLongestPaths found =
      value_of(run(call, [handle, call] { return find_longest_paths(handle->axis, call->token()); }));
  return py::make_tuple(
      std::make_shared<PlaneAxisHandle>(PlaneAxisHandle{std::move(found.axis), handle->longest_side, std::nullopt, {}}),
      found.excess);
}

/// As shares of the longest side: the step of the tool, and the least one, below which points would have no end.
constexpr double kUsualStep = 1e-4;
constexpr double kLeastStep = 1e-9;

Result<std::vector<std::vector<AxisSample>>> make_lines(const PlaneAxisHandle& handle, double step, double width,
                                                        const std::stop_token& stop) {
  const PlaneAxis& axis = handle.axis;
  std::vector<std::vector<AxisSample>> lines;
  lines.reserve(axis.branches.size());
  for (const AxisBranch& branch : axis.branches) {
    if (stop.stop_requested()) return Error{ErrorCode::kInterrupted, "stopped"};
    std::vector<AxisSample> line = sample_branch(axis, branch, step);
    const bool is_loop = branch.ends[0] == branch.ends[1] && axis.nodes[branch.ends[0]].degree == 2;
    if (width > 0) line = smooth_polyline(line, width, is_loop);
    lines.push_back(std::move(line));
  }
  return lines;
}

py::dict samples_dict(const std::vector<AxisSample>& samples) {
  py::dict out;
  out["points"] = column(samples, [](const AxisSample& at) { return at.point; });
  out["radii"] = column(samples, [](const AxisSample& at) { return at.radius; });
  out["object_angles"] = column(samples, [](const AxisSample& at) { return at.object_angle; });
  return out;
}

py::list lines_of(const SharedAxis& handle, double step, double smooth) {
  if (!(step >= 0 && std::isfinite(step))) fail_usage("`step` must be finite, and not negative");
  if (!(smooth >= 0 && std::isfinite(smooth))) fail_usage("`smooth` must be finite, and not negative");
  const double used = std::max(step > 0 ? step : kUsualStep * handle->longest_side, kLeastStep * handle->longest_side);
  const auto call = std::make_shared<Call>();
  const std::vector<std::vector<AxisSample>> lines =
      value_of(run(call, [handle, used, smooth, call] { return make_lines(*handle, used, smooth, call->token()); }));
  py::list out;
  for (const std::vector<AxisSample>& line : lines) out.append(samples_dict(line));
  return out;
}

/// Points of arcs at parameters, which may lie beyond their ends.
py::dict samples_at(const SharedAxis& handle, py::handle arc_array, py::handle t_array) {
  const std::vector<std::uint32_t> arcs = indices_of(arc_array, "arcs");
  const std::vector<double> t = numbers_of(t_array, "t");
  if (arcs.size() != t.size()) fail_usage("there are not as many `t` as `arcs`");
  std::vector<AxisSample> samples;
  samples.reserve(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    if (arcs[i] >= handle->axis.arcs.size()) {
      fail_usage("row " + std::to_string(i) + " of `arcs` is " + std::to_string(arcs[i]) + ", of " +
                 std::to_string(handle->axis.arcs.size()) + " arcs");
    }
    const PlaneCurve& curve = handle->axis.arcs[arcs[i]].curve;
    samples.push_back({curve.point_at(t[i]), curve.radius_at(t[i]), curve.object_angle_at(t[i])});
  }
  return samples_dict(samples);
}

std::shared_ptr<PlaneRoadmapHandle> make_plane_roadmap(const SharedAxis& curves, unsigned threads) {
  if (!curves->sites) fail_usage("a roadmap is made of curves between sites");
  return std::make_shared<PlaneRoadmapHandle>(PlaneRoadmapHandle{
      value_of(
          run([curves, threads] { return PlaneRoadmap::build(*curves->sites, curves->axis, {.threads = threads}); })),
      curves});
}

py::dict plane_links(const PlaneRoadmapHandle& handle) {
  const std::vector<PlaneRoadmapLink>& links = handle.roadmap.links();
  py::dict out;
  out["arcs"] = column(links, [](const PlaneRoadmapLink& link) { return link.arc; });
  out["lengths"] = column(links, [](const PlaneRoadmapLink& link) { return link.length; });
  out["widths"] = column(links, [](const PlaneRoadmapLink& link) { return link.width; });
  out["component_of_node"] = array_of(std::vector<std::uint32_t>(handle.roadmap.component_of_node()));
  out["components"] = handle.roadmap.components();
  return out;
}

py::object plane_path(const std::shared_ptr<PlaneRoadmapHandle>& handle, py::handle from_array, py::handle to_array) {
  const PlanePoint from = plane_point_of(from_array, "start"), to = plane_point_of(to_array, "end");
  for (const auto& [place, name] : {std::pair(from, "`start`"), std::pair(to, "`end`")}) {
    for (const SharedShape& shape : handle->curves->shapes) {
      if (std::isfinite(place[0] + place[1]) && shape->boundary.nearest(place).is_inside) {
        fail_usage(std::string(name) + " is inside of a site");
      }
    }
  }
  const std::optional<PlanePath> path =
      value_of(run([handle, from, to] { return handle->roadmap.widest_path(from, to); }));
  if (!path) return py::none();
  py::dict out;
  out["line"] = array_of(std::vector<PlanePoint>(path->line));
  out["width"] = path->width;
  out["length"] = path->length;
  return out;
}

}  // namespace

void bind_plane_axis(py::module_& module) {
  py::class_<PlaneAxisHandle, SharedAxis>(module, "PlaneAxis")
      .def("results", &axis_results)
      .def("sites", &sites_dict)
      .def("pruned", &pruned)
      .def("longest_paths", &longest_paths)
      .def("lines", &lines_of)
      .def("at", &samples_at)
      .def("roadmap", &make_plane_roadmap);
  py::class_<PlaneRoadmapHandle, std::shared_ptr<PlaneRoadmapHandle>>(module, "PlaneRoadmap")
      .def("links", &plane_links)
      .def("widest_path", &plane_path);
  module.def("find_plane_axis", &axis_of_shape);
  module.def("find_plane_voronoi", &curves_between);
}

}  // namespace medial_vk::python
