// Covers that follow a mesh through five motions: rows of a table.
//   bench_following_covers [--frames N] [--repeats N] [--steps N] [--threads N] MESH BALLS.csv
// For each motion: the volume of the balls over that of the solid in the rest pose, at its end, and there after
// tighten(); how many frames are proved; the median time of a frame, of one whose surface alone is covered, and the
// time of tighten(), in milliseconds of the processor, all threads together.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "../helpers.h"
#include "../unions/ball_files.h"
#include "input/read_mesh.h"
#include "medial_vk/cover_follower.h"
#include "medial_vk/prepare.h"
#include "support/solids/motions.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::bench;
using namespace medial_vk::test;

using Frames = std::vector<std::vector<Point>>;

double ratio(const CoverFollower& follower) {
  const CoverFollowMeasures measures = or_exit(follower.measure());
  return measures.ball_volume / measures.solid_volume;
}

template <class Work>
double milliseconds(const Work& work) {
  const std::clock_t begin = std::clock();
  work();
  return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// The times of all frames.
std::vector<double> follow(CoverFollower& follower, const Frames& frames, int repeats, std::size_t& proved) {
  std::vector<double> times;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    exit_unless(follower.reset());
    proved = 0;
    for (const auto& frame : frames) {
      times.push_back(milliseconds([&] { exit_unless(follower.update(frame)); }));
      proved += follower.state() == CoverState::kSolid ? 1 : 0;
    }
  }
  return times;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Covers that follow a mesh"};
  std::string mesh_file, ball_file;
  int frame_count = 20, repeats = 1;
  std::uint32_t steps = 0;
  unsigned threads = 0;
  app.add_option("--frames", frame_count)->check(CLI::PositiveNumber);
  app.add_option("--repeats", repeats)->check(CLI::PositiveNumber);
  app.add_option("--steps", steps);
  app.add_option("--threads", threads);
  app.add_option("MESH", mesh_file)->required();
  app.add_option("BALLS", ball_file)->required();
  CLI11_PARSE(app, argc, argv);
  const IndexedMesh mesh = or_exit(IndexedMesh::build(or_exit(prepare_mesh(or_exit(read_mesh(mesh_file))))));
  const std::vector<Ball> balls = read_balls(ball_file);
  for (const Motion motion : kMotions) {
    Frames frames;
    for (int i = 1; i <= frame_count; ++i) {
      frames.push_back(moved_vertices(mesh.view().vertices, motion, static_cast<double>(i) / frame_count));
    }
    CoverFollower follower = or_exit(CoverFollower::create(mesh, balls, {.steps = steps, .threads = threads}));
    CoverFollower surface = or_exit(CoverFollower::create(mesh, balls, {.surface_only = true, .threads = threads}));
    const double rest = ratio(follower);
    std::size_t proved = 0, none = 0;
    const double frame_time = median(follow(follower, frames, repeats, proved));
    const double surface_time = median(follow(surface, frames, repeats, none));
    const double end = ratio(follower);
    const double tightening = milliseconds([&] { exit_unless(follower.tighten()); });
    fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {} | {:.2f} | {:.2f} | {:.0f} |\n", name_of(motion), rest, end,
               ratio(follower), proved, frame_time, surface_time, tightening);
    std::fflush(stdout);
  }
}
