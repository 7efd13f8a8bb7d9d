#include "proximity/pair_query.h"

#include <algorithm>

#include "proximity/groups/smallest_ball_centre.h"
#include "proximity/placement.h"

namespace medial_vk {
namespace {

constexpr std::size_t kStepsAround = 128;

template <class ForBalls>
Ball ball_around(const Point& first, const ForBalls& for_balls) {
  Ball ball = {near_smallest_ball_centre(first, kStepsAround, for_balls), 0};
  double size = 0;
  for_balls([&](const Point& centre, double radius) {
    ball.radius = std::max(ball.radius, length(centre - ball.centre) + radius);
    size = std::max(size, length(centre));
  });
  ball.radius = ball.radius * (1 + 0x1p-50) + 0x1p-52 * (size + length(ball.centre));
  return ball;
}

}  // namespace

bool find_ball_around(const Body& body, Ball& ball) {
  const BodyImpl& in = Internals::of(body);
  if (in.surface) {
    const Mesh& mesh = in.surface->solid.mesh().mesh;
    ball = ball_around(mesh.vertices[mesh.triangles.front()[0]], [&](const auto& visit) {
      for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t v : triangle) visit(mesh.vertices[v], 0.0);
      }
    });
    return true;
  }
  if (in.cover.empty()) return false;
  ball = ball_around(in.cover.front().centre, [&](const auto& visit) {
    for (const auto& [centre, radius] : in.cover) visit(centre, radius);
  });
  return true;
}

PairQuery::PairQuery(const Body& a, const Body& b, const Pose& pose, double error)
    : in_a_(Internals::of(a)), in_b_(Internals::of(b)), placement_(in_a_, in_b_, pose, error) {}

bool PairQuery::has_covers() const { return !in_a_.cover_tree.is_empty() && !in_b_.cover_tree.is_empty(); }
bool PairQuery::has_insides() const { return !in_a_.inside_tree.is_empty() && !in_b_.inside_tree.is_empty(); }

double PairQuery::lower_bound(double most, BallPair& pair) const {
  return medial_vk::lower_bound(in_a_.cover_tree, in_b_.cover_tree, placement_, most, pair);
}

double PairQuery::upper_bound(double most, BallPair& pair) const {
  return medial_vk::upper_bound(in_a_, in_b_, placement_, most, pair);
}

Distance PairQuery::distance(const DistanceOptions& options, const Distance& start, const std::stop_token& stop) const {
  return distance_of(in_a_, in_b_, placement_, options, start, stop);
}

}  // namespace medial_vk
