#include <pybind11/stl.h>

#include "medial_vk/sphere_fits.h"
#include "medial_vk/sphere_proofs.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"
#include "native/sphere_dicts.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

py::dict inside_dict(const InsideProof& proof) {
  py::dict out;
  out["tested"] = proof.tested;
  out["failed"] = proof.failed;
  out["first_failure"] = proof.first_failure;
  out["greatest_excess"] = proof.greatest_excess;
  out["proved"] = proof.proved();
  return out;
}

py::dict cover_dict(const CoverProof& proof) {
  py::dict out;
  out["triangles"] = proof.triangles;
  out["uncovered"] = proof.uncovered;
  out["undecided"] = proof.undecided;
  out["first_uncovered"] = array_of(proof.first_uncovered);
  out["vertices"] = proof.vertices;
  out["inside"] = proof.inside;
  out["first_inside"] = array_of(proof.first_inside);
  out["closed"] = proof.closed;
  out["surface_proved"] = proof.surface_proved();
  out["proved"] = proof.proved();
  return out;
}

}  // namespace

SphereFitOptions read_fit_options(Options& options) {
  SphereFitOptions made;
  options.read("contract", made.contract,
               std::array{Choice<SphereContract>{"inside", SphereContract::kInside},
                          Choice<SphereContract>{"cover", SphereContract::kCover},
                          Choice<SphereContract>{"balanced", SphereContract::kBalanced}});
  options.read("method", made.method,
               std::array{Choice<SphereMethod>{"best", SphereMethod::kBest},
                          Choice<SphereMethod>{"source", SphereMethod::kSource}});
  options.read("count", made.count);
  options.read("error", made.error);
  options.read("max_gap", made.max_gap);
  options.read("max_distance", made.max_distance);
  options.read("max_reach", made.max_reach);
  options.read(
      "aim", made.aim,
      std::array{Choice<SphereAim>{"volume", SphereAim::kVolume}, Choice<SphereAim>{"distance", SphereAim::kDistance},
                 Choice<SphereAim>{"auto", SphereAim::kAuto}});
  options.read("resolution", made.resolution);
  options.read("object_angle", made.object_angle);
  options.read("levels", made.levels);
  options.read("balls_only", made.balls_only);
  options.read("for_distances", made.for_distances);
  options.read("threads", made.threads);
  return made;
}

namespace {

py::dict histogram_dict(const SignedDistances& distances) {
  py::dict out;
  out["lower"] = distances.lower;
  out["upper"] = distances.upper;
  out["shares"] = array_of(std::vector<double>(distances.share));
  out["least"] = distances.least;
  out["greatest"] = distances.greatest;
  out["mean"] = distances.mean;
  out["mean_absolute"] = distances.mean_absolute;
  return out;
}

}  // namespace

py::dict measures_dict(const SphereMeasures& measures, bool balls_only) {
  py::dict volume;
  volume["solid"] = measures.volume.solid;
  volume["balls"] = measures.volume.balls;
  volume["uncovered"] = measures.volume.uncovered;
  volume["outside"] = measures.volume.outside;
  volume["standard_error"] = measures.volume.standard_error;
  volume["normalized"] = measures.volume.normalized();
  volume["normalized_lower_bound"] = measures.volume.normalized_lower_bound();
  py::dict distances;
  distances["solid_to_balls"] = bounds_tuple(measures.distances.solid_to_balls);
  distances["balls_to_solid"] = bounds_tuple(measures.distances.balls_to_solid);
  distances["boundary_to_balls"] = bounds_tuple(measures.distances.boundary_to_balls);
  distances["boundary_to_envelope"] = bounds_tuple(measures.distances.boundary_to_envelope);
  distances["between_sets"] = bounds_tuple(measures.distances.between_sets());
  distances["between_surfaces"] = bounds_tuple(measures.distances.between_surfaces());
  distances["envelope_to_boundary"] = bounds_tuple(measures.distances.envelope_to_boundary);
  py::dict metrics;
  metrics["num_spheres"] = measures.metrics.num_spheres;
  metrics["coverage"] = measures.metrics.coverage;
  metrics["protrusion"] = measures.metrics.protrusion;
  metrics["protrusion_dist_mean"] = measures.metrics.protrusion_dist_mean;
  metrics["protrusion_dist_p95"] = measures.metrics.protrusion_dist_p95;
  metrics["surface_gap_mean"] = measures.metrics.surface_gap_mean;
  metrics["surface_gap_p95"] = measures.metrics.surface_gap_p95;
  metrics["max_uncovered_gap"] = measures.metrics.max_uncovered_gap;
  metrics["volume_ratio"] = measures.metrics.volume_ratio;
  py::dict out;
  out["diagonal"] = balls_only ? py::object(py::none()) : py::object(py::float_(measures.diagonal));
  const py::object none = py::none();
  out["inside"] = measures.inside.tested > 0 ? inside_dict(measures.inside) : none;
  out["cover"] = measures.cover.triangles > 0 ? cover_dict(measures.cover) : none;
  out["volume"] = balls_only ? none : volume;
  out["distances"] = balls_only ? none : distances;
  out["metrics"] = balls_only ? none : metrics;
  out["boundary_to_envelope"] = balls_only ? none : histogram_dict(measures.histograms.boundary_to_envelope);
  out["envelope_to_boundary"] = balls_only ? none : histogram_dict(measures.histograms.envelope_to_boundary);
  return out;
}

