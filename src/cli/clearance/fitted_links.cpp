#include "cli/clearance/fitted_links.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "cli/clearance/kept_bodies.h"
#include "cli/shared/reference_with_estimate.h"
#include "cli/terminal/interrupt.h"
#include "medial_vk/part_fits.h"

namespace medial_vk::cli {
namespace {

/// `number` is that of the solid.
Part part_of(const LinkSolid& solid, std::size_t number, const RobotAndScene& all) {
  Part part;
  part.link = all.names[all.owner_of(number)];
  part.name = solid.name;
  part.pose = solid.pose;
  part.ball = solid.ball;
  if (!solid.ball) part.mesh = solid.mesh;
  return part;
}

/// The balls of all parts, in their own frames.
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
  balls.reserve(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].ball) {
      balls.push_back({*parts[i].ball});
    } else {
      balls.push_back(std::move(fits.value()[i].proved));
    }
  }
  return balls;
}

std::string path_in(const std::string& folder, const std::string& name) { return folder + "/" + name; }

/// The solids of a link are consecutive: calls with the numbers of each link's first solid and of the one behind its
/// last, likewise for each file of the scene.
template <class Call>
Status for_each_link(const RobotAndScene& all, const Call& call) {
  const std::size_t count = all.solids.around.size();
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    for (end = begin; end < count && all.owner_of(end) == all.owner_of(begin);) ++end;
    if (Status status = call(begin, end); !status) return status;
  }
  return {};
}

/// The balls of a link's solids, if all are known; else nothing changes.
Status find_balls(const RobotAndScene& all, const ClearanceOptions& of_run, std::size_t begin, std::size_t end,
                  BallsOfSolids& result) {
  std::vector<SolidBalls> found;
  std::size_t read = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const LinkSolid& solid = all.solids.around[i];
    if (const auto of_file = all.balls_of_files.find(all.owner_of(i)); of_file != all.balls_of_files.end()) {
      found.push_back(of_file->second);
    } else if (solid.ball && end - begin <= of_run.balls) {
      found.push_back({{*all.solids.inside[i].ball}, {*solid.ball}});
    } else if (!solid.ball && !of_run.bodies.empty()) {
      Result<std::optional<SolidBalls>> kept =
          read_kept_body(path_in(of_run.bodies, result.names[i]), all, i, of_run.threads);
      if (!kept) return kept.error();
      if (!kept.value()) return {};
      found.push_back(*std::move(kept).value());
      ++read;
    } else {
      return {};
    }
  }
  for (std::size_t i = begin; i < end; ++i) result.balls[i] = std::move(found[i - begin]);
  result.read += read;
  return {};
}

/// The numbers of all solids that are to be fitted: those without balls, of several equal links one.
std::vector<std::size_t> solids_to_fit(const RobotAndScene& all, const BallsOfSolids& known) {
  std::vector<std::size_t> numbers;
  std::set<std::vector<std::string>> links;
  (void)for_each_link(all, [&](std::size_t begin, std::size_t end) -> Status {
    if (known.balls[begin]) return {};
    const auto at = [&](std::size_t i) { return known.names.begin() + static_cast<std::ptrdiff_t>(i); };
    if (!links.insert(std::vector<std::string>(at(begin), at(end))).second) return {};
    for (std::size_t i = begin; i < end; ++i) numbers.push_back(i);
    return {};
  });
  return numbers;
}

bool is_closed(const LinkSolid& solid) { return solid.mesh.prepared().report.closed; }

}  // namespace

bool BallsOfSolids::has_all() const {
  return std::ranges::all_of(balls, [](const auto& of_solid) { return of_solid.has_value(); });
}

Result<BallsOfSolids> known_balls(const RobotAndScene& all, const ClearanceOptions& of_run, Progress& progress) {
  BallsOfSolids result;
  result.names = names_of_bodies(all, of_run);
  result.balls.resize(all.solids.around.size());
  const Status status = for_each_link(all, [&](std::size_t begin, std::size_t end) {
    progress.update("kept bodies", static_cast<double>(begin) / static_cast<double>(all.solids.around.size()));
    return find_balls(all, of_run, begin, end, result);
  });
  progress.clear();
  if (!status) return status.error();
  return result;
}

Status fit_missing_balls(const RobotAndScene& all, const ClearanceOptions& of_run, std::optional<Context>& context,
                         Progress& progress, const std::stop_source& stop, BallsOfSolids& result) {
  const std::vector<std::size_t> numbers = solids_to_fit(all, result);
  std::vector<Part> closed, around;
  around.reserve(numbers.size());
  for (const std::size_t i : numbers) {
    if (is_closed(all.solids.inside[i])) closed.push_back(part_of(all.solids.inside[i], i, all));
    around.push_back(part_of(all.solids.around[i], i, all));
  }
  PartFitOptions options;
  options.count_per_link = of_run.balls;
  options.spheres.resolution = of_run.resolution;
  options.spheres.balls_only = true;
  options.threads = of_run.threads;
  Result<std::vector<std::vector<Ball>>> inside = fit(closed, options, context, progress, stop);
  if (!inside) return inside.error();
  options.spheres.contract = SphereContract::kCover;
  Result<std::vector<std::vector<Ball>>> cover = fit(around, options, context, progress, stop);
  if (!cover) return cover.error();
  std::map<std::string, SolidBalls> by_name;
  std::size_t next = 0;  // of the closed ones
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    SolidBalls& balls = by_name[result.names[numbers[k]]];
    if (is_closed(all.solids.inside[numbers[k]])) balls.inside = std::move(inside.value()[next++]);
    balls.cover = std::move(cover.value()[k]);
  }
  for (std::size_t i = 0; i < result.balls.size(); ++i) {
    if (result.balls[i]) continue;
    result.balls[i] = by_name.at(result.names[i]);
    if (!all.solids.around[i].ball) ++result.fitted;
  }
  return {};
}

Status keep_fitted_balls(const RobotAndScene& all, const ClearanceOptions& of_run, const BallsOfSolids& was_known,
                         const BallsOfSolids& now) {
  std::map<std::string, OutputFile> by_name;
  for (std::size_t i = 0; i < now.balls.size(); ++i) {
    if (was_known.balls[i] || all.solids.around[i].ball || by_name.contains(now.names[i])) continue;
    Result<OutputFile> file =
        encode_kept_body(path_in(of_run.bodies, now.names[i]), all, i, *now.balls[i], of_run.threads);
    if (!file) return file.error();
    by_name.emplace(now.names[i], std::move(file).value());
  }
  std::vector<OutputFile> files;
  files.reserve(by_name.size());
  for (auto& [name, file] : by_name) files.push_back(std::move(file));
  if (files.empty()) return {};
  if (Status status = make_folder(of_run.bodies); !status) return status;
  return write_files(files);
}

Result<std::vector<GroupPart>> bodies_of_balls(const RobotAndScene& all, const BallsOfSolids& balls) {
  std::vector<GroupPart> parts;
  parts.reserve(balls.balls.size());
  for (std::size_t i = 0; i < balls.balls.size(); ++i) {
    Result<Body> body = Body::create(balls.balls[i]->inside, balls.balls[i]->cover);
    if (!body) return body.error();
    parts.push_back({std::move(body).value(), all.solids.around[i].link, all.solids.around[i].pose});
  }
  return parts;
}

}  // namespace medial_vk::cli
