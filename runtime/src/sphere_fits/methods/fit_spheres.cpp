// Balls for one solid: approximated, proved, measured.
#include "medial_vk/sphere_fits.h"

#include <utility>

#include "base/host_memory.h"
#include "sphere_fits/methods/approximate.h"
#include "sphere_fits/methods/by_distance.h"
#include "sphere_fits/methods/fit_steps.h"
#include "sphere_fits/methods/prefixes.h"

namespace medial_vk {
namespace {

Result<SphereFit> fit(const Solid& solid, SphereFitOptions options, const Extractor& extractor,
                      const SphereProgress& progress) {
  options.aim = aim_for(solid, options);
  Result<std::vector<SphereSet>> sets = options.levels ? approximate_in_levels(solid, options, extractor, progress)
                                                       : approximate_once(solid, options, extractor, progress);
  if (!sets) return sets.error();
  return finish_fit(solid, std::move(sets).value(), options, progress);
}

/// Method source may have no set of so few balls; a larger set also contains the curve.
Result<SphereSet> inside_of_at_least(const Solid& solid, SphereFitOptions options, const Extractor& extractor,
                                     const SphereProgress& progress) {
  options.contract = SphereContract::kInside;
  options.error = options.max_gap = options.max_reach = options.max_distance = 0;
  options.aim = SphereAim::kVolume;
  Result<SphereSet> set = approximate_by_spheres(solid, options, extractor, progress);
  for (int tries = 0; !set && set.error().code == ErrorCode::kUsage && tries < 6; ++tries) {
    options.count *= 2;
    set = approximate_by_spheres(solid, options, extractor, progress);
  }
  return set;
}

Result<CoverageCurve> curve_of(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
                               const SphereProgress& progress) {
  Result<SphereSet> set = inside_of_at_least(solid, options, extractor, progress);
  if (!set) return set.error();
  CoverageCurve out;
  if (solid.has_volume()) out.solid_volume = solid.volume();
  out.ends = options.method == SphereMethod::kBest && set.value().balls.size() < options.count;
  out.covered = std::move(set.value().volumes);  // from method best; other sets are measured by prefixes
  if (!out.covered.empty()) return out;
  Result<std::vector<double>> volumes = prefix_volumes(set.value().balls, options.threads);
  if (!volumes) return volumes.error();
  out.covered = std::move(volumes).value();
  return out;
}

/// Converts exceptions to errors.
template <class Work>
auto with_solid(const IndexedMesh& mesh, const SphereFitOptions& options, const StageProgress& progress,
                const std::stop_token& stop, const Work& work)
    -> decltype(work(std::declval<const Solid&>(), SphereProgress())) {
  try {
    const Result<Solid> solid = Solid::build(mesh);
    if (!solid) return solid.error();
    return work(solid.value(), progress_of_fit(options, progress, stop));
  } catch (const std::bad_alloc&) {
    return out_of_memory("fitting spheres", "try a lower `count`");
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, std::string("internal error: ") + error.what()};
  }
}

}  // namespace

Result<SphereFit> fit_spheres(const IndexedMesh& mesh, const SphereFitOptions& options, const Extractor& extractor,
                              const StageProgress& progress, const std::stop_token& stop) {
  return with_solid(mesh, options, progress, stop, [&](const Solid& solid, const SphereProgress& on_progress) {
    return fit(solid, options, stopped_by(extractor, stop), on_progress);
  });
}

Result<SphereFit> fit_spheres(const IndexedMesh& mesh, const SphereFitOptions& options, Context& context,
                              const StageProgress& progress, const std::stop_token& stop) {
  return fit_spheres(mesh, options, device_extractor(context), progress, stop);
}

Result<CoverageCurve> measure_coverage_curve(const IndexedMesh& mesh, const SphereFitOptions& options,
                                             const Extractor& extractor, const StageProgress& progress,
                                             const std::stop_token& stop) {
  SphereFitOptions of_balls_inside = options;
  of_balls_inside.contract = SphereContract::kInside;
  return with_solid(mesh, of_balls_inside, progress, stop, [&](const Solid& solid, const SphereProgress& on_progress) {
    return curve_of(solid, of_balls_inside, stopped_by(extractor, stop), on_progress);
  });
}

Result<CoverageCurve> measure_coverage_curve(const IndexedMesh& mesh, const SphereFitOptions& options, Context& context,
                                             const StageProgress& progress, const std::stop_token& stop) {
  return measure_coverage_curve(mesh, options, device_extractor(context), progress, stop);
}

}  // namespace medial_vk
