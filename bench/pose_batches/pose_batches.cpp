// Verdicts and bounds for many poses of a solid and its copy, by balls, on the host and on a device: rows of a table.
//   bench_pose_batches [--poses N] [--repeats N] [--device NAME | --host] NAME.body.npz
// --host: without a device.
// Poses: any rotation about the middle, a shift of up to the longest side of the box around the mesh in any direction.
// The methods take turns; times are medians of the repeats. "Resident": poses and answers are in the device's memory,
// as recorded jobs leave them, and the time is the device's own.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "../distances/measuring.h"
#include "body_files/body_file.h"
#include "device_commands/commands.h"
#include "device_commands/uploads.h"
#include "medial_vk/collisions.h"
#include "medial_vk/device_bodies.h"
#include "medial_vk/proximity_job.h"
#include "proximity_jobs/device_bodies_impl.h"

namespace {

using namespace medial_vk;
using bench::median;
using bench::or_exit;

void check(const Status& status) {
  if (!status.ok()) or_exit(Result<int>(status.error()));
}

/// Of the box around the centres of the balls.
Point middle_of(std::span<const Ball> balls) {
  Point lower = balls.front().centre, upper = lower;
  for (const Ball& ball : balls) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], ball.centre[k]);
      upper[k] = std::max(upper[k], ball.centre[k]);
    }
  }
  return {(lower[0] + upper[0]) / 2, (lower[1] + upper[1]) / 2, (lower[2] + upper[2]) / 2};
}

/// Rotations about the middle that are uniform in axis and angle only: they cover all directions of approach.
std::vector<PosedPair> random_pairs(std::size_t count, double side, const Point& middle) {
  std::mt19937_64 random(1);
  std::normal_distribution<> normal;
  std::uniform_real_distribution<> share(0, 1);
  const auto direction = [&] {
    const Point d = {normal(random), normal(random), normal(random)};
    const double length = std::hypot(d[0], d[1], d[2]);
    return Point{d[0] / length, d[1] / length, d[2] / length};
  };
  std::vector<PosedPair> pairs(count);
  for (PosedPair& pair : pairs) {
    const Point axis = direction(), to = direction();
    const double half = 1.5707963267949 * share(random), by = share(random) * side;
    const Quaternion turn(std::sin(half) * axis[0], std::sin(half) * axis[1], std::sin(half) * axis[2], std::cos(half));
    const Pose about_middle = or_exit(make_pose({by * to[0], by * to[1], by * to[2]}, turn));
    const Pose from = {.shift = {-middle[0], -middle[1], -middle[2]}}, back = {.shift = middle};
    pair.pose = back * about_middle * from;
  }
  return pairs;
}

std::vector<RecordedPose> recorded(const std::vector<PosedPair>& pairs) {
  std::vector<RecordedPose> out(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Pose& pose = pairs[i].pose;
    float* const rows[] = {out[i].row_x, out[i].row_y, out[i].row_z};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t j = 0; j < 3; ++j) rows[k][j] = static_cast<float>(pose.rotation[k][j]);
      rows[k][3] = static_cast<float>(pose.shift[k]);
    }
    out[i].a = pairs[i].a;
    out[i].b = pairs[i].b;
  }
  return out;
}

/// Poses and answers in the memory of the device, and the kernel's seconds for all of them.
class Resident {
 public:
  Resident(DeviceBodies& bodies, const std::vector<PosedPair>& pairs)
      : bodies_(Internals::of(bodies)), count_(static_cast<std::uint32_t>(pairs.size())), arena_(bodies_.context) {
    const std::vector<RecordedPose> poses = recorded(pairs);
    const VkDeviceSize answer_bytes = pairs.size() * sizeof(RecordedBounds);
    Uploads uploads(bodies_.context);
    poses_ = or_exit(create_filled(arena_, uploads, std::span(poses), "poses"));
    answers_ = or_exit(arena_.create_buffer(answer_bytes, MemoryKind::kDevice, "answers"));
    download_ = or_exit(arena_.create_buffer(answer_bytes, MemoryKind::kReadback, "answers"));
    check(uploads.finish());
  }

  /// The median of five dispatches, after five others for the clocks to rise.
  double seconds(bool are_verdicts) {
    std::vector<double> times;
    for (int i = 0; i < 10; ++i) {
      const double time = seconds_once(are_verdicts);
      if (i >= 5) times.push_back(time);
    }
    return median(times);
  }

