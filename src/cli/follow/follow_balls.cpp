#include "cli/follow/follow_balls.h"

#include <stop_token>
#include <utility>

#include "ball_files/read_balls.h"
#include "base/stopwatch.h"
#include "cli/shared/reference_with_estimate.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "medial_vk/analysis.h"
#include "medial_vk/sphere_fits.h"

namespace medial_vk::cli {
namespace {

Result<std::vector<Ball>> read(const FollowOptions& options) {
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  return read_balls(options.balls, options.covers() ? BodyBalls::kCover : BodyBalls::kInside);
}

Extractor extractor_of(SharedOfRun& shared) {
  return shared.context ? device_extractor(*shared.context) : reference_with_estimate(shared.progress);
}

Result<std::vector<Ball>> fit(const FollowOptions& options, const IndexedMesh& mesh, SharedOfRun& shared,
                              const StageProgress& progress, const std::stop_token& stop) {
  SphereFitOptions fit_options;
  fit_options.contract = options.contract;
  fit_options.count = options.count;
  fit_options.resolution = options.resolution;
  fit_options.balls_only = true;
  fit_options.threads = options.follower.threads;
  Result<SphereFit> fitted = fit_spheres(mesh, fit_options, extractor_of(shared), progress, stop);
  if (!fitted) return fitted.error();
  std::vector<Ball> balls = std::move(fitted.value().levels.back());
  return balls;
}

Result<std::vector<Ball>> all_points(const FollowOptions& options, const IndexedMesh& mesh, SharedOfRun& shared,
                                     const StageProgress& progress, const std::stop_token& stop) {
  AnalysisOptions analysis;
  analysis.extraction.resolution = options.resolution;
  analysis.threads = options.follower.threads;
  Result<Analysis> found = analyse(mesh, analysis, extractor_of(shared), progress, stop);
  if (!found) return found.error();
  std::vector<Ball> balls;
  for (const MedialSphere& sphere : found.value().spheres) balls.push_back({sphere.centre, sphere.radius});
  if (balls.empty()) return Error{ErrorCode::kInvalidMesh, "there is no medial point at this --resolution"};
  return balls;
}

}  // namespace

bool finds_on_device(const FollowOptions& options) {
  return options.balls.empty() && options.backend == Backend::kVulkan;
}

Result<std::vector<Ball>> balls_at_rest(const FollowOptions& options, const IndexedMesh& mesh, SharedOfRun& shared) {
  Stopwatch stopwatch;
  std::stop_source stop;
  const StageProgress on_progress = [&](const char*, double done) {
    shared.progress.update("balls", done);
    if (interrupted()) stop.request_stop();
  };
  Result<std::vector<Ball>> balls = !options.balls.empty() ? read(options)
                                    : options.points ? all_points(options, mesh, shared, on_progress, stop.get_token())
                                                     : fit(options, mesh, shared, on_progress, stop.get_token());
  shared.progress.clear();
  shared.times.push_back({"balls", stopwatch.lap()});
  if (balls) return balls;
  if (balls.error().code == ErrorCode::kInterrupted) return stopped();
  Error error = balls.error();
  error.message = in_words_of_options(std::move(error.message), Command::kFollow);
  return with_hint(std::move(error));
}

}  // namespace medial_vk::cli
