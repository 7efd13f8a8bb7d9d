// The farthest point outside of the smallest ball around a few points joins them, and points that no longer support the
// ball leave (the pivot rule of B. Gaertner, "Fast and robust smallest enclosing balls", 1999). The radius grows with
// every round, so no set of points recurs.
#include "sphere_fits/cover/smallest_ball.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr double kSlack = 1e-12;  // relative
constexpr int kRounds = 200;      // many times the usual number; a round without gain ends the loop earlier

/// Up to five points; a frame of a motion allocates no memory for them.
class FewPoints {
 public:
  FewPoints() = default;
  FewPoints(const Point& a, const Point& b) : points_{a, b}, size_(2) {}

  void push_back(const Point& p) { points_[size_++] = p; }
  std::size_t size() const { return size_; }
  const Point& operator[](std::size_t i) const { return points_[i]; }
  const Point* begin() const { return points_.data(); }
  const Point* end() const { return points_.data() + size_; }

 private:
  std::array<Point, 5> points_ = {};
  std::size_t size_ = 0;
};

struct Sphere {
  Point centre{};
  double squared = std::numeric_limits<double>::infinity();
};

/// The ball through all given points, two to four, with its centre in their affine hull. Infinite if they are no
/// simplex.
Sphere circumsphere(const FewPoints& p) {
  Sphere sphere;
  const Point a = p[1] - p[0];
  if (p.size() == 2) {
    sphere.centre = 0.5 * (p[0] + p[1]);
    sphere.squared = dot(a, a) / 4;
    return sphere;
  }
  const Point b = p[2] - p[0], n = cross(a, b);
  const double aa = dot(a, a), bb = dot(b, b);
  Point from{};
  if (p.size() == 3) {
    const double area = dot(n, n);
    if (!(area > 1e-24 * aa * bb)) return sphere;
    from = (0.5 / area) * (aa * cross(b, n) + bb * cross(n, a));
  } else {
    const Point c = p[3] - p[0];
    const double cc = dot(c, c), volume = dot(n, c);
    if (!(volume * volume > 1e-24 * aa * bb * cc)) return sphere;
    from = (0.5 / volume) * (aa * cross(b, c) + (bb * cross(c, a) + cc * n));
  }
  sphere.centre = p[0] + from;
  sphere.squared = dot(from, from);
  return sphere;
}

bool holds(const Sphere& sphere, const FewPoints& points) {
  return std::ranges::all_of(points, [&](const Point& p) {
    const Point d = p - sphere.centre;
    return dot(d, d) <= sphere.squared * (1 + 4 * kSlack);
  });
}

/// The smallest ball of up to five points, by trials of all subsets; `points` becomes the subset that supports the
/// ball.
Sphere of_few(FewPoints& points) {
  Sphere best;
  FewPoints support;
  for (unsigned set = 1; set < (1u << points.size()); ++set) {
    FewPoints chosen;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if ((set >> k & 1u) != 0) chosen.push_back(points[k]);
    }
    if (chosen.size() < 2 || chosen.size() > 4) continue;
    const Sphere sphere = circumsphere(chosen);
    if (sphere.squared < best.squared && holds(sphere, points)) {
      best = sphere;
      support = chosen;
    }
  }
  points = support;
  return best;
}

std::size_t farthest(std::span<const Point> points, const Point& from, double& squared) {
  std::size_t at = 0;
  squared = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point d = points[i] - from;
    const double here = dot(d, d);
    if (here > squared) {
      squared = here;
      at = i;
    }
  }
  return at;
}

}  // namespace

Ball smallest_ball(std::span<const Point> points) {
  double squared = 0;
  const std::size_t first = farthest(points, points[0], squared);
  if (squared == 0) return {points[0], 0};
  FewPoints support(points[0], points[first]);
  Sphere sphere = of_few(support);
  Point best = sphere.centre;
  double best_squared = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const std::size_t out = farthest(points, sphere.centre, squared);
    if (squared < best_squared) {
      best_squared = squared;
      best = sphere.centre;
    }
    if (squared <= sphere.squared * (1 + kSlack)) break;
    FewPoints with = support;
    with.push_back(points[out]);
    const Sphere next = of_few(with);
    if (!(next.squared > sphere.squared) || !std::isfinite(next.squared)) break;
    sphere = next;
    support = with;
  }
  double radius = 0;
  for (const Point& p : points) radius = std::max(radius, length(p - best));
  return {best, radius};
}

}  // namespace medial_vk
