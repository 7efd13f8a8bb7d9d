#include "share_outside.h"

#include <cmath>
#include <cstddef>

#include "../helpers.h"
#include "frames.h"
#include "medial_vk/sphere_proofs.h"
#include "outside_samples/outside_samples.h"

namespace medial_vk::bench {

ShareOutside share_outside(const IndexedMesh& mesh, const std::vector<Point>& frame, std::span<const Ball> balls,
                           double protrusion) {
  constexpr std::size_t kSamples = 100'000;
  const IndexedMesh moved = mesh_in_frame(mesh, frame);
  const OutsideSamples samples(balls, protrusion, kSamples);
  std::vector<double> depths(samples.points().size());
  exit_unless(measure_depths(moved, samples.points(), depths));
  const OutsideEstimate estimate = samples.estimate(depths);
  const double percent = 100 / std::fabs(moved.prepared().report.signed_volume);
  return {percent * estimate.volume, percent * estimate.standard_error};
}

}  // namespace medial_vk::bench
