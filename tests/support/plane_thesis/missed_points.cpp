#include "support/plane_thesis/missed_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plane/sites/vec2.h"

namespace medial_vk::test {
namespace {

using plane::Vec2;

constexpr double kNone = std::numeric_limits<double>::infinity();

Vec2 vec(PlanePoint p) { return {p[0], p[1]}; }

PlanePoint foot_on(const PreparedShape& shape, PlaneContact contact, PlanePoint x) {
  if (contact.is_point) return shape.points[contact.index];
  const auto& [a, b] = shape.segments[contact.index];
  const Vec2 from = vec(shape.points[a]), along = vec(shape.points[b]) - from;
  const double share = std::clamp(plane::dot(vec(x) - from, along) / plane::dot(along, along), 0.0, 1.0);
  const Vec2 foot = from + share * along;
  return {foot.x, foot.y};
}

double distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double squared = plane::dot(along, along);
  const double share = squared > 0 ? std::clamp(plane::dot(p - a, along) / squared, 0.0, 1.0) : 0;
  return plane::distance(p, a + share * along);
}

/// The arc sine, and pi / 2 beyond 1, where it is no bound.
double arc_sine(double x) { return std::asin(std::min(1.0, x)); }

}  // namespace

double greatest_dip(double rest, double reach) {
  if (!(rest > 0)) return kNone;
  const double share = reach / rest;
  return reach * (share + std::hypot(1, share));
}

MedialPoint medial_point(const PreparedShape& shape, const AxisArc& arc, double t) {
  MedialPoint p;
  p.point = arc.curve.point_at(t);
  for (std::size_t i = 0; i < 2; ++i) p.feet[i] = foot_on(shape, arc.contacts[i], p.point);
  p.distance = arc.curve.radius_at(t);
  p.angle = plane::angle_between(vec(p.feet[0]) - vec(p.point), vec(p.feet[1]) - vec(p.point));
  return p;
}

CombedCircle::CombedCircle(const PlaneCircle& circle, std::span<const CirclePoint> theta)
    : circle_(circle), theta_(theta) {
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const Vec2 a = vec(theta[i].point), b = vec(theta[(i + 1) % theta.size()].point);
    const double half_chord = plane::distance(a, b) / 2;
    longest_gap_ = std::max(longest_gap_, 2 * circle.radius * arc_sine(half_chord / circle.radius));
  }
}

bool CombedCircle::hull_contains(PlanePoint p) const {
  for (std::size_t i = 0; i < theta_.size(); ++i) {
    const Vec2 a = vec(theta_[i].point), b = vec(theta_[(i + 1) % theta_.size()].point);
    if (plane::cross(b - a, vec(p) - a) < 0) return false;
  }
  return theta_.size() >= 3;
}

bool CombedCircle::is_tail(std::uint32_t i) const {
  return plane::dot(vec(theta_[i].nearest.direction), vec(theta_[i].point) - vec(circle_.centre)) < 0;
}

CombedCircle::Exit CombedCircle::exit_of(const MedialPoint& p, int spoke) const {
  const Vec2 from = vec(p.point), along = plane::unit(vec(p.feet[static_cast<std::size_t>(spoke)]) - from);
  Exit exit;
  exit.dip = kNone;
  for (std::uint32_t i = 0; i < theta_.size(); ++i) {
    const Vec2 a = vec(theta_[i].point), b = vec(theta_[(i + 1) % theta_.size()].point);
    const Vec2 edge = b - a;
    const double speed = plane::cross(along, edge);  // positive where the ray leaves
    if (!(speed > 0)) continue;
    const double dip = plane::cross(a - from, edge) / speed;
    if (dip >= exit.dip) continue;
    const Vec2 at = from + dip * along;
    exit = {i, dip, 0, std::sqrt(plane::distance(at, a) * plane::distance(at, b)), 0, 0, 0};
  }
  const Vec2 a = vec(theta_[exit.edge].point), b = vec(theta_[(exit.edge + 1) % theta_.size()].point);
  const Vec2 foot = vec(p.feet[static_cast<std::size_t>(spoke)]);
  exit.depth = std::max(0.0, plane::cross(b - a, from - a) / plane::distance(a, b));
  exit.bend = plane::angle_between(from - a, b - from);
  exit.view = plane::angle_between(a - foot, b - foot);
  exit.dip = std::max(0.0, exit.dip);
  exit.rest = p.distance - exit.dip;
  return exit;
}

