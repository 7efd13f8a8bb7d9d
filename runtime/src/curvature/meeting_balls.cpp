#include "curvature/meeting_balls.h"

#include <map>

namespace medial_vk {

MeetingBalls::MeetingBalls(std::span<const Ball> balls, const std::vector<std::uint8_t>& is_left_out) {
  std::map<int, std::vector<std::uint32_t>> by_size;
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    if (is_left_out[i] == 0) by_size[std::ilogb(balls[i].radius)].push_back(i);
  }
  for (const auto& [exponent, members] : by_size) {
    groups_.push_back({std::ldexp(1.0, exponent + 1), {}, {}, PointGrid({}, 0)});
    Group& group = groups_.back();
    group.radii.reserve(members.size());
    group.centres.reserve(members.size());
    for (const std::uint32_t i : members) {
      group.radii.push_back(balls[i].radius);
      group.centres.push_back(balls[i].centre);
    }
    group.grid = PointGrid(group.centres, group.greatest);
  }
}

bool MeetingBalls::meets_other(const Ball& ball, double near) const {
  for (const Group& group : groups_) {
    const auto is_other = [&](std::uint32_t i, double squared) {
      const double distance = std::sqrt(squared), radius = group.radii[i];
      if (distance <= ball.radius - radius || distance >= ball.radius + radius) return false;
      return distance > near || distance < radius - ball.radius;
    };
    if (group.grid.any_within(ball.centre, ball.radius + group.greatest, is_other)) return true;
  }
  return false;
}

}  // namespace medial_vk
