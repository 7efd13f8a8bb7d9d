#include "cli/clearance/fitted_links.h"

#include <span>
#include <utility>

#include "cli/shared/reference_with_estimate.h"
#include "cli/terminal/interrupt.h"
#include "medial_vk/part_fits.h"

namespace medial_vk::cli {
namespace {

Part part_of(const LinkSolid& solid, const RobotAndScene& all) {
  Part part;
  part.link = all.names[solid.link];
  part.name = solid.name;
  part.pose = solid.pose;
  part.ball = solid.ball;
  if (!solid.ball) part.mesh = solid.mesh;
  return part;
}

/// The balls of all parts, in the frames of their links.
Result<std::vector<std::vector<Ball>>> fit(const std::vector<Part>& parts, const PartFitOptions& options,
                                           std::optional<Context>& context, Progress& progress,
                                           const std::stop_source& stop) {
  if (parts.empty()) return std::vector<std::vector<Ball>>();
  const char* const step = options.spheres.contract == SphereContract::kInside ? "inside" : "cover";
  const StageProgress on_progress = [&, stop](const char*, double done) mutable {
    progress.update(step, done);
    if (interrupted()) stop.request_stop();
  };
  Result<std::vector<PartFit>> fits =
      context ? fit_parts(parts, options, *context, on_progress, stop.get_token())
              : fit_parts(parts, options, reference_with_estimate(progress), on_progress, stop.get_token());
  progress.clear();
  if (!fits) return fits.error();
  std::vector<std::vector<Ball>> balls;
  for (PartFit& part : fits.value()) balls.push_back(std::move(part.levels.back()));
  return balls;
}

}  // namespace

Result<FittedLinks> fit_links(const RobotAndScene& all, const ClearanceOptions& of_run, std::optional<Context>& context,
                              Progress& progress, const std::stop_source& stop) {
  std::vector<Part> closed, around;
  for (const LinkSolid& solid : all.solids.inside) {
    if (solid.mesh.prepared().report.closed) closed.push_back(part_of(solid, all));
  }
  for (const LinkSolid& solid : all.solids.around) around.push_back(part_of(solid, all));
  PartFitOptions options;
  options.count_per_link = of_run.balls;
  options.spheres.resolution = of_run.resolution;
  options.spheres.balls_only = true;
  options.threads = of_run.threads;
  const Result<std::vector<std::vector<Ball>>> inside = fit(closed, options, context, progress, stop);
  if (!inside) return inside.error();
  options.spheres.contract = SphereContract::kCover;
  const Result<std::vector<std::vector<Ball>>> cover = fit(around, options, context, progress, stop);
  if (!cover) return cover.error();
  FittedLinks fitted;
  std::size_t next = 0;  // of the closed ones
  for (std::size_t i = 0; i < around.size(); ++i) {
    const bool is_closed = all.solids.inside[i].mesh.prepared().report.closed;
    const std::span<const Ball> within = is_closed ? inside.value()[next++] : std::span<const Ball>();
    const std::span<const Ball> over = cover.value()[i];
    Result<Body> body = Body::create(within, over);
    if (!body) return body.error();
    fitted.parts.push_back({std::move(body).value(), all.solids.around[i].link, {}});
    fitted.inside += within.size();
    fitted.cover += over.size();
  }
  return fitted;
}

}  // namespace medial_vk::cli
