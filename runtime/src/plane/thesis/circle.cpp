#include "plane/thesis/circle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

namespace medial_vk::plane {
namespace {

bool are_same(Vec2 a, Vec2 b) { return distance(a, b) <= kSamePoint; }

/// The other point in which the line through x along `direction` meets the circle.
Vec2 opposite_on_circle(Vec2 x, Vec2 direction, Vec2 centre) { return x - 2 * dot(direction, x - centre) * direction; }

/// -1, 0 or 1: the side of the line from a to b on which a gradient points; 0 where rounding decides.
int side_of_line(Vec2 a, Vec2 b, Vec2 gradient) {
  const double product = cross(b - a, gradient);
  return product > kSamePoint ? 1 : product < -kSamePoint ? -1 : 0;
}

bool to_different_sides(const Sample& a, const Sample& b) {
  return side_of_line(a.at, b.at, a.foot.direction) * side_of_line(a.at, b.at, b.foot.direction) < 0;
}

/// How far a gradient is from the direction between two points of Theta.
double misalignment(const Sample& a, const Sample& b) { return std::fabs(cross(b.at - a.at, a.foot.direction)); }

/// Of neighbours in Theta, a before b: a point of Theta between their opposites, if there is one.
std::optional<std::uint32_t> point_between(std::span<const Sample> theta, std::uint32_t a, std::uint32_t b) {
  const auto size = static_cast<std::uint32_t>(theta.size());
  const auto after_a = [&](std::uint32_t i) { return (i + size - a) % size; };
  const std::uint32_t from = theta[b].opposite, to = theta[a].opposite;
  // Segments to opposites do not cross (Corollary 4.1), except where rounding decides about line 3.
  if (from == a || to == b || after_a(to) <= after_a(from) + 1) return {};
  return (from + 1) % size;
}

}  // namespace

std::vector<double> equal_angles(unsigned samples) {
  std::vector<double> angles;
  angles.reserve(samples);
  for (unsigned i = 0; i < samples; ++i) angles.push_back(2 * std::numbers::pi * i / samples);
  return angles;
}

std::vector<Sample> sample_circle(const BoundaryTree& tree, Vec2 centre, double radius,
                                  std::span<const double> angles) {
  std::vector<Sample> all;
  all.reserve(2 * angles.size());
  for (const double angle : angles) {
    const Vec2 x = centre + radius * Vec2{std::cos(angle), std::sin(angle)};
    const Foot foot = tree.nearest(x);
    const Vec2 y = opposite_on_circle(x, foot.direction, centre);
    const auto index = static_cast<std::uint32_t>(all.size());
    all.push_back({x, foot, index + 1});
    all.push_back({y, tree.nearest(y), index});
  }
  struct Ranked {
    double angle;
    std::uint32_t index;
  };
  std::vector<Ranked> order;
  order.reserve(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const Vec2 from = all[i].at - centre;
    order.push_back({std::atan2(from.y, from.x), i});
  }
  std::ranges::sort(order,
                    [](Ranked a, Ranked b) { return std::pair(a.angle, a.index) < std::pair(b.angle, b.index); });
  std::vector<Sample> theta;
  theta.reserve(all.size());
  std::vector<std::uint32_t> position(all.size());
  for (const Ranked& ranked : order) {
    const Sample& sample = all[ranked.index];
    if (theta.empty() || !are_same(theta.back().at, sample.at)) theta.push_back(sample);
    position[ranked.index] = static_cast<std::uint32_t>(theta.size() - 1);
  }
  while (theta.size() > 1 && are_same(theta.front().at, theta.back().at)) {
    for (std::uint32_t& p : position) p = p == theta.size() - 1 ? 0 : p;
    theta.pop_back();
  }
  for (Sample& sample : theta) sample.opposite = position[sample.opposite];
  return theta;
}

std::vector<Finding> decide(std::span<const Sample> theta) {
  std::vector<Finding> found;
  const auto size = static_cast<std::uint32_t>(theta.size());
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t j = theta[i].opposite;
    if ((i < j || theta[j].opposite != i) && !are_same(theta[i].foot.at, theta[j].foot.at)) {
      // From the sample, along whose gradient the segment runs, to its opposite.
      const bool is_forward = misalignment(theta[i], theta[j]) <= misalignment(theta[j], theta[i]);
      found.push_back({DecisionReason::kOppositeDiffers, is_forward ? i : j, is_forward ? j : i});
    }
  }
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t j = (i + 1) % size;
    if (theta[i].opposite == j || theta[j].opposite == i || !to_different_sides(theta[i], theta[j])) continue;
    found.push_back({DecisionReason::kDifferentSides, i, j});
  }
  if (!found.empty()) return found;
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t j = (i + 1) % size;
    if (const std::optional<std::uint32_t> c = point_between(theta, i, j)) {
      found.push_back({DecisionReason::kPointsBetween, to_different_sides(theta[i], theta[*c]) ? i : j, *c});
    }
  }
  return found;
}

Retraction retract(const BoundaryTree& tree, std::span<const Sample> theta, const Finding& finding, double epsilon) {
  Vec2 p = theta[finding.a].at, q = theta[finding.b].at;
  Foot first = theta[finding.a].foot, second = theta[finding.b].foot;
  // Algorithm 1; between neighbours, the part whose ends have gradients to different sides holds a medial point.
  const Vec2 from = p, to = q;
  const auto goes_on_at = [&](const Foot& foot) {
    if (finding.reason == DecisionReason::kOppositeDiffers) return are_same(foot.at, first.at);
    return side_of_line(from, to, foot.direction) == side_of_line(from, to, first.direction);
  };
  while (distance(p, q) > epsilon) {
    const Vec2 middle = 0.5 * (p + q);
    if (middle == p || middle == q) break;
    const Foot foot = tree.nearest(middle);
    if (goes_on_at(foot)) {
      p = middle;
      first = foot;
    } else {
      q = middle;
      second = foot;
    }
  }
  return {p, first, second};
}

}  // namespace medial_vk::plane