std::array<double, 6> CombedCircle::published_shares(const MedialPoint& p) const {
  const double gap = longest_gap_;
  const double angle = std::asin(std::min(1.0, gap / (2 * circle_.radius))) + arc_sine(gap / p.distance);
  const Exit a = exit_of(p, 0), b = exit_of(p, 1);
  return {p.distance / (2 * gap),
          p.distance < gap ? 0 : p.angle / angle,
          a.dip / gap,
          b.dip / gap,
          a.rest / gap,
          b.rest / gap};
}

std::array<double, 4> CombedCircle::corollary_shares(const MedialPoint& p) const {
  const double half_turn = longest_gap_ / (2 * circle_.radius);
  const double width = 2 * circle_.radius * std::sin(half_turn);
  const auto dip_share = [&](const Exit& exit) {
    const double bend = (half_turn + arc_sine(width / exit.rest)) / 2;
    return std::max(exit.depth / (width / 2 * std::tan(bend / 2)), exit.dip / greatest_dip(exit.rest, width / 2));
  };
  return {p.distance / width, p.distance < width ? 0 : p.angle / (half_turn + arc_sine(width / p.distance)),
          dip_share(exit_of(p, 0)), dip_share(exit_of(p, 1))};
}

double CombedCircle::with_the_flow(const MedialPoint& p, std::uint32_t edge) const {
  const std::uint32_t next = (edge + 1) % static_cast<std::uint32_t>(theta_.size());
  std::array<double, 2> turns = {};  // xi
  double sum = 0, farthest = 0;
  std::array<Vec2, 2> flows;
  const Vec2 at = vec(p.point);
  for (std::size_t side = 0; side < 2; ++side) {
    const CirclePoint& head = theta_[side == 0 ? edge : next];
    const Vec2 tail = vec(theta_[head.opposite].point);
    flows[side] = vec(head.nearest.direction);
    const double off = std::fabs(plane::cross(flows[side], at - vec(head.point)));
    farthest = std::max(farthest, distance_to_segment(at, tail, vec(head.point)));
    const double lean = std::atan2(off, plane::dot(flows[side], at - tail));
    turns[side] = lean + arc_sine(off / p.distance);
    sum += arc_sine(off / p.distance);
  }
  if (p.distance <= farthest) return p.distance / farthest;
  // Positive where the flow spreads: `edge` runs counter-clockwise, so that the next head is on the left.
  const double spread = std::atan2(plane::cross(flows[0], flows[1]), plane::dot(flows[0], flows[1]));
  return p.angle / std::min({2 * turns[0], 2 * turns[1], spread + sum});
}

CombedCircle::StripShares CombedCircle::strip_shares(const MedialPoint& p) const {
  const std::array<Exit, 2> exits = {exit_of(p, 0), exit_of(p, 1)};
  StripShares shares;
  for (const Exit& exit : exits) {
    const std::uint32_t next = (exit.edge + 1) % static_cast<std::uint32_t>(theta_.size());
    if (is_tail(exit.edge) != is_tail(next)) return {-1, -1, false};
    if (!is_tail(exit.edge)) continue;
    const Vec2 left = vec(theta_[exit.edge].nearest.direction), right = vec(theta_[next].nearest.direction);
    const double spread = std::atan2(plane::cross(right, left), plane::dot(right, left));
    shares.against_the_flow = std::max({shares.against_the_flow, exit.dip / greatest_dip(exit.rest, exit.reach),
                                        2 * exit.bend / (spread + exit.view)});
  }
  if (shares.against_the_flow >= 0) return shares;
  if (exits[0].edge != exits[1].edge) return {-1, -1, false};
  shares.with_the_flow = with_the_flow(p, exits[0].edge);
  return shares;
}

}  // namespace medial_vk::test
