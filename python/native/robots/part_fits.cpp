// Fits of the parts of an assembly.
#include "medial_vk/part_fits.h"

#include <pybind11/stl.h>

#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"
#include "native/sphere_dicts.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

Part part_of(py::dict values) {
  Part part;
  Options options(std::move(values));
  const auto object = [&options](const char* name) {
    py::object value;
    options.read(name, value);
    return value;
  };
  options.read("link", part.link);
  options.read("name", part.name);
  if (const py::object pose = object("pose"); !pose.is_none()) {
    const std::vector<Pose> poses = poses_of(pose, "pose");
    if (poses.size() != 1) fail_usage("one pose for each part is expected");
    part.pose = poses.front();
  }
  if (const py::object mesh = object("mesh"); !mesh.is_none()) part.mesh = mesh.cast<const MeshHandle&>().mesh;
  const py::object centre = object("centre"), radius = object("radius");
  if (!radius.is_none()) part.ball = Ball{point_of(centre, "ball"), radius.cast<double>()};
  if (const py::object volume = object("volume"); !volume.is_none()) part.volume = volume.cast<double>();
  options.finish();
  return part;
}

py::object number_or_none(const std::optional<double>& number) {
  return number ? py::object(py::float_(*number)) : py::object(py::none());
}

py::dict part_fit_dict(const PartFit& fit, bool balls_only) {
  py::dict out;
  add_levels(fit.levels, fit.reach, out);
  out["count"] = fit.count;
  out["aim"] = aim_name(fit.aim);
  out["solid_volume"] = number_or_none(fit.solid_volume);
  out["of_shape"] = fit.of_shape;
  out["spheres_volume"] = number_or_none(fit.spheres_volume);
  out["measures"] = fit.measures ? py::object(measures_dict(*fit.measures, balls_only)) : py::object(py::none());
  out["proved"] = balls_dict(fit.proved);
  out["seconds"] = fit.measurements.seconds;
  return out;
}

py::list fit_all(const py::list& given, const ContextHandle& context, py::dict values, const py::object& progress) {
  std::vector<Part> parts;
  parts.reserve(given.size());
  for (const py::handle part : given) parts.push_back(part_of(part.cast<py::dict>()));
  PartFitOptions made;
  Options options(std::move(values));
  options.read("count_per_link", made.count_per_link);
  options.read("total", made.total);
  made.spheres = read_fit_options(options);
  options.finish();
  made.threads = made.spheres.threads;
  const CallWithProgress reported(progress);
  const StageProgress on_progress = reported.stages();
  const auto call = reported.call;
  const std::vector<PartFit> fits = value_of(run(
      call,
      [parts = std::move(parts), context, made, on_progress, call] {
        return context->use(
            call->token(), [&](Context& device) { return fit_parts(parts, made, device, on_progress, call->token()); });
      },
      progress));
  py::list out;
  for (const PartFit& fit : fits) out.append(part_fit_dict(fit, made.spheres.balls_only));
  return out;
}

}  // namespace

void bind_part_fits(py::module_& module) { module.def("fit_parts", &fit_all); }

}  // namespace medial_vk::python
