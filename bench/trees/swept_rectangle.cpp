#include "swept_rectangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "principal_axes.h"

namespace medial_vk::bench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A disc in the plane of a rectangle, which holds the ball in its swept sphere if it meets the rectangle.
struct Disc {
  double x, y, reach;
};

/// From `low` to `high`, which meet the disc of each ball.
struct Rectangle {
  std::array<double, 2> low = {kInfinity, kInfinity}, high = {-kInfinity, -kInfinity};
};

/// The part of the volume of a swept sphere that grows with the rectangle.
double volume_of(double width, double height, double radius) {
  return 2 * radius * width * height + std::numbers::pi * radius * radius * (width + height);
}

/// Moves the sides of one corner outwards as the volume grows least, until it meets the disc. `toward` is -1 or 1.
void reach_from_corner(Rectangle& rectangle, const Disc& disc, double toward_x, double toward_y, double radius) {
  double& x = toward_x > 0 ? rectangle.high[0] : rectangle.low[0];
  double& y = toward_y > 0 ? rectangle.high[1] : rectangle.low[1];
  const double dx = toward_x * (disc.x - x), dy = toward_y * (disc.y - y);
  if (dx <= 0 || dy <= 0 || dx * dx + dy * dy <= disc.reach * disc.reach) return;
  const double width = rectangle.high[0] - rectangle.low[0], height = rectangle.high[1] - rectangle.low[1];
  double best = kInfinity, by_x = dx, by_y = dy;
  // The corner comes to rest on the disc's circle, at one of these directions from the middle.
  constexpr int kDirections = 16;
  for (int i = 0; i <= kDirections; ++i) {
    const double angle = std::numbers::pi / 2 * i / kDirections;
    const double u = std::max(0.0, dx - disc.reach * std::cos(angle)),
                 v = std::max(0.0, dy - disc.reach * std::sin(angle));
    const double grown = volume_of(width + u, height + v, radius);
    if (grown < best) best = grown, by_x = u, by_y = v;
  }
  x += toward_x * by_x;
  y += toward_y * by_y;
}

/// A small rectangle that meets all discs.
Rectangle rectangle_of(const std::vector<Disc>& discs, double radius) {
  Rectangle rectangle;
  for (std::size_t k = 0; k < 2; ++k) {
    double &low = rectangle.low[k], &high = rectangle.high[k];
    for (const Disc& disc : discs) {
      const double at = k == 0 ? disc.x : disc.y;
      low = std::min(low, at + disc.reach);
      high = std::max(high, at - disc.reach);
    }
    if (low > high) low = high = (low + high) / 2;
  }
  for (const Disc& disc : discs) {
    for (const double toward_x : {-1.0, 1.0}) {
      for (const double toward_y : {-1.0, 1.0}) reach_from_corner(rectangle, disc, toward_x, toward_y, radius);
    }
  }
  return rectangle;
}

/// With the rectangle across axes[2]. The radius is the least for which a slab of twice its width holds the balls; once
/// the rectangle is known, it is what the farthest point of a ball needs.
SweptRectangle fitted(std::span<const Ball> balls, std::span<const std::uint32_t> chosen, const Point& origin,
                      const std::array<Point, 3>& axes) {
  double low = kInfinity, high = -kInfinity;
  const auto along = [&](std::size_t k, std::uint32_t i) { return dot(axes[k], balls[i].centre - origin); };
  for (const std::uint32_t i : chosen) {
    low = std::min(low, along(2, i) - balls[i].radius);
    high = std::max(high, along(2, i) + balls[i].radius);
  }
  const double radius = (high - low) / 2, middle = (low + high) / 2;
  std::vector<Disc> discs;
  for (const std::uint32_t i : chosen) {
    const double room = radius - balls[i].radius, z = along(2, i) - middle;
    discs.push_back({along(0, i), along(1, i), std::sqrt(std::max(0.0, room * room - z * z))});
  }
  const Rectangle rectangle = rectangle_of(discs, radius);
  SweptRectangle swept;
  swept.axes = axes;
  swept.corner = origin + rectangle.low[0] * axes[0] + rectangle.low[1] * axes[1] + middle * axes[2];
  for (std::size_t k = 0; k < 2; ++k) swept.sides[k] = rectangle.high[k] - rectangle.low[k];
  for (const std::uint32_t i : chosen) {
    swept.radius = std::max(swept.radius, distance_to_rectangle(swept, balls[i].centre) + balls[i].radius);
  }
  return swept;
}

}  // namespace

double SweptRectangle::size() const { return radius + std::hypot(sides[0], sides[1]) / 2; }

double SweptRectangle::volume() const {
  return volume_of(sides[0], sides[1], radius) + 4 * std::numbers::pi / 3 * radius * radius * radius;
}

SweptRectangle SweptRectangle::around(std::span<const Ball> balls, std::span<const std::uint32_t> chosen) {
  if (chosen.size() == 1) {
    SweptRectangle swept;
    swept.corner = balls[chosen.front()].centre;
    swept.radius = balls[chosen.front()].radius;
    return swept;
  }
  const PrincipalAxes spread(balls, chosen);
  SweptRectangle best;
  double least = kInfinity;
  for (std::size_t normal = 0; normal < 3; ++normal) {
    std::array<Point, 3> axes = spread.axes;
    std::swap(axes[normal], axes[2]);
    const SweptRectangle swept = fitted(balls, chosen, spread.centroid, axes);
    if (swept.volume() < least) best = swept, least = swept.volume();
  }
  return best;
}

double distance_to_rectangle(const SweptRectangle& rectangle, const Point& p) {
  const Point from = p - rectangle.corner;
  std::array<double, 3> beyond = {0, 0, dot(rectangle.axes[2], from)};
  for (std::size_t k = 0; k < 2; ++k) {
    const double x = dot(rectangle.axes[k], from);
    beyond[k] = x - std::clamp(x, 0.0, rectangle.sides[k]);
  }
  return std::hypot(beyond[0], beyond[1], beyond[2]);
}

}  // namespace medial_vk::bench
