#include "proximity/mean_errors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "base/parallel.h"
#include "proximity/closest_balls.h"
#include "solid/probes.h"

namespace medial_vk {
namespace {

struct Sample {
  std::uint32_t ball;
  float error;
};

/// Of few samples the mean of one more counts, that of all: so a ball without any has that mean.
std::vector<float> means(std::span<const Sample> samples, std::size_t balls) {
  double all = 0;
  for (const Sample& sample : samples) all += sample.error;
  all /= static_cast<double>(std::max<std::size_t>(1, samples.size()));
  std::vector<double> sums(balls, all);
  std::vector<std::size_t> counts(balls, 1);
  for (const auto& [ball, error] : samples) {
    if (ball >= balls) continue;  // the distances are too large for squares in float
    sums[ball] += error;
    ++counts[ball];
  }
  std::vector<float> means;
  means.reserve(balls);
  for (std::size_t i = 0; i < balls; ++i) means.push_back(static_cast<float>(sums[i] / static_cast<double>(counts[i])));
  return means;
}

}  // namespace

MeanErrors mean_errors(const Solid& solid, const BodyTree& inside, const BodyTree& cover, const Point& centre,
                       unsigned threads, LoopWatch& watch) {
  constexpr std::size_t kMost = 4096, kOfBall = 8, kTogether = 64;
  const std::size_t count = std::min(kMost, kOfBall * (inside.size() + cover.size()));
  const std::vector<Probe> probes = probes_around(solid, count, threads, [&watch] { watch.check(); });
  std::vector<Sample> of_inside(probes.size()), of_cover(probes.size());
  const FloatPose pose{Pose()};
  parallel_for(probes.size(), kTogether, threads, [&](std::size_t i) {
    watch.check();
    const Ball at = {probes[i].outside(), 0};
    const BodyTree point = BodyTree::build({&at, 1}, centre);
    const auto error = [&](const BodyTree& tree, double sign) -> Sample {
      const ClosestBalls found = closest_balls(tree, point, pose, {}, std::numeric_limits<float>::lowest(), kFarther);
      const double difference = sign * (static_cast<double>(found.separation) - probes[i].distance);
      if (found.balls == BallPair{}) return {BallPair::kNone, 0};
      return {found.balls.a, static_cast<float>(std::max(0.0, difference))};
    };
    of_inside[i] = error(inside, 1);
    of_cover[i] = error(cover, -1);
  });
  return {means(of_inside, inside.size()), means(of_cover, cover.size())};
}

}  // namespace medial_vk
