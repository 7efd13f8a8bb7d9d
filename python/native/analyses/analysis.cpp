#include "medial_vk/analysis.h"

#include <pybind11/stl.h>

#include "medial_vk/fatness.h"
#include "medial_vk/version.h"
#include "native/analyses/analysis_handle.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/medial_dicts.h"
#include "native/options.h"
#include "output/medial_ply/medial_file.h"
#include "output/page/page.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

void read_sheet_options(Options& options, AnalysisOptions& made) {
  bool sheets = true;
  options.read("sheets", sheets);
  SheetOptions of_sheets;
  options.read("sheet_angle", of_sheets.angle);
  options.read("sheet_crease", of_sheets.crease);
  options.read("sheet_border", of_sheets.border);
  options.read("sheet_width", of_sheets.width);
  options.read("absorb_fragments", of_sheets.absorb_fragments);
  if (sheets) made.sheets = of_sheets;
}

AnalysisOptions analysis_options(py::dict values) {
  AnalysisOptions made;
  Options options(std::move(values));
  ExtractionOptions& search = made.extraction;
  options.read("mode", search.mode,
               std::array{Choice<Mode>{"certified", Mode::kCertified}, Choice<Mode>{"thesis", Mode::kThesis}});
  options.read("resolution", search.resolution);
  options.read("object_angle", search.object_angle);
  options.read("radius", search.radius);
  options.read("deep_angle", search.deep_angle);
  options.read("epsilon", search.epsilon);
  options.read("extra_levels", search.extra_levels);
  options.read("memory_budget", search.memory_budget);
  read_sheet_options(options, made);
  options.read("simplify", made.simplify);
  options.read("volumes", made.volumes);
  options.read("keep_volume", made.keep_volume);
  options.read("keep_topology", made.keep_topology);
  options.read("removal_orders", made.removal_orders);
  options.read("medial_mesh", made.medial_mesh);
  options.read("threads", made.threads);
  options.finish();
  if (made.sheets && !(made.volumes || made.keep_volume > 0 || made.removal_orders)) made.sheets->areas = false;
  return made;
}

std::shared_ptr<AnalysisHandle> analyse_mesh(const MeshHandle& mesh, const ContextHandle& context, py::dict values,
                                             const py::object& progress) {
  const AnalysisOptions options = analysis_options(std::move(values));
  const CallWithProgress reported(progress);
  const StageProgress on_progress = reported.stages();
  const auto call = reported.call;
  Analysis result = value_of(run(
      call,
      [mesh = mesh.mesh, context, options, on_progress, call] {
        return context->use(
            call->token(), [&](Context& device) { return analyse(mesh, options, device, on_progress, call->token()); });
      },
      progress));
  return std::make_shared<AnalysisHandle>(AnalysisHandle{mesh.mesh, options, context->device(), std::move(result)});
}

py::dict betti_dict(const BettiNumbers& betti) {
  py::dict out;
  out["components"] = betti.components;
  out["tunnels"] = betti.tunnels;
  out["cavities"] = betti.cavities;
  return out;
}

py::object significance_dict(const std::optional<Significance>& significance) {
  if (!significance) return py::none();
  py::dict out;
  out["volume"] = significance->volume;
  out["area"] = significance->area;
  out["topology"] = betti_dict(significance->topology);
  out["of_component"] = array_of(std::vector<double>(significance->of_component));
  out["of_ball"] = array_of(std::vector<double>(significance->of_ball));
  out["of_sheet"] = array_of(std::vector<double>(significance->of_sheet));
  out["areas"] = array_of(std::vector<double>(significance->areas));
  return out;
}

py::object removal_dict(const std::optional<SheetRemoval>& removal) {
  if (!removal) return py::none();
  py::dict out;
  out["removed"] = array_of(std::vector<std::uint32_t>(removal->sheets));
  out["volume_left"] = array_of(std::vector<double>(removal->volume_left));
  out["kept"] = array_of(std::vector<std::uint32_t>(removal->kept));
  return out;
}

py::object medial_mesh_dict(const std::optional<MedialMesh>& mesh) {
  if (!mesh) return py::none();
  py::dict out;
  out["triangles"] = array_of(std::vector<Triangle>(mesh->triangles));
  out["edges"] = array_of(std::vector<MeshEdge>(mesh->edges));
  out["topology"] = betti_dict(mesh->topology.betti);
  out["euler_characteristic"] = mesh->topology.euler_characteristic;
  out["boundary_edges"] = mesh->topology.boundary_edges;
  out["non_manifold_edges"] = mesh->topology.non_manifold_edges;
  out["bare_edges"] = mesh->topology.bare_edges;
  out["hosted_points"] = mesh->topology.hosted_points;
  return out;
}

py::dict results(const AnalysisHandle& handle) {
  const Analysis& result = handle.result;
  py::dict times;
  for (const StageTime& time : result.measurements.host_times) times[py::str(time.stage)] = time.seconds;
  py::dict out;
  out["grid"] = grid_dict(result.grid);
  out["spheres"] = spheres_dict(result.spheres);
  out["undecided"] = undecided_dict(result.undecided);
  out["certificate"] = py::make_tuple(result.certificate.passed, result.certificate.rejected);
  out["simplified"] = result.simplified;
  out["sheets"] = sheets_dict(result.sheets);
  out["significance"] = significance_dict(result.significance);
  out["by_significance"] = removal_dict(result.by_significance);
  out["keeping_topology"] = removal_dict(result.keeping_topology);
  out["removal"] = removal_dict(result.removal);
  out["medial_mesh"] = medial_mesh_dict(result.medial_mesh);
  out["euler_characteristic"] =
      result.euler_characteristic ? py::object(py::int_(*result.euler_characteristic)) : py::object(py::none());
  out["seconds"] = std::move(times);
  return out;
}

