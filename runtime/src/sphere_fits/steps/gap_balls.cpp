#include "sphere_fits/steps/gap_balls.h"

#include "base/point_ops.h"
#include "sphere_fits/steps/ball_steps.h"
#include "sphere_fits/steps/maximal_ball.h"

namespace medial_vk {
namespace {

/// A point inside along the normal: at the depth, or half, or a quarter of it ...
std::optional<Point> point_along(const Solid& solid, const Point& at, const Point& inward, double depth) {
  for (int tries = 0; tries < 16; ++tries, depth /= 2) {
    const Point inside = at + depth * inward;
    if (solid.contains(inside)) return inside;
  }
  return std::nullopt;
}

/// The point half way to the balls, or, if that is outside, the point at that distance along the normal.
std::optional<Point> point_inside(const Solid& solid, const GapFinder::Gap& gap) {
  if (solid.contains(gap.towards_balls)) return gap.towards_balls;
  return point_along(solid, gap.at, gap.inward, 0.5 * gap.size);
}

/// The maximal ball through a point inside, if it is in the solid.
std::optional<Ball> ball_around(const Solid& solid, const Point& inside) {
  const Ball ball = maximal_ball(solid, inside);
  return ball.radius > 0 && stays_inside(solid, ball) ? std::optional(ball) : std::nullopt;
}

}  // namespace

std::optional<Ball> ball_in_widest_gap(const Solid& solid, GapFinder& gaps) {
  const GapFinder::Gap outer = gaps.widest_on_boundary(), inner = gaps.deepest_vertex();
  const std::optional<Point> inside = outer.size > inner.size ? point_inside(solid, outer) : inner.at;
  return inside && solid.contains(*inside) ? ball_around(solid, *inside) : std::nullopt;
}

std::vector<Ball> balls_at_vertices(const Solid& solid, GapFinder& gaps, std::span<const std::uint32_t> slots,
                                    WorkerPool& pool) {
  gaps.find_deepest(slots, pool);
  std::vector<std::optional<Ball>> found(slots.size());
  pool.run(slots.size(), 1, [&](std::size_t k) {
    const std::optional<Point> vertex = gaps.deepest_vertex(slots[k]);
    if (vertex && solid.contains(*vertex)) found[k] = ball_around(solid, *vertex);
  });
  std::vector<Ball> balls;
  for (const std::optional<Ball>& ball : found) {
    if (ball) balls.push_back(*ball);
  }
  return balls;
}

std::optional<Ball> largest_at_samples(const Solid& solid, const GapFinder& gaps) {
  constexpr double kDepth = 1e-3;  // of the diagonal, below the boundary, where the balls start
  std::optional<Ball> largest;
  for (const GapFinder::Sample& sample : gaps.samples()) {
    const std::optional<Point> inside = point_along(solid, sample.at, sample.inward, kDepth * solid.diagonal());
    if (!inside) continue;
    const std::optional<Ball> ball = ball_around(solid, *inside);
    if (ball && (!largest || ball->radius > largest->radius)) largest = ball;
  }
  return largest;
}

}  // namespace medial_vk
