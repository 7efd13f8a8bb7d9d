#include "hull_fits/search/hull_moves.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "sphere_fits/steps/maximal_ball.h"

namespace medial_vk {
namespace {

/// Of the distances between corners that do not see each other.
constexpr int kMostHalvings = 4;

double uniform(SplitMix& random) { return 0.5 * (random.symmetric() + 1); }

/// A vector with independent components of mean 0 and variance 1, nearly normal.
Point vector_at_random(SplitMix& random) {
  Point v;
  for (double& x : v) {
    x = 0;
    for (int i = 0; i < 3; ++i) x += random.symmetric();
  }
  return v;
}

}  // namespace

/// Of a few uncovered seeds, the one whose distance is nearest to a length that is drawn from all scales.
Point HullMoves::far_seed(const Ball& from, SplitMix& random) const {
  constexpr int kDraws = 8;
  const double shortest = std::log(0.5 * from.radius), longest = std::log(solid_.diagonal());
  const double wanted = shortest + uniform(random) * (longest - shortest);
  Point best = from.centre;
  double least = HUGE_VAL;
  for (int i = 0; i < kDraws; ++i) {
    const Ball& seed = seeds_.draw(random);
    const double distance = length(seed.centre - from.centre);
    if (!(distance > 0)) continue;
    const double difference = std::fabs(std::log(distance) - wanted);
    if (difference < least) {
      least = difference;
      best = seed.centre;
    }
  }
  return best;
}

std::optional<BallHull> HullMoves::propose(SplitMix& random) const {
  const Ball& first = seeds_.draw(random);
  std::array<Point, 3> centres = {first.centre};
  for (std::uint32_t i = 1; i < shape_.corners; ++i) centres[i] = far_seed(first, random);
  for (int halvings = 0;; ++halvings) {
    if (const std::optional<BallHull> hull = fit(centres)) return hull;
    if (halvings == kMostHalvings || shape_.corners == 1) return std::nullopt;
    for (std::uint32_t i = 1; i < shape_.corners; ++i) {
      centres[i] = 0.5 * (centres[0] + centres[i]);
      if (!snap(centres[i])) centres[i] = centres[0] + 1e-3 * first.radius * vector_at_random(random);
    }
  }
}

/// Moves a point of the solid to the centre of a ball that holds it and cannot grow; false outside of the solid.
bool HullMoves::snap(Point& p) const {
  if (!solid_.contains(p)) return false;
  const Ball ball = maximal_ball(solid_, p);
  if (ball.radius > 0) p = ball.centre;
  return true;
}

std::optional<BallHull> HullMoves::change(const BallHull& hull, double step, SplitMix& random,
                                          const IsPromising& is_promising) const {
  std::array<Point, 3> centres = {};
  for (std::uint32_t i = 0; i < hull.count; ++i) centres[i] = hull.corners[i].centre;
  const auto pick = [&](std::uint32_t count) {
    return std::min(static_cast<std::uint32_t>(uniform(random) * count), count - 1);
  };
  const std::uint32_t moved = pick(hull.count);
  const double kind = uniform(random);
  const bool snaps = uniform(random) < 0.7;
  if (hull.count > 1 && kind < 0.35) {  // along an edge, which stays in a flat sheet
    const std::uint32_t other = (moved + 1 + pick(hull.count - 1)) % hull.count;
    const Point edge = centres[moved] - centres[other];
    centres[moved] = centres[moved] + step * vector_at_random(random)[0] * edge;
    if (snaps && !snap(centres[moved])) return std::nullopt;
  } else if (kind < 0.8) {
    const double reach = step * std::max(hull.corners[moved].radius, radii_.least());
    centres[moved] = centres[moved] + reach * vector_at_random(random);
    if (snaps && !snap(centres[moved])) return std::nullopt;
  } else if (kind < 0.92) {
    const Point shift = step * hull.corners[moved].radius * vector_at_random(random);
    for (std::uint32_t i = 0; i < hull.count; ++i) {
      centres[i] = centres[i] + shift;
      if (snaps && !snap(centres[i])) return std::nullopt;
    }
  } else if (hull.count > 1) {
    centres[moved] = far_seed(hull.corners[(moved + 1) % hull.count], random);
  } else {
    centres[moved] = seeds_.draw(random).centre;
  }
  return fit(centres, is_promising);
}

}  // namespace medial_vk
