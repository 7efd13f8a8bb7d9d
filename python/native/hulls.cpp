#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "medial_vk/hull_fits.h"
#include "medial_vk/hull_proofs.h"
#include "medial_vk/hull_union.h"
#include "native/arrays.h"
#include "native/calls.h"
#include "native/handles.h"
#include "native/options.h"
#include "native/sphere_dicts.h"

namespace medial_vk::python {
namespace {

namespace py = pybind11;

/// Rows of three balls, of which the first counts[i] make hull i: centres of shape (3 n, 3), radii of shape (3 n,).
/// Error: kUsage.
std::vector<BallHull> hulls_of(py::handle centres, py::handle radii, py::handle counts) {
  const std::vector<Ball> balls = balls_of(centres, radii);
  const std::vector<std::uint32_t> sizes = indices_of(counts, "counts");
  if (balls.size() != 3 * sizes.size())
    fail_usage("hulls need centres of shape (n, 3, 3), radii of shape (n, 3) and counts of shape (n,)");
  std::vector<BallHull> hulls(sizes.size());
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    if (sizes[i] < 1 || sizes[i] > 3)
      fail_usage("hull " + std::to_string(i) + " has " + std::to_string(sizes[i]) + " balls, not 1 to 3");
    hulls[i].count = sizes[i];
    std::copy_n(balls.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, hulls[i].corners.begin());
  }
  return hulls;
}

/// Unused corners repeat the last ball, which changes nothing about the hull.
py::dict hulls_dict(std::span<const BallHull> hulls) {
  std::vector<Ball> corners;
  for (const BallHull& hull : hulls) {
    for (std::uint32_t k = 0; k < 3; ++k) corners.push_back(hull.corners[std::min(k, hull.count - 1)]);
  }
  py::dict out = balls_dict(corners);
  out["counts"] = column(hulls, [](const BallHull& hull) { return hull.count; });
  return out;
}

py::dict proof_dict(const HullProof& proof) {
  py::dict out;
  out["tested"] = proof.tested;
  out["failed"] = proof.failed;
  out["first_failure"] = proof.first_failure;
  out["planes"] = proof.planes;
  out["greatest_lack"] = proof.greatest_lack;
  out["proved"] = proof.proved();
  return out;
}

HullFitOptions read_hull_options(Options& options) {
  HullFitOptions made;
  options.read(
      "kind", made.choice,
      std::array{Choice<HullChoice>{"balls", HullChoice::kBalls}, Choice<HullChoice>{"capsules", HullChoice::kCapsules},
                 Choice<HullChoice>{"cones", HullChoice::kCones}, Choice<HullChoice>{"slabs", HullChoice::kSlabs},
                 Choice<HullChoice>{"mix", HullChoice::kMix}});
  options.read("count", made.count);
  options.read("parameters", made.parameters);
  options.read("error", made.error);
  options.read("max_gap", made.max_gap);
  options.read("width", made.width);
  options.read("resolution", made.resolution);
  options.read("threads", made.threads);
  return made;
}

py::dict fit(const MeshHandle& mesh, const ContextHandle& context, py::dict values, const py::object& progress) {
  Options given(std::move(values));
  const HullFitOptions options = read_hull_options(given);
  given.finish();
  const CallWithProgress reported(progress);
  const StageProgress on_progress = reported.stages();
  const auto call = reported.call;
  const HullFit made = value_of(run(
      call,
      [mesh = mesh.mesh, context, options, on_progress, call] {
        return context->use(call->token(), [&](Context& device) {
          return fit_hulls(mesh, options, device, on_progress, call->token());
        });
      },
      progress));
  py::dict out;
  out["hulls"] = hulls_dict(made.hulls);
  out["proof"] = proof_dict(made.proof);
  out["covered"] = bounds_tuple(made.covered);
  out["gap"] = bounds_tuple(made.gap);
  out["left_out"] = made.left_out;
  out["greatest_shrink"] = made.greatest_shrink;
  out["solid_volume"] = made.solid_volume ? py::object(py::float_(*made.solid_volume)) : py::object(py::none());
  return out;
}

py::dict prove(const MeshHandle& mesh, py::handle centres, py::handle radii, py::handle counts, unsigned threads) {
  const std::vector<BallHull> hulls = hulls_of(centres, radii, counts);
  const auto call = std::make_shared<Call>();
  return proof_dict(value_of(run(call, [mesh = mesh.mesh, hulls, threads, call] {
    return prove_hulls(mesh, hulls, {.threads = threads}, call->token());
  })));
}

py::tuple measure_union(py::handle centres, py::handle radii, py::handle counts, double width, unsigned threads) {
  const std::vector<BallHull> hulls = hulls_of(centres, radii, counts);
  const auto call = std::make_shared<Call>();
  return bounds_tuple(value_of(run(call, [hulls, width, threads, call] {
    return measure_hull_union(hulls, {.width = width, .threads = threads}, call->token());
  })));
}

/// Of each point to the nearest hull.
py::array_t<double> distances(py::handle centres, py::handle radii, py::handle counts, py::handle points) {
  const std::vector<BallHull> hulls = hulls_of(centres, radii, counts);
  const std::vector<Point> places = points_of(points, "points");
  const auto call = std::make_shared<Call>();
  return array_of(value_of(run(call, [hulls, places, call]() -> Result<std::vector<double>> {
    std::vector<double> least(places.size(), std::numeric_limits<double>::infinity());
    for (const BallHull& hull : hulls) {
      if (call->token().stop_requested()) return Error{ErrorCode::kInterrupted, "interrupted"};
      for (std::size_t i = 0; i < places.size(); ++i) least[i] = std::min(least[i], signed_distance(hull, places[i]));
    }
    return least;
  })));
}

}  // namespace

void bind_hulls(py::module_& module) {
  module.def("fit_hulls", &fit);
  module.def("prove_hulls", &prove);
  module.def("measure_hull_union", &measure_union);
  module.def("hull_distances", &distances);
}

}  // namespace medial_vk::python
