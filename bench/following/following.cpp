// Balls that follow a mesh through five motions of 20 frames: rows of a table.
//   bench_following [--frames N] [--repeats N] [--threads N] [--motion NAME] [--rule NAME] [--fresh | --extract N]
//                   [--check] MESH BALLS.csv
// For each motion and rule: the share of the solid's volume that is in no ball at its end, the greatest one of any
// frame there and back, that where the last frame is computed from the rest pose at once, and that after the way back;
// for the published rule the bound of Lemma 7.3 and the share outside the solid, by samples, of its last frame; the
// time of a frame by the clock and of the processor, medians of all frames and repeats; with --fresh beside a new fit
// of as many balls to the last frame, with --extract beside all medial points of the last frame at resolution N; with
// --check how many balls of all frames of the motion reach out, by the CPU reference, other than those of the published
// rule, which may: if there is any, the exit code is 1.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "../helpers.h"
#include "../unions/ball_files.h"
#include "frames.h"
#include "input/read_mesh.h"
#include "medial_vk/context.h"
#include "medial_vk/follower.h"
#include "medial_vk/prepare.h"
#include "medial_vk/sphere_fits.h"
#include "share_outside.h"
#include "support/solids/motions.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::bench;
using namespace medial_vk::test;

using Frames = std::vector<std::vector<Point>>;

struct Rule {
  const char* name;
  FollowRule rule;
  std::uint32_t steps, renewed;
};
constexpr std::array kRules = {
    Rule{"published", FollowRule::kPublished, 0, 0}, Rule{"tangent", FollowRule::kTangent, 0, 0},
    Rule{"tangent, 1 step", FollowRule::kTangent, 1, 0}, Rule{"tangent, 2 steps", FollowRule::kTangent, 2, 0},
    Rule{"tangent, 1 step, 25 anew", FollowRule::kTangent, 1, 25}};

Frames frames_of(std::span<const Point> rest, Motion motion, int count) {
  Frames frames;
  for (int i = 1; i <= count; ++i) frames.push_back(moved_vertices(rest, motion, static_cast<double>(i) / count));
  return frames;
}

/// Percent of the solid's volume.
struct Uncovered {
  double share, outside_bound;
};
Uncovered uncovered(const Follower& follower) {
  const FollowMeasures measures = or_exit(follower.measure());
  return {100 * measures.uncovered() / measures.solid_volume, 100 * measures.outside_bound / measures.solid_volume};
}

/// Percent of the solid's volume, of the balls that follow as published.
std::string outside_text(const IndexedMesh& mesh, const std::vector<Point>& frame, const Follower& follower) {
  const double protrusion = FollowerOptions().protrusion * mesh.longest_side();
  const ShareOutside outside = share_outside(mesh, frame, follower.balls(), protrusion);
  return fmt::format("{:.3f} ± {:.3f}", outside.percent, outside.standard_error);
}

/// Milliseconds of each frame.
struct Times {
  std::vector<double> clock, processor;