  /// Of the last run.
  std::vector<Collision> verdicts(bool are_verdicts) const {
    std::vector<Collision> out(count_);
    const auto* words = static_cast<const std::uint32_t*>(download_.mapped);
    const auto* bounds = static_cast<const RecordedBounds*>(download_.mapped);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = are_verdicts ? static_cast<Collision>(words[i])
                            : DistanceBounds{bounds[i].lower, bounds[i].upper, {}, {}}.collision();
    }
    return out;
  }

 private:
  double seconds_once(bool are_verdicts) {
    const auto stages = or_exit(run_commands(bodies_.context, [&](Recorder& r) {
      r.begin_stage("kernel");
      bodies_.record(r, poses_, answers_, count_, {.are_verdicts = are_verdicts});
      r.barrier();
      r.begin_stage("copy");
      r.copy(answers_, 0, download_, 0, answers_.size);
      r.barrier_to_host();
      return r.status();
    }));
    return stages.empty() ? 0 : stages.front().seconds;
  }

  DeviceBodiesImpl& bodies_;
  std::uint32_t count_;
  Arena arena_;
  Buffer poses_, answers_, download_;
};

/// A way to answer all poses: `run` gives its seconds, `verdicts` what it found.
struct Method {
  std::string name;
  std::function<double()> run;
  std::function<std::vector<Collision>()> verdicts;
  std::vector<double> seconds = {};
};

std::vector<Collision> verdicts_of(const std::vector<DistanceBounds>& bounds) {
  std::vector<Collision> out;
  for (const DistanceBounds& of_pose : bounds) out.push_back(of_pose.collision());
  return out;
}

void print_row(const std::string& name, const Method& method, const std::vector<Collision>& first) {
  const std::vector<Collision> found = method.verdicts();
  std::size_t undecided = 0, contradictions = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    undecided += found[i] == Collision::kUndecided;
    contradictions += found[i] != first[i] && found[i] != Collision::kUndecided && first[i] != Collision::kUndecided;
  }
  const auto count = static_cast<double>(found.size());
  fmt::print("| {} | {} | {:.2f} | {:.2f} | {} |\n", name, method.name, 1e-6 * count / median(method.seconds),
             100 * static_cast<double>(undecided) / count, contradictions);
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t poses = 1'000'000;
  int repeats = 5;
  bool host_only = false;
  std::string device, file;
  CLI::App app("Verdicts and bounds for many poses of a solid and its copy, by balls.");
  app.add_option("--poses", poses, "poses of the copy")->check(CLI::PositiveNumber);
  app.add_option("--repeats", repeats, "runs, of which the median counts")->check(CLI::PositiveNumber);
  CLI::Option* named = app.add_option("--device", device, "a part of the device's name");
  app.add_flag("--host", host_only, "without a device")->excludes(named);
  app.add_option("body", file, "a body file")->required();
  CLI11_PARSE(app, argc, argv);

  const std::size_t slash = file.rfind('/') + 1;
  const std::string name = file.substr(slash, file.find('.', slash) - slash);
  const BodyFile read = or_exit(read_body_file(file));
  const std::vector<Body> body = {or_exit(Body::create(read.inside, read.cover))};
  const std::vector<PosedPair> pairs =
      random_pairs(poses, bench::longest_side(read.mesh), middle_of(body.front().cover()));
  std::vector<Collision> verdicts(poses);
  std::vector<DistanceBounds> bounds(poses);
  const auto timed = [](auto work) { return [work] { return 1e-6 * bench::microseconds_each(1, work); }; };
  const auto of_verdicts = [&] { return verdicts; };
  const auto of_bounds = [&] { return verdicts_of(bounds); };
  std::vector<Method> methods = {
      {"verdicts: host, 1 thread", timed([&] { collide_by_balls(body, pairs, verdicts, {1}); }), of_verdicts},
      {fmt::format("verdicts: host, {} threads", std::thread::hardware_concurrency()),
       timed([&] { collide_by_balls(body, pairs, verdicts); }), of_verdicts},
      {"bounds: host, 1 thread", timed([&] { distance_bounds(body, pairs, bounds, {1}); }), of_bounds}};

  std::optional<Context> context;
  std::optional<DeviceBodies> bodies;
  std::optional<Resident> resident;
  if (!host_only) {
    ContextOptions options;
    options.device = device;
    context.emplace(or_exit(Context::create(options)));
    bodies.emplace(or_exit(DeviceBodies::create(*context, body)));
    resident.emplace(*bodies, pairs);
    methods.insert(methods.end(), {{"verdicts: device, from and to the host",
                                    timed([&] { check(bodies->collide_by_balls(pairs, verdicts)); }), of_verdicts},
                                   {"verdicts: device, resident", [&] { return resident->seconds(true); },
                                    [&] { return resident->verdicts(true); }},
                                   {"bounds: device, from and to the host",
                                    timed([&] { check(bodies->distance_bounds(pairs, bounds)); }), of_bounds},
                                   {"bounds: device, resident", [&] { return resident->seconds(false); },
                                    [&] { return resident->verdicts(false); }}});
  }
  std::vector<Collision> first;
  for (int repeat = 0; repeat <= repeats; ++repeat) {
    for (Method& method : methods) {
      const double seconds = method.run();
      if (repeat > 0) method.seconds.push_back(seconds);  // the first run makes programs and buffers
      if (first.empty()) first = verdicts;
      if (repeat == repeats) print_row(name, method, first);
    }
  }
}
