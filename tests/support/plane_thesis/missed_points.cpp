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
    const Vec2 a = vec(theta[i].point) - vec(circle.centre);
    const Vec2 b = vec(theta[(i + 1) % theta.size()].point) - vec(circle.centre);
    const double turn = std::atan2(plane::cross(a, b), plane::dot(a, b));
    longest_gap_ = std::max(longest_gap_, circle.radius * (turn < 0 ? turn + 2 * std::numbers::pi : turn));
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
    exit = {i, std::max(0.0, dip), std::numbers::pi - plane::angle_between(a - from, b - from)};
  }
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
          (p.distance - a.dip) / gap,
          (p.distance - b.dip) / gap};
}

std::array<double, 4> CombedCircle::corollary_shares(const MedialPoint& p) const {
  const double half_turn = longest_gap_ / (2 * circle_.radius);
  const double width = 2 * circle_.radius * std::sin(half_turn);
  if (p.distance <= width) return {p.distance / width, 0, 0, 0};
  const double angle = half_turn + std::asin(width / p.distance);
  return {p.distance / width, p.angle / angle, 2 * exit_of(p, 0).bend / angle, 2 * exit_of(p, 1).bend / angle};
}

double CombedCircle::strip_share(const MedialPoint& p, std::uint32_t edge) const {
  const std::array<std::uint32_t, 2> ends = {edge, (edge + 1) % static_cast<std::uint32_t>(theta_.size())};
  const bool is_against = is_tail(edge);
  const Vec2 at = vec(p.point);
  std::array<Vec2, 2> flows, from_tails;
  double leans = 0, farthest = 0, least_turn = kNone;
  for (std::size_t side = 0; side < 2; ++side) {
    const CirclePoint& end = theta_[ends[side]];
    const Vec2 here = vec(end.point), there = vec(theta_[end.opposite].point);
    flows[side] = vec(end.nearest.direction);
    from_tails[side] = at - (is_against ? here : there);
    const double off = std::fabs(plane::cross(flows[side], at - here));
    const double lean = arc_sine(off / p.distance);
    leans += lean;
    farthest = std::max(farthest, distance_to_segment(at, here, there));
    least_turn = std::min(least_turn, lean + plane::angle_between(from_tails[side], flows[side]));
  }
  if (p.distance <= farthest) return p.distance / farthest;
  // Positive where the flow spreads: edges run counter-clockwise, so that the next head is on the left, the next tail
  // on the right.
  const Vec2 left = flows[is_against ? 0 : 1], right = flows[is_against ? 1 : 0];
  const double sector = std::atan2(plane::cross(right, left), plane::dot(right, left)) + leans;
  if (is_against) return 2 * (std::numbers::pi - plane::angle_between(from_tails[0], from_tails[1])) / sector;
  return p.angle / std::min(sector, 2 * least_turn);
}

CombedCircle::StripShares CombedCircle::strip_shares(const MedialPoint& p) const {
  const std::array<Exit, 2> exits = {exit_of(p, 0), exit_of(p, 1)};
  StripShares shares;
  for (const Exit& exit : exits) {
    const std::uint32_t next = (exit.edge + 1) % static_cast<std::uint32_t>(theta_.size());
    if (is_tail(exit.edge) != is_tail(next)) return {-1, -1, false};
    if (is_tail(exit.edge)) shares.against_the_flow = std::max(shares.against_the_flow, strip_share(p, exit.edge));
  }
  if (shares.against_the_flow >= 0) return shares;
  if (exits[0].edge != exits[1].edge) return {-1, -1, false};
  shares.with_the_flow = strip_share(p, exits[0].edge);
  return shares;
}

}  // namespace medial_vk::test
