// The surface between sites in space, and its roadmap.
#include <pybind11/stl.h>

#include <array>
#include <limits>

#include "medial_vk/site_roadmap.h"
#include "medial_vk/site_voronoi.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// The surface, and what it is between.
struct SiteVoronoiHandle {
  std::vector<VoronoiSite> sites;
  SiteVoronoi voronoi;
};

using SharedVoronoi = std::shared_ptr<SiteVoronoiHandle>;

/// A roadmap. The library copies what it needs of sites and surface.
struct SiteRoadmapHandle {
  SiteRoadmap roadmap;
};

/// Of the rows of an array, `n` consecutive ones for each element.
template <std::size_t n>
std::vector<std::array<Point, n>> elements_of(py::handle array, const char* name) {
  const std::vector<Point> rows = points_of(array, name);
  std::vector<std::array<Point, n>> elements(rows.size() / n);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) elements[i][k] = rows[n * i + k];
  }
  return elements;
}

/// Of (mesh or None, points, ends of segments, corners of triangles), each of shape (rows, 3).
VoronoiSite site_of(const py::tuple& parts) {
  VoronoiSite site;
  if (!parts[0].is_none()) site.mesh = parts[0].cast<const MeshHandle&>().mesh;
  site.points = points_of(parts[1], "points");
  site.segments = elements_of<2>(parts[2], "segments");
  site.triangles = elements_of<3>(parts[3], "triangles");
  return site;
}

SharedVoronoi surface_between(const py::list& elements, py::dict values, const py::object& progress) {
  std::vector<VoronoiSite> sites;
  sites.reserve(elements.size());
  for (const py::handle element : elements) sites.push_back(site_of(element.cast<py::tuple>()));
  SiteVoronoiOptions made;
  Options options(std::move(values));
  options.read("resolution", made.resolution);
  options.read("margin", made.margin);
  options.read("threads", made.threads);
  options.finish();
  const CallWithProgress reported(progress);
  const ProgressCallback on_progress = reported.of_stage("surface");
  const auto call = reported.call;
  return value_of(run(
      call,
      [sites = std::move(sites), made, on_progress, call]() mutable -> Result<SharedVoronoi> {
        Result<SiteVoronoi> found = find_site_voronoi(sites, made, on_progress, call->token());
        if (!found) return found.error();
        return std::make_shared<SiteVoronoiHandle>(SiteVoronoiHandle{std::move(sites), std::move(found).value()});
      },
      progress));
}

std::array<std::int64_t, 4> site_numbers(const SitePoint& point) {
  std::array<std::int64_t, 4> sites = {};
  for (std::size_t k = 0; k < 4; ++k) {
    sites[k] = point.sites[k] == SitePoint::kNoSite ? -1 : std::int64_t{point.sites[k]};
  }
  return sites;
}

/// The nearest points of its sites one after the other; no numbers beyond those.
std::array<double, 12> contacts_in_row(const SitePoint& point) {
  std::array<double, 12> row;
  row.fill(std::numeric_limits<double>::quiet_NaN());
  for (std::size_t s = 0; s < point.count; ++s) {
    for (std::size_t k = 0; k < 3; ++k) row[3 * s + k] = point.contacts[s][k];
  }
  return row;
}

py::dict surface_points(const std::vector<SitePoint>& points) {
  py::dict out;
  out["positions"] = column(points, [](const SitePoint& at) { return at.point; });
  out["distances"] = column(points, [](const SitePoint& at) { return at.distance; });
  out["errors"] = column(points, [](const SitePoint& at) { return at.error; });
  out["object_angles"] = column(points, [](const SitePoint& at) { return at.object_angle; });
  out["counts"] = column(points, [](const SitePoint& at) { return at.count; });
  out["sites"] = column(points, &site_numbers);
  out["contacts"] = column(points, &contacts_in_row);
  out["voxels"] = column(points, [](const SitePoint& at) { return at.voxel; });
  return out;
}

