#include <pybind11/stl.h>

#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "medial_vk/sphere_proofs.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"
#include "sphere_fits/quality/surface_samples.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// Fewer points are queried on the calling thread.
constexpr std::size_t kFewPoints = 32;

MeshHandle indexed(Mesh mesh, const PrepareOptions& options) {
  return value_of(run([mesh = std::move(mesh), options]() mutable -> Result<MeshHandle> {
    Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh), options);
    if (!prepared) return prepared.error();
    Result<IndexedMesh> made = IndexedMesh::build(std::move(prepared).value(), {.threads = options.threads});
    if (!made) return made.error();
    return MeshHandle{std::move(made).value()};
  }));
}

PrepareOptions prepare_options(py::dict values) {
  PrepareOptions made;
  Options options(std::move(values));
  options.read("keep_inner_faces", made.keep_inner_faces);
  options.read("keep_outer_faces", made.keep_outer_faces);
  options.read("threads", made.threads);
  options.finish();
  return made;
}

MeshHandle make_mesh(py::handle vertices, py::handle triangles, py::dict options) {
  Mesh mesh;
  mesh.vertices = points_of(vertices, "vertices");
  mesh.triangles = triangles_of(triangles, "triangles");
  return indexed(std::move(mesh), prepare_options(std::move(options)));
}

MeshHandle read_file(const std::string& path, py::dict options) {
  const PrepareOptions prepare = prepare_options(std::move(options));
  Mesh mesh = value_of(run([path] { return read_mesh(path); }));
  return indexed(std::move(mesh), prepare);
}

/// visit(name, field) for all fields of a report but its box.
template <class Report, class Visit>
void each_field(Report& report, const Visit& visit) {
  visit("vertices", report.vertices);
  visit("triangles", report.triangles);
  visit("merged_vertices", report.merged_vertices);
  visit("unused_vertices", report.unused_vertices);
  visit("fallback_polygons", report.fallback_polygons);
  visit("degenerates_dropped", report.degenerates_dropped);
  visit("caps_repaired", report.caps_repaired);
  visit("duplicates_dropped", report.duplicates_dropped);
  visit("inner_walls_dropped", report.inner_walls_dropped);
  visit("open_edges", report.open_edges);
  visit("non_manifold_edges", report.non_manifold_edges);
  visit("inconsistent_edges", report.inconsistent_edges);
  visit("non_manifold_vertices", report.non_manifold_vertices);
  visit("components", report.components);
  visit("reoriented_faces", report.reoriented_faces);
  visit("minority_faces", report.minority_faces);
  visit("reoriented_components", report.reoriented_components);
  visit("inside_out", report.inside_out);
  visit("intersecting_faces", report.intersecting_faces);
  visit("intersections_known", report.intersections_known);
  visit("cut_faces", report.cut_faces);
  visit("inner_faces", report.inner_faces);
  visit("outer_faces", report.outer_faces);
  visit("hidden_open_edges", report.hidden_open_edges);
  visit("closed", report.closed);
  visit("faces_within", report.faces_within);
  visit("faces_without", report.faces_without);
  visit("sides_known", report.sides_known);
  visit("trusted_triangles", report.trusted_triangles);
  visit("signed_volume", report.signed_volume);
  visit("assumptions", report.assumptions);
}

py::dict report_dict(const MeshReport& report) {
  py::dict out;
  each_field(report, [&out](const char* name, const auto& field) { out[name] = field; });
  out["lower"] = array_of(report.lower);
  out["upper"] = array_of(report.upper);
  return out;
}

