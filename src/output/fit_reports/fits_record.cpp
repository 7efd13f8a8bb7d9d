#include "output/fit_reports/fits_record.h"

#include <cmath>
#include <utility>

namespace medial_vk {
namespace {

/// Of its shape, or of what its mesh encloses cleanly, or else an estimate (SphereMeasures).
std::optional<double> volume_of(const FittedSolid& solid) {
  if (solid.solid_volume) return solid.solid_volume;
  if (solid.measures && solid.measures->volume.solid > 0) return solid.measures->volume.solid;
  return std::nullopt;
}

}  // namespace

const char* name_of(SphereContract contract) {
  constexpr const char* kNames[] = {"inside", "cover", "balanced"};
  return kNames[static_cast<std::size_t>(contract)];
}

const char* name_of(SphereMethod method) { return method == SphereMethod::kBest ? "best" : "source"; }

const char* name_of(SphereAim aim) {
  constexpr const char* kNames[] = {"volume", "distance", "auto"};
  return kNames[static_cast<std::size_t>(aim)];
}

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
  solid.aim = fit.aim;
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
  solid.aim = fit.aim;
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

std::optional<Share> uncovered_share(const FittedSolid& solid, SphereContract contract) {
  const std::optional<double> volume = volume_of(solid);
  if (contract != SphereContract::kInside || !volume || !(*volume > 0)) return std::nullopt;
  if (solid.solid_volume) {
    if (!solid.spheres_volume) return std::nullopt;
    return Share{1 - *solid.spheres_volume / *volume, 0, false};
  }
  const VolumeError& sampled = solid.measures->volume;
  return Share{sampled.uncovered / *volume, sampled.standard_error / *volume, true};
}

std::optional<Share> uncovered_share(const FitsRecord& record) {
  if (record.is_body) return std::nullopt;
  double whole = 0, covered = 0, variance = 0;
  bool is_estimate = false;
  for (const FittedSolid& solid : record.solids) {
    const std::optional<Share> share = uncovered_share(solid, record.spheres.contract);
    if (!share) return std::nullopt;
    const double volume = *volume_of(solid), error = share->standard_error * volume;
    whole += volume;
    covered += solid.solid_volume ? *solid.spheres_volume : (1 - share->value) * volume;
    variance += error * error;
    is_estimate = is_estimate || share->is_estimate;
  }
  return Share{1 - covered / whole, std::sqrt(variance) / whole, is_estimate};
}

}  // namespace medial_vk