py::dict surface_results(const SiteVoronoiHandle& handle) {
  using Triple = std::array<std::uint32_t, 3>;
  const SiteVoronoi& voronoi = handle.voronoi;
  py::dict grid, faces, pieces;
  grid["origin"] = array_of(voronoi.grid.origin);
  grid["voxel_size"] = voronoi.grid.side;
  grid["size"] = py::make_tuple(voronoi.grid.size[0], voronoi.grid.size[1], voronoi.grid.size[2]);
  faces["corners"] = column(voronoi.faces, [](const SiteFace& face) { return face.corners; });
  faces["sites"] = column(voronoi.faces, [](const SiteFace& face) { return face.sites; });
  faces["pieces"] = column(voronoi.faces, [](const SiteFace& face) { return face.piece; });
  pieces["sites"] = column(voronoi.pieces, [](const SitePiece& piece) { return piece.sites; });
  pieces["faces"] = column(voronoi.pieces, [](const SitePiece& piece) { return piece.faces; });
  pieces["areas"] = column(voronoi.pieces, [](const SitePiece& piece) { return piece.area; });
  pieces["least_clearances"] = column(voronoi.pieces, [](const SitePiece& piece) { return piece.least_clearance; });
  pieces["greatest_clearances"] =
      column(voronoi.pieces, [](const SitePiece& piece) { return piece.greatest_clearance; });
  py::dict out;
  out["grid"] = std::move(grid);
  out["points"] = surface_points(voronoi.points);
  out["faces"] = std::move(faces);
  out["pieces"] = std::move(pieces);
  out["undecided"] = array_of(std::vector<Triple>(voronoi.undecided));
  out["tied"] = array_of(std::vector<Triple>(voronoi.tied));
  out["overlapping"] = array_of(std::vector<Triple>(voronoi.overlapping));
  out["overlaps"] = array_of(std::vector<std::array<std::uint32_t, 2>>(voronoi.overlaps));
  out["cells"] = voronoi.cells;
  return out;
}

std::shared_ptr<SiteRoadmapHandle> make_roadmap(const SharedVoronoi& handle, unsigned threads,
                                                const py::object& progress) {
  const CallWithProgress reported(progress);
  const ProgressCallback on_progress = reported.of_stage("roadmap");
  const auto call = reported.call;
  return std::make_shared<SiteRoadmapHandle>(SiteRoadmapHandle{value_of(run(
      call,
      [handle, threads, on_progress, call] {
        return SiteRoadmap::build(handle->sites, handle->voronoi, {.threads = threads}, on_progress, call->token());
      },
      progress))});
}

py::dict roadmap_links(const SiteRoadmapHandle& handle) {
  const std::vector<RoadmapLink>& links = handle.roadmap.links();
  py::dict out;
  out["points"] = column(links, [](const RoadmapLink& link) { return link.points; });
  out["lengths"] = column(links, [](const RoadmapLink& link) { return link.length; });
  out["widths"] = column(links, [](const RoadmapLink& link) { return link.width; });
  out["component_of_point"] = array_of(std::vector<std::uint32_t>(handle.roadmap.component_of_point()));
  out["components"] = handle.roadmap.components();
  return out;
}

py::object widest_path(const std::shared_ptr<SiteRoadmapHandle>& handle, py::handle from_array, py::handle to_array) {
  const Point from = point_of(from_array, "start"), to = point_of(to_array, "end");
  const std::optional<SitePath> path =
      value_of(run([handle, from, to] { return handle->roadmap.widest_path(from, to); }));
  if (!path) return py::none();
  py::dict out;
  out["line"] = array_of(std::vector<Point>(path->line));
  out["points"] = column(path->points, [](std::uint32_t point) {
    return point == SitePath::kNoPoint ? std::int64_t{-1} : std::int64_t{point};
  });
  out["width"] = path->width;
  out["length"] = path->length;
  return out;
}

}  // namespace

void bind_sites(py::module_& module) {
  py::class_<SiteVoronoiHandle, SharedVoronoi>(module, "SiteVoronoi")
      .def("results", &surface_results)
      .def("roadmap", &make_roadmap);
  py::class_<SiteRoadmapHandle, std::shared_ptr<SiteRoadmapHandle>>(module, "SiteRoadmap")
      .def("links", &roadmap_links)
      .def("widest_path", &widest_path);
  module.def("find_site_voronoi", &surface_between);
}

}  // namespace medial_vk::python
