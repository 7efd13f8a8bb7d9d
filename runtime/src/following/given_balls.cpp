#include "following/given_balls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace medial_vk {

Status check_options(std::span<const Ball> balls, const FollowerOptions& options, bool is_closed) {
  const auto usage = [](const char* message) { return Error{ErrorCode::kUsage, message}; };
  if (balls.empty()) return usage("there is no ball to follow the mesh");
  if (!(options.protrusion > 0 && options.protrusion < 1)) return usage("`protrusion` must be positive and below 1");
  if (!(options.shrunk >= 0 && options.shrunk <= 1)) return usage("`shrunk` must be from 0 to 1");
  if (!(options.object_angle >= 0 && std::isfinite(options.object_angle))) {
    return usage("`object_angle` must be finite and not negative");
  }
  if (!(options.renewal_factor >= 1 && std::isfinite(options.renewal_factor))) {
    return usage("`renewal_factor` must be finite and at least 1");
  }
  if (options.renewed == 0) return {};
  if (options.rule == FollowRule::kPublished) return usage("`renewed` must be 0 where balls follow as published");
  if (!is_closed) return usage("`renewed` must be 0 for a mesh that is not closed: its volume is not known");
  return {};
}

Result<TrackedBall> track(const MovingSurface& surface, const Ball& ball, std::size_t index, double error) {
  const auto refuse = [&](const std::string& why) {
    return Error{ErrorCode::kUsage, "ball " + std::to_string(index) + " " + why};
  };
  constexpr double kMost = MovingSurface::kGreatestCoordinate;
  const bool is_in_range = std::ranges::all_of(ball.centre, [](double x) { return std::fabs(x) <= 2 * kMost; });
  if (!is_in_range || !(ball.radius > 0 && ball.radius <= kMost)) {
    return refuse("has a number that is out of range, or no positive radius");
  }
  const BvhHit nearest = surface.closest(ball.centre, std::numeric_limits<double>::infinity());
  const double distance = std::sqrt(nearest.squared_distance);
  if (ball.radius > distance + error || !(distance > 2 * surface.rounding()) || !surface.contains(ball.centre)) {
    return refuse("is not inside the mesh");
  }
  TrackedBall tracked;
  tracked.ball = ball;
  tracked.a = {surface.surface_point(nearest), (1 / distance) * (ball.centre - nearest.point)};
  return tracked;
}

}  // namespace medial_vk
