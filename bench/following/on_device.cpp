// Balls that follow a mesh on a device through five motions of 20 frames: rows of a table.
//   bench_following_on_device [--frames N] [--repeats N] [--device NAME] [--extract N] [--check] MESH BALLS.csv
// For each motion: the share of the solid's volume that is in no ball at its end, on the device and by the host's
// follower without steps, and with --extract that of all medial points of the last frame at resolution N; with --check
// how many balls of all frames reach out, by the CPU reference: if there is any, the exit code is 1; the balls that are
// lost there; the time of a frame by the clock, from its vertices on the host until the device is done, the median and
// the greatest of all frames and repeats; the median of the processor's time, in which that of a device of the host's
// processors is included; and the part by the clock until the commands are submitted.
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
#include "frames.h"
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

/// The balls of the present frame, without those that are lost.
std::vector<Ball> balls_on_device(RecordedFrames& frames, const FollowerJob& job, std::size_t count) {
  std::vector<Ball> balls;
  for (const RecordedBall& ball : frames.read<RecordedBall>(job.buffers().balls, count)) {
    if (ball.radius > 0) balls.push_back({{ball.centre[0], ball.centre[1], ball.centre[2]}, ball.radius});
  }
  return balls;
}

/// As the device has them.
std::vector<Point> in_float(std::vector<Point> frame) {
  for (Point& p : frame) {
    for (double& x : p) x = static_cast<float>(x);
  }
  return frame;
}

struct How {
  int frames = 20, repeats = 1, resolution = 0;
  bool check = false;
};

/// A row. False: a ball reaches out.
bool follow_on_device(Context& context, Motion motion, const IndexedMesh& mesh, std::span<const Ball> given,
                      const How& how) {
  FollowerJob job = or_exit(FollowerJob::create(context, mesh, given));
  FollowerOptions as_recorded;
  as_recorded.steps = 0;
  Follower follower = or_exit(Follower::create(mesh, given, as_recorded));
  RecordedFrames frames(context);
  FrameTimes times;
  BallsOutside outside;
  std::vector<Point> frame;
  for (int repeat = 0; repeat < how.repeats; ++repeat) {
    job.reset();
    for (int i = 1; i <= how.frames; ++i) {
      frame = moved_vertices(mesh.view().vertices, motion, static_cast<double>(i) / how.frames);
      times.update(frames, job, frame);
      if (repeat > 0) continue;
      exit_unless(follower.update(frame));
      if (how.check) outside.count(mesh, in_float(frame), balls_on_device(frames, job, given.size()));
    }
  }
  const std::vector<Ball> balls = balls_on_device(frames, job, given.size());
  const std::string fresh =
      how.resolution > 0 ? fresh_points(mesh_in_frame(mesh, frame), how.resolution, context) : std::string();
  const FollowMeasures measures = or_exit(follower.measure());
  const double volume = or_exit(measure_ball_union(balls)).volume;
  fmt::print("| {} | {:.2f} | {:.2f} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", name_of(motion),
             100 * (1 - volume / measures.solid_volume), 100 * measures.uncovered() / measures.solid_volume, fresh,
             outside.text(), given.size() - balls.size(), median(times.all), *std::ranges::max_element(times.all),
             median(times.processor), median(times.host));
  std::fflush(stdout);
  return outside.failed() == 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Balls that follow a mesh on a device"};
  std::string mesh_file, ball_file;
  ContextOptions options;
  How how;
  bool all_inside = true;
  app.add_option("--frames", how.frames)->check(CLI::PositiveNumber);
  app.add_option("--repeats", how.repeats)->check(CLI::PositiveNumber);
  app.add_option("--extract", how.resolution)->check(CLI::PositiveNumber);
  app.add_flag("--check", how.check);
  app.add_option("--device", options.device);
  app.add_option("MESH", mesh_file)->required();
  app.add_option("BALLS", ball_file)->required();
  CLI11_PARSE(app, argc, argv);
  const IndexedMesh mesh = or_exit(IndexedMesh::build(or_exit(prepare_mesh(or_exit(read_mesh(mesh_file))))));
  const std::vector<Ball> balls = read_balls(ball_file);
  Context context = or_exit(Context::create(options));
  for (const Motion motion : kMotions) all_inside &= follow_on_device(context, motion, mesh, balls, how);
  return all_inside ? 0 : 1;
}