const char* aim_name(SphereAim aim) { return aim == SphereAim::kDistance ? "distance" : "volume"; }

void add_levels(const std::vector<std::vector<Ball>>& levels, const std::vector<ReachOut>& reach, py::dict& out) {
  py::list of_levels, of_reach;
  for (const std::vector<Ball>& level : levels) of_levels.append(balls_dict(level));
  for (const ReachOut& at : reach) of_reach.append(py::make_tuple(at.mean, at.least, at.greatest));
  out["levels"] = std::move(of_levels);
  out["reach"] = std::move(of_reach);
}

namespace {

py::dict fit_dict(const SphereFit& fit, bool balls_only) {
  py::dict out;
  add_levels(fit.levels, fit.reach, out);
  out["measures"] = measures_dict(fit.measures, balls_only);
  out["solid_volume"] = fit.solid_volume ? py::object(py::float_(*fit.solid_volume)) : py::object(py::none());
  out["aim"] = aim_name(fit.aim);
  return out;
}

py::dict fit_mesh(const MeshHandle& mesh, const ContextHandle& context, py::dict values, const py::object& progress) {
  Options given(std::move(values));
  const SphereFitOptions options = read_fit_options(given);
  given.finish();
  const CallWithProgress reported(progress);
  const StageProgress on_progress = reported.stages();
  const auto call = reported.call;
  const SphereFit fit = value_of(run(
      call,
      [mesh = mesh.mesh, context, options, on_progress, call] {
        return context->use(call->token(), [&](Context& device) {
          return fit_spheres(mesh, options, device, on_progress, call->token());
        });
      },
      progress));
  return fit_dict(fit, options.balls_only);
}

py::dict prove(const MeshHandle& mesh, py::handle inside_centres, py::handle inside_radii, py::handle cover_centres,
               py::handle cover_radii, unsigned threads) {
  const std::vector<Ball> inside = balls_of(inside_centres, inside_radii);
  const std::vector<Ball> cover = balls_of(cover_centres, cover_radii);
  const auto call = std::make_shared<Call>();
  const SphereProofs proofs = value_of(run(call, [mesh = mesh.mesh, inside, cover, threads, call] {
    return prove_spheres(mesh, inside, cover, {.threads = threads}, call->token());
  }));
  py::dict out;
  out["inside"] = inside.empty() ? py::object(py::none()) : py::object(inside_dict(proofs.inside));
  out["cover"] = cover.empty() ? py::object(py::none()) : py::object(cover_dict(proofs.cover));
  return out;
}

py::tuple gap(const MeshHandle& mesh, py::handle centres, py::handle radii, unsigned threads) {
  const std::vector<Ball> balls = balls_of(centres, radii);
  const auto call = std::make_shared<Call>();
  return bounds_tuple(value_of(run(call, [mesh = mesh.mesh, balls, threads, call] {
    return measure_gap(mesh, balls, {.threads = threads}, call->token());
  })));
}

}  // namespace

void bind_spheres(py::module_& module) {
  module.def("fit_spheres", &fit_mesh);
  module.def("prove_spheres", &prove);
  module.def("measure_gap", &gap);
}

}  // namespace medial_vk::python
