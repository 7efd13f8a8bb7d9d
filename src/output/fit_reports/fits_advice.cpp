#include "output/fit_reports/fits_advice.h"

#include <cmath>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {

std::optional<FitAdvice> advise(const FittedSolid& solid, SphereContract contract) {
  const std::optional<Share> share = uncovered_share(solid, contract);
  if (!share || !(share->value > kAdvisedShare) || !solid.measures || solid.proved.empty()) return std::nullopt;
  FitAdvice advice;
  advice.uncovered = share->value;
  const double covered = 1 - share->value;
  if (covered > 0)
    advice.inside = static_cast<std::size_t>(std::ceil(static_cast<double>(solid.proved.size()) / covered));
  const EnvelopeDistances& distances = solid.measures->distances;
  advice.reach = (solid.report().closed ? distances.solid_to_balls : distances.boundary_to_balls).upper;
  std::vector<Ball> grown = solid.proved;
  for (Ball& ball : grown) ball.radius += advice.reach;
  const Result<BallUnion> whole = measure_ball_union(grown, {1, false});
  const double volume = solid.solid_volume.value_or(solid.measures->volume.solid);
  if (!whole || !(volume > 0)) return std::nullopt;
  advice.added = whole.value().volume / volume - 1;
  advice.by_distance = solid.aim == SphereAim::kVolume && covered <= 0.5;
  return advice;
}

}  // namespace medial_vk
