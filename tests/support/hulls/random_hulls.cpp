#include "support/hulls/random_hulls.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk::test {
namespace {

double between(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Point random_point(std::mt19937_64& random) {
  Point p{};
  for (double& x : p) x = between(-1, 1, random);
  return p;
}

template <class Family>
Family any_of(std::mt19937_64& random) {
  return static_cast<Family>(random() % static_cast<std::uint64_t>(Family::kCount));
}

/// A point of the axis, often an end.
Point on_axis(const BallHull& hull, std::mt19937_64& random) {
  Point p = hull.corners[0].centre;
  for (std::uint32_t i = 1; i < hull.count; ++i) {
    const double share = random() % 4 == 0 ? 0 : between(0, 1, random);
    p = p + share * (hull.corners[i].centre - p);
  }
  return p;
}

void move(const Point& by, BallHull& hull) {
  for (Ball& ball : hull.corners) ball.centre = ball.centre + by;
}

}  // namespace

BallHull random_hull(std::uint32_t count, HullFamily family, std::mt19937_64& random) {
  BallHull hull = {};  // pairs use corners that it does not have, too
  hull.count = count;
  for (std::uint32_t i = 0; i < count; ++i) {
    hull.corners[i].centre = random_point(random);
    hull.corners[i].radius = between(0, 0.5, random);
  }
  Ball &first = hull.corners[0], &last = hull.corners[count - 1];
  switch (family) {
    case HullFamily::kGeneral:
    case HullFamily::kCount:
      break;
    case HullFamily::kEqualRadii:
      for (Ball& ball : hull.corners) ball.radius = first.radius;
      break;
    case HullFamily::kZeroRadii:
      last.radius = 0;
      if (random() % 2 == 0) {
        for (Ball& ball : hull.corners) ball.radius = 0;
      }
      break;
    case HullFamily::kNested:
      last.radius = first.radius * between(0, 1, random);
      last.centre = first.centre + between(0, 1, random) * (first.radius - last.radius) * Point{0.6, 0, 0.8};
      break;
    case HullFamily::kEqualBalls:
      last = first;
      break;
    case HullFamily::kSameCentre:
      last.centre = first.centre;
      break;
    case HullFamily::kCollinear:
    case HullFamily::kThin:
      if (count < 3) break;
      last.centre = first.centre + between(-0.5, 1.5, random) * (hull.corners[1].centre - first.centre);
      if (family == HullFamily::kThin) {
        const double exponent = between(-17, -1, random);
        last.centre = last.centre + std::pow(10, exponent) * random_point(random);
      }
      break;
    case HullFamily::kNearlyNested: {
      const double exponent = between(-16, -2, random);
      const double growth = (1 - std::pow(10, exponent)) * length(last.centre - first.centre);
      last.radius = first.radius + growth;
      break;
    }
  }
  if (random() % 2 == 0) std::swap(first, last);
  return hull;
}

BallHull random_hull(std::uint32_t count, std::mt19937_64& random) {
  return random_hull(count, any_of<HullFamily>(random), random);
}

HullPair random_pair(std::uint32_t first_count, std::uint32_t second_count, PairFamily family,
                     std::mt19937_64& random) {
  HullPair pair;
  pair.first = random_hull(first_count, random);
  pair.second = random_hull(second_count, random);
  BallHull &a = pair.first, &b = pair.second;
  switch (family) {
    case PairFamily::kGeneral:
    case PairFamily::kCount:
      break;
    case PairFamily::kApart:
      move(4.0 * random_point(random), b);
      break;
    case PairFamily::kParallel:
      b.corners[1].centre = b.corners[0].centre + between(-2, 2, random) * (a.corners[1].centre - a.corners[0].centre);
      break;
    case PairFamily::kCrossing: {
      const Point target = on_axis(a, random), own = on_axis(b, random);
      move(target - own, b);
      break;
    }
    case PairFamily::kCoplanar:
      for (Ball& ball : a.corners) ball.centre[2] = 0;
      for (Ball& ball : b.corners) ball.centre[2] = 0;
      break;
    case PairFamily::kSharedBall:
      b.corners[0] = a.corners[first_count - 1];
      break;
    case PairFamily::kTheSame:
      if (first_count == second_count) b = a;
      break;
    case PairFamily::kFlat: {
      const double height = between(-1, 1, random), radius = a.corners[0].radius;
      for (Ball& ball : a.corners) ball = {{ball.centre[0], ball.centre[1], 0}, radius};
      for (Ball& ball : b.corners) ball = {{ball.centre[0], ball.centre[1], height}, radius};
      break;
    }
  }
  return pair;
}

std::vector<reference::HullBall> reference_hull(const BallHull& hull) {
  std::vector<reference::HullBall> balls;
  for (const Ball& ball : hull.balls())
    balls.push_back({{ball.centre[0], ball.centre[1], ball.centre[2]}, ball.radius});
  return balls;
}

double distance_rounding(const BallHull& first, const BallHull& second) {
  double size = 0;
  for (const BallHull* hull : {&first, &second}) {
    for (const Ball& ball : hull->balls()) {
      for (const double x : ball.centre) size = std::max(size, std::fabs(x));
      size = std::max(size, ball.radius);
      for (const BallHull* other : {&first, &second}) {
        for (const Ball& to : other->balls()) size = std::max(size, length(to.centre - ball.centre));
      }
    }
  }
  return 64 * 0x1p-53 * size;
}

}  // namespace medial_vk::test
