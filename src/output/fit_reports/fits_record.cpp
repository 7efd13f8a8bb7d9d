#include "output/fit_reports/fits_record.h"

#include <utility>

namespace medial_vk {

const char* name_of(SphereContract contract) {
  constexpr const char* kNames[] = {"inside", "cover", "balanced"};
  return kNames[static_cast<std::size_t>(contract)];
}

const char* name_of(SphereMethod method) { return method == SphereMethod::kBest ? "best" : "source"; }

PartFit fit_of_mesh(SphereFit fit, std::size_t wanted) {
  PartFit out;
  out.proved = fit.levels.back();
  out.levels = std::move(fit.levels);
  out.reach = std::move(fit.reach);
  out.wanted = wanted;
  out.solid_volume = fit.solid_volume;
  out.spheres_volume = fit.measures.volume.balls;
  out.measures = std::move(fit.measures);
  return out;
}

std::size_t count_spheres(const FitsRecord& record) {
  std::size_t count = 0;
  for (const PartFit& fit : record.fits) count += fit.levels.back().size();
  return count;
}

std::optional<double> uncovered_share(const PartFit& fit, SphereContract contract) {
  const bool known = contract == SphereContract::kInside && fit.solid_volume && fit.spheres_volume;
  if (!known || !(*fit.solid_volume > 0)) return std::nullopt;
  return 1 - *fit.spheres_volume / *fit.solid_volume;
}

std::optional<double> uncovered_share(const FitsRecord& record) {
  double solid = 0, spheres = 0;
  for (const PartFit& fit : record.fits) {
    if (!uncovered_share(fit, record.request.contract)) return std::nullopt;
    solid += *fit.solid_volume;
    spheres += *fit.spheres_volume;
  }
  return 1 - spheres / solid;
}

}  // namespace medial_vk
