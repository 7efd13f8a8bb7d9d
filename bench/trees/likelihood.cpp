#include "likelihood.h"

#include <cstdio>
#include <cstdlib>

#include "medial_vk/ball_union.h"

namespace medial_vk::bench {

std::vector<double> likelihoods_of(std::span<const Ball> balls, double distance) {
  std::vector<Ball> grown(balls.begin(), balls.end());
  for (Ball& ball : grown) ball.radius += distance;
  Result<BallUnion> measured = measure_ball_union(grown);
  if (!measured.ok() || !(measured.value().area > 0)) {
    std::fprintf(stderr, "%s\n", measured.ok() ? "the balls have no area" : measured.error().message.c_str());
    std::exit(1);
  }
  std::vector<double> shares = measured.value().areas;
  for (double& share : shares) share /= measured.value().area;
  return shares;
}

}  // namespace medial_vk::bench