/// All that a mesh is made of, the triangles as those of the inside: for pickling, and read by restored().
py::dict state_of(const MeshHandle& handle) {
  const PreparedMesh& prepared = handle.mesh.prepared();
  std::vector<Triangle> triangles = prepared.mesh.triangles;
  const bool is_outside = handle.mesh.side() == MeshSide::kOutside;
  if (is_outside) {
    for (Triangle& triangle : triangles) std::swap(triangle[1], triangle[2]);  // as on_side() turns them over
  }
  py::dict out;
  out["vertices"] = array_of(std::vector<Point>(prepared.mesh.vertices));
  out["triangles"] = array_of(std::move(triangles));
  out["flags"] = array_of(std::vector<std::uint8_t>(prepared.flags));
  out["vertex_of_input"] = array_of(std::vector<std::uint32_t>(prepared.vertex_of_input));
  out["input_of_triangle"] = array_of(std::vector<std::uint32_t>(prepared.input_of_triangle));
  each_field(prepared.report,
             [&out](const char* name, const auto& field) { out[(std::string("report_") + name).c_str()] = field; });
  out["side"] = handle.side ? (is_outside ? "outside" : "inside") : "";
  out["margin"] = handle.side ? handle.side->margin : 0.0;
  return out;
}

std::vector<std::uint8_t> flags_of(py::handle array) {
  std::vector<std::uint8_t> flags;
  for (const std::uint32_t flag : indices_of(array, "flags")) flags.push_back(static_cast<std::uint8_t>(flag));
  return flags;
}

/// Error: kUsage (not what state_of() gives), and those of a mesh.
MeshHandle restored(const py::dict& state) {
  PreparedMesh prepared;
  std::string side;
  SideOptions on_side;
  Options options(state.attr("copy")());
  const auto array = [&options](const char* name) {
    py::object value;
    options.read(name, value);
    return value;
  };
  prepared.mesh.vertices = points_of(array("vertices"), "vertices");
  prepared.mesh.triangles = triangles_of(array("triangles"), "triangles");
  prepared.flags = flags_of(array("flags"));
  prepared.vertex_of_input = indices_of(array("vertex_of_input"), "vertex_of_input");
  prepared.input_of_triangle = indices_of(array("input_of_triangle"), "input_of_triangle");
  each_field(prepared.report, [&options](const char* name, auto& field) {
    options.read((std::string("report_") + name).c_str(), field);
  });
  options.read("side", side);
  options.read("margin", on_side.margin);
  options.finish();
  on_side.side = side == "outside" ? MeshSide::kOutside : MeshSide::kInside;
  return value_of(
      run([prepared = std::move(prepared), is_plain = side.empty(), on_side]() mutable -> Result<MeshHandle> {
        Result<IndexedMesh> made = IndexedMesh::build(std::move(prepared));
        if (!made) return made.error();
        if (is_plain) return MeshHandle{std::move(made).value()};
        Result<IndexedMesh> turned = made.value().on_side(on_side);
        if (!turned) return turned.error();
        return MeshHandle{std::move(turned).value(), on_side};
      }));
}

/// A view of rows in the memory of a mesh, which it keeps alive and nobody can write to.
template <class T, std::size_t n>
py::array_t<T> rows_of(const MeshHandle& handle, std::span<const std::array<T, n>> rows) {
  auto* kept = new IndexedMesh(handle.mesh);
  const py::capsule owner(kept, [](void* pointer) { delete static_cast<IndexedMesh*>(pointer); });
  const std::array<py::ssize_t, 2> shape = {static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(n)};
  py::array_t<T> array(shape, rows.empty() ? nullptr : rows.front().data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

MeshHandle on_side(const MeshHandle& handle, py::dict values) {
  SideOptions made;
  Options options(std::move(values));
  options.read(
      "side", made.side,
      std::array{Choice<MeshSide>{"inside", MeshSide::kInside}, Choice<MeshSide>{"outside", MeshSide::kOutside}});
  options.read("margin", made.margin);
  options.read("threads", made.threads);
  options.finish();
  return {value_of(run([mesh = handle.mesh, made] { return mesh.on_side(made); })), made};
}

MeshHandle moved(const MeshHandle& handle, py::handle vertices) {
  const IndexedMesh made =
      value_of(run([mesh = handle.mesh, points = points_of(vertices, "vertices")]() mutable -> Result<IndexedMesh> {
        Status status = mesh.move_vertices(points);
        if (!status) return status.error();
        return mesh;
      }));
  return {made, handle.side};
}

/// Beyond this size squares of coordinates could overflow.
constexpr double kFarthest = 1e150;

Result<std::vector<BvhHit>> find_closest(const Bvh& tree, const std::vector<Point>& points,
                                         const std::stop_token& stop) {
  std::vector<BvhHit> hits(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (stop.stop_requested()) return Error{ErrorCode::kInterrupted, "stopped"};
    const Point& p = points[i];
    if (!(std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]) <= kFarthest)) {
      return Error{ErrorCode::kUsage, "row " + std::to_string(i) + " of `points` is not finite, or beyond 1e150"};
    }
    hits[i] = tree.closest(p);
  }
  return hits;
}

