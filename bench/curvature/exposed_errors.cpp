#include "exposed_errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/point_ops.h"
#include "curvature/exposed_spokes.h"
#include "curvature_errors.h"

namespace medial_vk::bench {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

class SpokeErrors {
 public:
  void add_ball(std::size_t spokes) {
    ++balls_;
    if (spokes == 2) ++with_two_;
    if (spokes == 1) ++with_one_;
  }
  void add(double angle, double reach) {
    angles_.add(angle);
    reaches_.add(reach);
    if (angle <= reach) ++below_;
  }
  void print(const std::string& solid, const std::string& which) {
    fmt::print("| {} | {} | {} | {:.1f} % | {:.1f} % | ", solid, which, balls_, share(with_two_, balls_),
               share(with_one_, balls_));
    if (angles_.count() == 0) {
      fmt::print("– | – | – | – |\n");
    } else {
      fmt::print("{:.2f} | {:.2f} | {:.1f} | {:.1f} % ({:.1f}) |\n", angles_.mean(), angles_.quantile(0.95),
                 angles_.quantile(1), share(below_, angles_.count()), reaches_.quantile(0.5));
    }
    std::fflush(stdout);
  }

 private:
  static double share(std::size_t part, std::size_t all) {
    return 100 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, all));
  }

  std::size_t balls_ = 0, with_two_ = 0, with_one_ = 0, below_ = 0;
  Numbers angles_, reaches_;
};

/// The tip with this spoke: regions of equal areas may come in either order.
const TipCurvature& tip_at(const BallCurvature& ball, const Point& spoke) {
  return ball.tips[dot(ball.tips[0].normal, spoke) > dot(ball.tips[1].normal, spoke) ? 0 : 1];
}

std::vector<Ball> every_ball(const std::vector<MedialSphere>& spheres, std::size_t thinning) {
  std::vector<Ball> balls;
  balls.reserve(spheres.size() / thinning + 1);
  for (std::size_t i = 0; i < spheres.size(); i += thinning) balls.push_back({spheres[i].centre, spheres[i].radius});
  return balls;
}

}  // namespace

void print_head_of_exposed() {
  fmt::print(
      "| solid | balls | number | with two spokes | with one | mean, degrees | 95th percentile | greatest | below the "
      "estimate (its median, degrees) |\n|---|---|---|---|---|---|---|---|---|\n");
}

void print_exposed(const SmoothBoundary& solid, const std::vector<MedialSphere>& spheres, const Settings& settings) {
  const std::vector<Ball> balls = every_ball(spheres, settings.thinning);
  std::vector<std::uint32_t> numbers(balls.size());
  for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  CurvatureOptions options;
  options.threads = settings.threads;
  const BoundaryCurvature curvature = measure_curvature(balls, options).value();
  const SheetLinks links(balls, curvature.spacing, settings.threads);
  const std::vector<ExposedSpokes> spokes = exposed_spokes(links, numbers, settings.threads, {});
  SpokeErrors of_all, of_others;
  Errors at_others(greatest_curvature(solid));
  for (const std::uint32_t i : numbers) {
    if (static_cast<double>(spheres[i * settings.thinning].object_angle) < kReported) continue;
    const bool is_other = links.shape(i).state != CurvatureState::kKnown;
    of_all.add_ball(spokes[i].count);
    if (is_other) of_others.add_ball(spokes[i].count);
    for (std::size_t side = 0; side < spokes[i].count; ++side) {
      const Point& spoke = spokes[i].spokes[side];
      const Point at = balls[i].centre + balls[i].radius * spoke;
      const SmoothPoint truth = solid.nearest(at);
      if (!solid.is_known(at) || !solid.is_known(truth.position)) continue;
      const double angle = degrees_between(spoke, truth.normal), reach = kDegrees * spokes[i].reaches[side];
      of_all.add(angle, reach);
      if (!is_other) continue;
      of_others.add(angle, reach);
      const TipCurvature& tip = tip_at(curvature.balls[i], spoke);
      if (tip.state != CurvatureState::kExposed || std::isnan(tip.kappa[1])) {
        at_others.add_unknown();
      } else {
        at_others.add(truth, tip.normal, tip.kappa, tip.directions[0], tip.error);
      }
    }
  }
  of_all.print(solid.name, "all");
  of_others.print(solid.name, "without a sheet");
  at_others.print(solid.name, "curvatures of these");
}

}  // namespace medial_vk::bench
