#include "output/fit_reports/fits_record.h"

#include <utility>

namespace medial_vk {

const char* name_of(SphereContract contract) {
  constexpr const char* kNames[] = {"inside", "cover", "balanced"};
  return kNames[static_cast<std::size_t>(contract)];
}

const char* name_of(SphereMethod method) { return method == SphereMethod::kBest ? "best" : "source"; }

const MeshReport& FittedSolid::report() const {
  static const MeshReport kNone;
  return mesh ? mesh->prepared().report : kNone;
}

FittedSolid solid_of(const Part& part, double facet_share) {
  FittedSolid solid;
  solid.link = part.link;
  solid.name = part.name;
  solid.pose = part.pose;
  solid.mesh = part.mesh;
  solid.ball = part.ball;
  solid.facet_share = facet_share;
  return solid;
}

void take_fit(PartFit fit, FittedSolid& solid) {
  solid.count = fit.count;
  solid.levels = std::move(fit.levels);
  solid.reach = std::move(fit.reach);
  solid.solid_volume = fit.solid_volume;
  solid.of_shape = fit.of_shape;
  solid.spheres_volume = fit.spheres_volume;
  solid.measures = std::move(fit.measures);
  solid.proved = std::move(fit.proved);
  solid.seconds = fit.measurements.seconds;
}

void take_fit(SphereFit fit, std::size_t count, FittedSolid& solid) {
  solid.count = count;
  solid.proved = fit.levels.back();
  solid.levels = std::move(fit.levels);
  solid.reach = std::move(fit.reach);
  solid.solid_volume = fit.solid_volume;
  solid.spheres_volume = fit.measures.volume.balls;
  solid.measures = std::move(fit.measures);
}

std::size_t count_spheres(const FitsRecord& record) {
  std::size_t count = 0;
  for (const FittedSolid& solid : record.solids) count += solid.levels.back().size();
  return count;
}

std::optional<double> uncovered_share(const FittedSolid& solid, SphereContract contract) {
  const bool known = contract == SphereContract::kInside && solid.solid_volume && solid.spheres_volume;
  if (!known || !(*solid.solid_volume > 0)) return std::nullopt;
  return 1 - *solid.spheres_volume / *solid.solid_volume;
}

std::optional<double> uncovered_share(const FitsRecord& record) {
  double volume = 0, spheres = 0;
  for (const FittedSolid& solid : record.solids) {
    if (!uncovered_share(solid, record.spheres.contract)) return std::nullopt;
    volume += *solid.solid_volume;
    spheres += *solid.spheres_volume;
  }
  return 1 - spheres / volume;
}

}  // namespace medial_vk
