#include "follower_jobs/rest_balls.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "base/parallel.h"
#include "following/greatest_ball.h"
#include "following/rest_contacts.h"
#include "following/tracked_ball.h"
#include "medial_vk/ball_union.h"

namespace medial_vk {
namespace {

constexpr std::size_t kBallsAtATime = 16;  // that one thread takes
constexpr std::size_t kBallsOfWalk = 8;

/// Of a ball with one contact, that one is both.
TrackedBall tracked_at_rest(const MovingSurface& surface, const Ball& ball) {
  TrackedBall tracked = ball_with_contacts(surface, ball);
  if (!tracked.b.on.is_known()) tracked.b = tracked.a;
  return tracked;
}

gpu::vec4 to_floats(const Point& p, double w) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]), static_cast<float>(w)};
}

/// FollowState::carried_a of a contact.
gpu::vec4 carried(const MovingSurface& surface, const BallContact& contact, double scale) {
  const Corners3 corners = surface.corners(contact.on.triangle);
  const Point inward = surface.inward_normal(contact.on.triangle);
  const Point& d = contact.towards_centre;
  const Point products = {scale * dot(d, corners[1] - corners[0]), scale * dot(d, corners[2] - corners[0]),
                          dot(d, inward)};
  return to_floats(products, dot(inward, inward) > 0 ? 1 : 0);
}

gpu::FollowRest packed_rest(const MovingSurface& surface, const TrackedBall& tracked,
                            std::span<const std::uint32_t> places, double scale) {
  const BallContact &a = tracked.a, &b = tracked.b;
  const double through = radius_through(surface.at(a.on), a.towards_centre, surface.at(b.on));
  gpu::FollowRest rest = {};
  gpu::FollowedBall& followed = rest.state.followed;
  followed.towards_a = to_floats(a.towards_centre, a.on.v);
  followed.towards_b = to_floats(b.towards_centre, b.on.v);
  followed.triangle_a = places[a.on.triangle];
  followed.triangle_b = places[b.on.triangle];
  followed.w_a = static_cast<float>(a.on.w);
  followed.w_b = static_cast<float>(b.on.w);
  followed.ball = to_floats(scale * tracked.ball.centre, scale * tracked.ball.radius);
  rest.state.carried_a = carried(surface, a, scale);
  rest.state.carried_b = carried(surface, b, scale);
  rest.through = static_cast<float>(std::min(scale * through, 1e8));
  rest.turn = static_cast<float>(dot(a.towards_centre, b.towards_centre));
  return rest;
}

/// Sorts balls into groups of eight, which walk the tree together: those that are longest in some coordinate, of the
/// centre or the radius, are cut in the middle of it.
void group_neighbours(std::span<const TrackedBall> tracked, std::span<std::uint32_t> order) {
  if (order.size() <= kBallsOfWalk) return;
  const auto coordinate = [&](std::uint32_t ball, std::size_t axis) {
    return axis < 3 ? tracked[ball].ball.centre[axis] : tracked[ball].ball.radius;
  };
  double longest = -1;
  std::size_t along = 0;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const auto value = [&](std::uint32_t ball) { return coordinate(ball, axis); };
    const auto [least, most] = std::ranges::minmax_element(order, {}, value);
    const double extent = value(*most) - value(*least);
    if (extent <= longest) continue;
    longest = extent;
    along = axis;
  }
  const std::size_t groups = (order.size() + kBallsOfWalk - 1) / kBallsOfWalk, first = groups / 2 * kBallsOfWalk;
  // By their numbers, where coordinates are equal: one result with all libraries.
  std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(first), {},
                           [&](std::uint32_t ball) { return std::pair(coordinate(ball, along), ball); });
  group_neighbours(tracked, order.first(first));
  group_neighbours(tracked, order.subspan(first));
}

/// Links between balls that overlap little are long, so that short ways avoid them.
double length_of_link(const Ball& a, const Ball& b) {
  constexpr double kLittle = 0.2, kLong = 8;  // of the smaller radius
  const double overlap = a.radius + b.radius - length(a.centre - b.centre);
  return overlap > kLittle * std::min(a.radius, b.radius) ? 1 : kLong;
}

}  // namespace

Result<std::vector<std::uint32_t>> overlapping_parents(std::span<const Ball> balls, unsigned threads) {
  Result<BallUnion> measured = measure_ball_union(balls, BallUnionOptions{threads, true});
  if (!measured) return measured.error();
  std::vector<std::vector<std::uint32_t>> neighbours(balls.size());
  for (const auto& [a, b] : measured.value().complex.edges) {
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  const auto count = static_cast<std::uint32_t>(balls.size());
  std::vector<std::uint32_t> parents(count), links(count, 0), by_size(count);
  for (std::uint32_t i = 0; i < count; ++i) parents[i] = by_size[i] = i;
  std::ranges::stable_sort(by_size, std::greater{}, [&](std::uint32_t i) { return balls[i].radius; });
  std::vector<double> ways(count, std::numeric_limits<double>::infinity());
  using Reached = std::tuple<double, std::uint32_t>;  // the length of a way, and the ball at its end
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
  for (const std::uint32_t root : by_size) {
    if (ways[root] < std::numeric_limits<double>::infinity()) continue;
    next.emplace(ways[root] = 0, root);
    while (!next.empty()) {
      const auto [way, ball] = next.top();
      next.pop();
      if (way > ways[ball]) continue;
      links[ball] = parents[ball] == ball ? 0 : links[parents[ball]] + 1;
      if (links[ball] >= gpu::kMostFollowLinks) continue;  // balls beyond are roots of their own
      for (const std::uint32_t other : neighbours[ball]) {
        const double longer = way + length_of_link(balls[ball], balls[other]);
        if (!(longer < ways[other])) continue;
        parents[other] = ball;
        next.emplace(ways[other] = longer, other);
      }
    }
  }
  return parents;
}

Result<std::vector<gpu::FollowRest>> make_rest_balls(const MovingSurface& surface, std::span<const Ball> balls,
                                                     std::span<const std::uint32_t> places, double scale,
                                                     unsigned threads) {
  std::vector<TrackedBall> tracked(balls.size());
  parallel_for(balls.size(), kBallsAtATime, threads,
               [&](std::size_t i) { tracked[i] = tracked_at_rest(surface, balls[i]); });
  std::vector<std::uint32_t> order(balls.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  group_neighbours(tracked, order);
  std::vector<Ball> sorted(balls.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = tracked[order[i]].ball;
  Result<std::vector<std::uint32_t>> parents = overlapping_parents(sorted, threads);
  if (!parents) return parents.error();
  std::vector<gpu::FollowRest> rests;
  rests.reserve(balls.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    rests.push_back(packed_rest(surface, tracked[order[i]], places, scale));
    rests.back().parent = parents.value()[i];
    rests.back().index = order[i];
  }
  return rests;
}

}  // namespace medial_vk