MedialHeader header_of(const AnalysisHandle& handle) {
  MedialHeader header = make_header(handle.result.grid, handle.options.extraction, handle.mesh.longest_side());
  if (handle.mesh.side() == MeshSide::kOutside) header.inside_count = 0;
  return header;
}

py::bytes encode(const std::shared_ptr<AnalysisHandle>& handle, const std::string& format, bool ascii) {
  return py::bytes(value_of(run([handle, format, ascii]() -> Result<std::string> {
    const std::vector<MedialSphere>& spheres = handle->result.spheres;
    return format == "csv" ? encode_csv(header_of(*handle), spheres) : encode_ply(header_of(*handle), spheres, ascii);
  })));
}

/// What files of the tool say of the search, by their names there.
py::dict header_dict(const AnalysisHandle& handle) {
  const MedialHeader header = header_of(handle);
  py::dict out;
  out["version"] = header.version;
  out["epsilon"] = header.epsilon;
  out["object_angle_threshold"] = header.object_angle;
  out["radius_threshold"] = header.radius_threshold;
  return out;
}

RunRecord record_of(const AnalysisHandle& handle, const std::string& name) {
  const Analysis& result = handle.result;
  RunRecord record;
  record.input = name;
  record.options = handle.options.extraction;
  record.simplify = handle.options.simplify;
  record.mesh = handle.mesh.prepared().report;
  record.longest_side = handle.mesh.longest_side();
  record.search.lower = handle.mesh.region_lower();
  record.search.upper = handle.mesh.region_upper();
  record.search.longest_side = handle.mesh.longest_side();
  record.search.inside = handle.mesh.side() == MeshSide::kInside;
  record.search.outside = !record.search.inside;
  record.search.margin = handle.mesh.margin();
  record.search.inside_points = record.search.inside ? result.spheres.size() : 0;
  record_analysis(result, record);
  if (handle.options.sheets) record.sheet_options = *handle.options.sheets;
  if (record.search.inside && result.sheets) record.search.inside_sheets = result.sheets->sheets.size();
  if (result.significance) record.ball_union = record_union(*result.significance);
  record.keep_topology = handle.options.keep_volume > 0 && handle.options.keep_topology;
  if (result.medial_mesh) record.medial_mesh = result.medial_mesh->topology;
  record.euler_characteristic = result.euler_characteristic;
  record.keep_volume = handle.options.keep_volume;
  record.device = handle.device;
  return record;
}

py::bytes page(const std::shared_ptr<AnalysisHandle>& handle, const std::string& name, py::dict values) {
  require(check_page_available());
  UpAxis up = UpAxis::kY;
  Options options(std::move(values));
  options.read("up", up,
               std::array{Choice<UpAxis>{"x", UpAxis::kX}, Choice<UpAxis>{"y", UpAxis::kY},
                          Choice<UpAxis>{"z", UpAxis::kZ}, Choice<UpAxis>{"-x", UpAxis::kMinusX},
                          Choice<UpAxis>{"-y", UpAxis::kMinusY}, Choice<UpAxis>{"-z", UpAxis::kMinusZ}});
  options.finish();
  return py::bytes(value_of(run([handle, name, up]() -> Result<std::string> {
    RunRecord record = record_of(*handle, name);
    if (record.search.inside) {
      Status status = record_fatness(handle->result.spheres, handle->options.threads, record);
      if (!status) return status.error();
    }
    return encode_page(handle->mesh.prepared().mesh, handle->result.spheres, record, up);
  })));
}

py::bytes state_of(const std::shared_ptr<AnalysisHandle>& handle) {
  return py::bytes(value_of(run([handle]() -> Result<std::string> { return encode_analysis(*handle); })));
}

std::shared_ptr<AnalysisHandle> restored(const MeshHandle& mesh, const std::string& state) {
  return value_of(run([mesh = mesh.mesh, state] { return decode_analysis(mesh, state); }));
}

py::dict fatness(const std::shared_ptr<AnalysisHandle>& handle, py::handle array, unsigned threads) {
  const std::vector<double> angles = numbers_of(array, "object_angles");
  const std::vector<Fatness> found = value_of(run([handle, angles, threads] {
    return measure_fatness(handle->result.spheres, handle->result.grid, angles, {.threads = threads});
  }));
  py::dict out;
  out["object_angles"] = column(found, [](const Fatness& at) { return at.object_angle; });
  out["spheres"] = column(found, [](const Fatness& at) { return at.spheres; });
  out["least_radii"] = column(found, [](const Fatness& at) { return at.least_radius; });
  out["largest_voxels"] = column(found, [](const Fatness& at) { return at.largest_voxel; });
  out["components"] = column(found, [](const Fatness& at) { return at.components; });
  out["proves_connected"] =
      column(found, [](const Fatness& at) { return static_cast<std::uint8_t>(at.proves_connected); });
  return out;
}

}  // namespace

void bind_analysis(py::module_& module) {
  py::class_<AnalysisHandle, std::shared_ptr<AnalysisHandle>>(module, "Analysis")
      .def("results", &results)
      .def("encode", &encode)
      .def("header", &header_dict)
      .def("fatness", &fatness)
      .def("page", &page)
      .def("state", &state_of);
  module.def("analyse", &analyse_mesh);
  module.def("restore_analysis", &restored);
}

}  // namespace medial_vk::python
