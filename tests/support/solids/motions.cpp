#include "support/solids/motions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace medial_vk::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// Turns the coordinates i and j of a point.
void turn(Point& p, std::size_t i, std::size_t j, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), x = p[i], y = p[j];
  p[i] = c * x - s * y;
  p[j] = s * x + c * y;
}

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Relative to the middle of the box, with the longest side along axis 0, in units of its length.
void twist(Point& p, double time) { turn(p, 1, 2, 60 * kDegree * time * p[0]); }

void bend(Point& p, double time) {
  const double angle = 90 * kDegree * time;
  if (angle == 0) return;
  const double radius = 1 / angle, at = angle * p[0], from_middle = radius - p[1];
  p[0] = from_middle * std::sin(at);
  p[1] = radius - from_middle * std::cos(at);
}

void squash(Point& p, double time) {
  const double along = 1 - 0.2 * time;
  p[0] *= along;
  p[1] /= std::sqrt(along);
  p[2] /= std::sqrt(along);
}

void move_limb(Point& p, double time) {
  constexpr double kJoint = 1.0 / 6, kBlend = 0.4;
  const double share = smooth_step((p[0] - kJoint) / kBlend + 0.5);
  p[0] -= kJoint;
  turn(p, 0, 1, 45 * kDegree * time * share);
  p[0] += kJoint;
}

/// The determinant of the derivative is 1 + (2 pi 0.12 time)^3 times three cosines, so at least 0.57.
void ripple(Point& p, double time) {
  constexpr double kLength = 0.1, kHeight = 0.012;
  const auto wave = [&](double x) { return kHeight * time * std::sin(2 * std::numbers::pi * x / kLength); };
  p = {p[0] + wave(p[1]), p[1] + wave(p[2]), p[2] + wave(p[0])};
}

void move(Point& p, Motion motion, double time) {
  switch (motion) {
    case Motion::kTwist:
      return twist(p, time);
    case Motion::kBend:
      return bend(p, time);
    case Motion::kSquash:
      return squash(p, time);
    case Motion::kLimb:
      return move_limb(p, time);
    case Motion::kRipple:
      return ripple(p, time);
  }
}

}  // namespace

const char* name_of(Motion motion) {
  constexpr std::array kNames = {"twist", "bend", "squash", "limb", "ripple"};
  return kNames[static_cast<std::size_t>(motion)];
}

std::vector<Point> moved_vertices(std::span<const Point> rest, Motion motion, double time) {
  Point lower = rest[0], upper = rest[0];
  for (const Point& p : rest) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
  const Point sides = {upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]};
  const auto longest = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
  std::vector<Point> out;
  out.reserve(rest.size());
  for (const Point& p : rest) {
    Point local{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t axis = (longest + k) % 3;
      local[k] = (p[axis] - (lower[axis] + upper[axis]) / 2) / sides[longest];
    }
    move(local, motion, time);
    Point moved{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t axis = (longest + k) % 3;
      moved[axis] = local[k] * sides[longest] + (lower[axis] + upper[axis]) / 2;
    }
    out.push_back(moved);
  }
  return out;
}

}  // namespace medial_vk::test