  void update(Follower& follower, const std::vector<Point>& frame) {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t begin_of_processor = std::clock();
    exit_unless(follower.update(frame));
    processor.push_back(1e3 * static_cast<double>(std::clock() - begin_of_processor) / CLOCKS_PER_SEC);
    clock.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
};

/// There and back, the greatest share that is uncovered, and with `check` the balls outside on the way there: without
/// times, which measuring in between would change.
double worst_share(Follower& follower, const IndexedMesh& mesh, const Frames& frames, bool check,
                   BallsOutside& outside) {
  exit_unless(follower.reset());
  double worst = uncovered(follower).share;
  const auto take = [&](const std::vector<Point>& frame) {
    exit_unless(follower.update(frame));
    worst = std::max(worst, uncovered(follower).share);
  };
  for (const auto& frame : frames) {
    take(frame);
    if (check) outside.count(mesh, frame, follower.balls());
  }
  for (std::size_t i = frames.size() - 1; i-- > 0;) take(frames[i]);
  return worst;
}

struct How {
  int repeats = 1;
  unsigned threads = 0;
  bool check = false;
};

/// A row. False: a ball reaches out that must not.
bool follow(const std::string& title, const Rule& rule, const IndexedMesh& mesh, std::span<const Ball> balls,
            const Frames& frames, const std::string& fresh, const How& how) {
  FollowerOptions options;
  options.rule = rule.rule;
  options.steps = rule.steps;
  options.renewed = rule.renewed;
  options.threads = how.threads;
  Follower follower = or_exit(Follower::create(mesh, balls, options));
  const Uncovered rest = uncovered(follower);
  Times times;
  Uncovered end{}, back{};
  std::size_t medial = 0;
  for (int repeat = 0; repeat < how.repeats; ++repeat) {
    exit_unless(follower.reset());
    for (const auto& frame : frames) times.update(follower, frame);
    end = uncovered(follower);
    medial = static_cast<std::size_t>(std::ranges::count(follower.states(), FollowState::kMedial));
    for (std::size_t i = frames.size() - 1; i-- > 0;) times.update(follower, frames[i]);
    times.update(follower, {mesh.view().vertices.begin(), mesh.view().vertices.end()});
    back = uncovered(follower);
  }
  exit_unless(follower.reset());
  exit_unless(follower.update(frames.back()));
  const Uncovered at_once = uncovered(follower);
  const bool may_reach_out = options.rule == FollowRule::kPublished;
  // Frames of the published rule do not depend on those before.
  const std::string share = may_reach_out ? outside_text(mesh, frames.back(), follower) : "";
  BallsOutside outside;
  const double worst = worst_share(follower, mesh, frames, how.check && !may_reach_out, outside);
  fmt::print(
      "| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} | {:.2f} | {:.2f} | {} | {} | {:.0f} | {:.2f} | {:.2f} |\n",
      title, rule.name, rest.share, end.share, worst, at_once.share, fresh, back.share / rest.share, end.outside_bound,
      share, outside.text(), 100.0 * static_cast<double>(medial) / static_cast<double>(balls.size()),
      median(times.clock), median(times.processor));
  std::fflush(stdout);
  return outside.failed() == 0;
}

/// Percent of the volume that a new fit to the frame leaves uncovered.
std::string fresh_fit(const IndexedMesh& mesh, std::size_t count, Context& context) {
  SphereFitOptions options;
  options.count = count;
  const SphereFit fit = or_exit(fit_spheres(mesh, options, context));
  return fmt::format("{:.2f}", 100 * fit.measures.volume.uncovered / fit.measures.volume.solid);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Balls that follow a mesh"};
  std::string mesh_file, ball_file, only, only_rule;
  int frames = 20, resolution = 0;
  bool fresh = false, all_inside = true;
  How how;
  app.add_option("--frames", frames)->check(CLI::PositiveNumber);
  app.add_option("--repeats", how.repeats)->check(CLI::PositiveNumber);
  app.add_option("--threads", how.threads);
  app.add_flag("--check", how.check);
  app.add_option("--motion", only);
  app.add_option("--rule", only_rule);
  CLI::Option* fit = app.add_flag("--fresh", fresh);
  app.add_option("--extract", resolution)->check(CLI::PositiveNumber)->excludes(fit);
  app.add_option("MESH", mesh_file)->required();
  app.add_option("BALLS", ball_file)->required();
  CLI11_PARSE(app, argc, argv);
  const IndexedMesh mesh = or_exit(IndexedMesh::build(or_exit(prepare_mesh(or_exit(read_mesh(mesh_file))))));
  const std::vector<Ball> balls = read_balls(ball_file);
  std::optional<Context> context;
  if (fresh || resolution > 0) context.emplace(or_exit(Context::create()));
  for (const Motion motion : kMotions) {
    if (!only.empty() && only != name_of(motion)) continue;
    const Frames moved = frames_of(mesh.view().vertices, motion, frames);
    std::string again;
    if (fresh) again = fresh_fit(mesh_in_frame(mesh, moved.back()), balls.size(), *context);
    if (resolution > 0) again = fresh_points(mesh_in_frame(mesh, moved.back()), resolution, *context);
    for (const Rule& rule : kRules) {
      if (!only_rule.empty() && only_rule != rule.name) continue;
      all_inside &= follow(name_of(motion), rule, mesh, balls, moved, again, how);
    }
  }
  return all_inside ? 0 : 1;
}
