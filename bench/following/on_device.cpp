// Balls that follow a mesh on a device through five motions of 20 frames: rows of a table.
//   bench_following_on_device [--frames N] [--repeats N] [--device NAME] MESH BALLS.csv
// For each motion: the share of the solid's volume that is in no ball at its end, on the device and by the host's
// follower; the balls that are lost there; the time of a frame by the clock, from its vertices on the host until the
// device is done, the median and the greatest of all frames and repeats; the median of the processor's time, in which
// that of a device of the host's processors is included; and the part by the clock until the commands are submitted.
#include <volk.h>

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <span>
#include <string>
#include <vector>

#include "../helpers.h"
#include "../unions/ball_files.h"
#include "input/read_mesh.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/context.h"
#include "medial_vk/follower.h"
#include "medial_vk/follower_job.h"
#include "medial_vk/prepare.h"
#include "support/device/recorded_frames.h"
#include "support/solids/motions.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::bench;
using namespace medial_vk::test;

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double, std::milli>(end - begin).count();
}

/// Milliseconds of each frame, of the processor in it, and of the host's part of it.
struct FrameTimes {
  std::vector<double> all, processor, host;

  void update(RecordedFrames& frames, FollowerJob& job, const std::vector<Point>& frame) {
    const auto begin = Clock::now();
    const std::clock_t begin_of_processor = std::clock();
    exit_unless(job.set_vertices(frame));
    Clock::time_point recorded;
    frames.run([&](VkCommandBuffer commands) {
      exit_unless(job.record(commands));
      recorded = Clock::now();
    });
    all.push_back(milliseconds(begin, Clock::now()));
    processor.push_back(1e3 * static_cast<double>(std::clock() - begin_of_processor) / CLOCKS_PER_SEC);
    host.push_back(milliseconds(begin, recorded));
  }
};

void follow_on_device(Context& context, Motion motion, const IndexedMesh& mesh, std::span<const Ball> given, int count,
                      int repeats) {
  FollowerJob job = or_exit(FollowerJob::create(context, mesh, given));
  Follower follower = or_exit(Follower::create(mesh, given));
  RecordedFrames frames(context);
  FrameTimes times;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    job.reset();
    for (int i = 1; i <= count; ++i) {
      const std::vector<Point> frame =
          moved_vertices(mesh.view().vertices, motion, static_cast<double>(i) / static_cast<double>(count));
      times.update(frames, job, frame);
      if (repeat == 0) exit_unless(follower.update(frame));
    }
  }
  std::vector<Ball> balls;
  for (const RecordedBall& ball : frames.read<RecordedBall>(job.buffers().balls, given.size())) {
    if (ball.radius > 0) balls.push_back({{ball.centre[0], ball.centre[1], ball.centre[2]}, ball.radius});
  }
  const FollowMeasures measures = or_exit(follower.measure());
  const double volume = or_exit(measure_ball_union(balls)).volume;
  fmt::print("| {} | {:.2f} | {:.2f} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", name_of(motion),
             100 * (1 - volume / measures.solid_volume), 100 * measures.uncovered() / measures.solid_volume,
             given.size() - balls.size(), median(times.all), *std::ranges::max_element(times.all),
             median(times.processor), median(times.host));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Balls that follow a mesh on a device"};
  std::string mesh_file, ball_file;
  ContextOptions options;
  int frames = 20, repeats = 1;
  app.add_option("--frames", frames)->check(CLI::PositiveNumber);
  app.add_option("--repeats", repeats)->check(CLI::PositiveNumber);
  app.add_option("--device", options.device);
  app.add_option("MESH", mesh_file)->required();
  app.add_option("BALLS", ball_file)->required();
  CLI11_PARSE(app, argc, argv);
  const IndexedMesh mesh = or_exit(IndexedMesh::build(or_exit(prepare_mesh(or_exit(read_mesh(mesh_file))))));
  const std::vector<Ball> balls = read_balls(ball_file);
  Context context = or_exit(Context::create(options));
  for (const Motion motion : kMotions) follow_on_device(context, motion, mesh, balls, frames, repeats);
}