py::dict closest_points(const MeshHandle& handle, py::handle array) {
  std::vector<Point> points = points_of(array, "points");
  const bool is_short = points.size() <= kFewPoints;
  const auto call = std::make_shared<Call>();
  const std::vector<BvhHit> hits =
      value_of(run_unless_short(is_short, call, [mesh = handle.mesh, points = std::move(points), call] {
        return find_closest(mesh.bvh(), points, call->token());
      }));
  py::dict out;
  out["points"] = column(hits, [](const BvhHit& hit) { return hit.point; });
  out["distances"] = column(hits, [](const BvhHit& hit) { return std::sqrt(hit.squared_distance); });
  out["triangles"] = column(hits, [](const BvhHit& hit) { return hit.triangle; });
  return out;
}

py::array_t<double> depths(const MeshHandle& handle, py::handle array, unsigned threads) {
  std::vector<Point> points = points_of(array, "points");
  const bool is_short = points.size() <= kFewPoints;
  const auto call = std::make_shared<Call>();
  const auto work = [mesh = handle.mesh, points = std::move(points), threads, call]() -> Result<std::vector<double>> {
    std::vector<double> depths(points.size());
    Status status = measure_depths(mesh, points, depths, {.threads = threads}, call->token());
    if (!status) return status.error();
    return depths;
  };
  return array_of(value_of(run_unless_short(is_short, call, work)));
}

py::array_t<double> sample(const MeshHandle& handle, std::size_t count) {
  constexpr std::size_t kMostSamples = std::size_t{1} << 31;
  if (count > kMostSamples) fail_usage("`count` is greater than 2^31");
  return array_of(value_of(run([mesh = handle.mesh, count]() -> Result<std::vector<Point>> {
    return sample_surface(mesh.prepared().mesh, count);
  })));
}

}  // namespace

void bind_mesh(py::module_& module) {
  py::class_<MeshHandle>(module, "Mesh")
      .def("vertices", [](const MeshHandle& mesh) { return rows_of(mesh, mesh.mesh.view().vertices); })
      .def("triangles", [](const MeshHandle& mesh) { return rows_of(mesh, mesh.mesh.view().triangles); })
      .def("vertex_of_input",
           [](const MeshHandle& mesh) {
             return column(mesh.mesh.prepared().vertex_of_input, [](std::uint32_t vertex) {
               return vertex == PreparedMesh::kDropped ? std::int64_t{-1} : std::int64_t{vertex};
             });
           })
      .def("triangle_of_input",
           [](const MeshHandle& mesh) {
             return array_of(std::vector<std::uint32_t>(mesh.mesh.prepared().input_of_triangle));
           })
      .def("report", [](const MeshHandle& mesh) { return report_dict(mesh.mesh.prepared().report); })
      .def("longest_side", [](const MeshHandle& mesh) { return mesh.mesh.longest_side(); })
      .def("is_outside", [](const MeshHandle& mesh) { return mesh.mesh.side() == MeshSide::kOutside; })
      .def("region",
           [](const MeshHandle& mesh) {
             return py::make_tuple(array_of(mesh.mesh.region_lower()), array_of(mesh.mesh.region_upper()));
           })
      .def("state", &state_of)
      .def("on_side", &on_side)
      .def("moved", &moved)
      .def("closest_points", &closest_points)
      .def("depths", &depths)
      .def("sample", &sample);
  module.def("make_mesh", &make_mesh);
  module.def("restore_mesh", &restored);
  module.def("read_mesh", &read_file);
}

}  // namespace medial_vk::python
