#include "ball_files/ball_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/text_scanner.h"

namespace medial_vk {
namespace {

constexpr double kFarthest = 1e18;  // measure_curvature() computes up to here

/// Of floats, or words with seven digits or more.
bool is_unit_spoke(const Point& p) { return std::fabs(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 1) < 1e-3; }

}  // namespace

Point as_written(Point spoke) {
  for (double& x : spoke) {
    // Beyond the range of a float the conversion is not defined.
    if (std::fabs(x) < 2) x = static_cast<double>(static_cast<float>(x));
  }
  return spoke;
}

std::string fault_of_ball(const Ball& ball, const SpokePair* spokes) {
  const auto is_beyond = [](double x) { return std::fabs(x) > kFarthest; };
  if (!std::ranges::all_of(ball.centre, [](double x) { return std::isfinite(x); })) return "the centre is not finite";
  if (!std::isfinite(ball.radius) || !(ball.radius > 0)) {
    return fmt::format("the radius {} is not positive", ball.radius);
  }
  if (is_beyond(ball.radius) || std::ranges::any_of(ball.centre, is_beyond)) {
    return fmt::format("there is a number beyond {:g}", kFarthest);
  }
  if (spokes != nullptr && !(is_unit_spoke(spokes->a) && is_unit_spoke(spokes->b))) return "a spoke is no unit vector";
  return {};
}

Error outside_error(const std::string& name) {
  return {ErrorCode::kUsage, name +
                                 ": there are points outside of the solid (their side); balls must be inside: write " +
                                 "the file with --side inside"};
}

Status check_all(const BallsWithSpokes& read, const std::string& name) {
  for (std::size_t i = 0; i < read.balls.size(); ++i) {
    const std::string fault = fault_of_ball(read.balls[i], read.spokes.empty() ? nullptr : &read.spokes[i]);
    if (!fault.empty()) return file_error(name, fmt::format("ball {}: {}", i, fault));
  }
  return {};
}

}  // namespace medial_vk
