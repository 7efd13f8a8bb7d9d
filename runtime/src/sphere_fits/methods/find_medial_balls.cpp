#include "medial_vk/certify.h"
#include "sphere_fits/methods/sphere_set.h"

namespace medial_vk {

Result<std::vector<Ball>> find_medial_balls(const Solid& solid, const ExtractionOptions& options,
                                            const Extractor& extractor, const SphereProgress& progress) {
  std::stop_source stop;
  const StageProgress on_progress = [&](const char* stage, double done) {
    if (progress && !progress(stage, done)) stop.request_stop();
  };
  Result<CertifiedExtraction> found =
      extract_and_certify(solid.indexed(), options, extractor, on_progress, stop.get_token());
  if (!found) return found.error();
  std::vector<Ball> balls;
  balls.reserve(found.value().extraction.spheres.size());
  for (const MedialSphere& s : found.value().extraction.spheres) {
    // A solid may be thinner than epsilon or than the rounding of an extraction in float. Points beside it can then
    // pass the certificate, which is about the distance from the boundary on either side.
    if (solid.contains(s.centre)) balls.push_back({s.centre, s.radius});
  }
  return balls;
}

}  // namespace medial_vk
