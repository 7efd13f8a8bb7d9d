#include "plane/sites/bisector.h"

#include <limits>
#include <utility>

namespace medial_vk::plane {
namespace {

constexpr double kLeastTurn = 0x1p-40;  // of normals, or of a focus over a length: below it is rounding

Bisector::Crossings roots_of_line(double slope, double value) {
  if (slope == 0) return {};
  return {{value / slope, 0}, 1};
}

/// Of a t^2 + 2 b t + c.
Bisector::Crossings roots(double a, double b, double c) {
  if (a == 0) return roots_of_line(2 * b, -c);
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return {};
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0) return {{0, 0}, 1};
  return {{q / a, c / q}, 2};
}

}  // namespace

Vec2 Bisector::at(double t) const {
  const Vec2 on_line = origin_ + t * along_;
  return kind_ == Kind::kMixed ? on_line + rise(t) * up() : on_line;
}

double Bisector::radius_at(double t) const {
  switch (kind_) {
    case Kind::kOfPoints:
      return std::sqrt(focus_ * focus_ + t * t);
    case Kind::kMixed:
      return rise(t);
    case Kind::kOfSegments:
      break;
  }
  return radius_ + slope_ * t;
}

double Bisector::object_angle_at(double t) const {
  return kind_ == Kind::kOfSegments ? angle_ : std::atan2(focus_, std::fabs(t));
}

double Bisector::reach(double angle) const {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  if (kind_ == Kind::kOfSegments) return angle_ >= angle ? kAll : -1;
  return angle > 0 ? focus_ / std::tan(angle) : kAll;
}

Bisector::Crossings Bisector::with_line(Vec2 normal, double value) const {
  const double constant = dot(normal, origin_) - value, slope = dot(normal, along_);
  if (kind_ != Kind::kMixed) return roots_of_line(slope, -constant);
  const double lift = dot(normal, up());
  return roots(lift / (2 * focus_), slope / 2, constant + lift * focus_ / 2);
}

Bisector::Crossings Bisector::with_radius(double radius) const {
  if (kind_ == Kind::kOfSegments) return roots_of_line(slope_, radius - radius_);
  return roots(1, 0,
               kind_ == Kind::kOfPoints ? focus_ * focus_ - radius * radius : focus_ * focus_ - 2 * focus_ * radius);
}

std::optional<Bisector> bisector_of(const SiteSet& sites, Contact a, Contact b) {
  if (a.site == b.site || sites.are_joined(a.site, b.site)) return {};
  if (sites.is_point(b.site)) std::swap(a, b);
  Bisector curve;
  if (sites.is_point(b.site)) {  // two points
    const Vec2 p = sites.point(a.site), q = sites.point(b.site);
    curve.kind_ = Bisector::Kind::kOfPoints;
    curve.origin_ = 0.5 * (p + q);
    curve.along_ = left_of(unit(q - p));
    curve.focus_ = distance(p, q) / 2;
    return curve;
  }
  const Segment& line = sites.segment(b.site);
  if (sites.is_point(a.site)) {
    const Vec2 p = sites.point(a.site);
    curve.kind_ = Bisector::Kind::kMixed;
    curve.along_ = line.along;
    curve.turns_left_ = b.side == Side::kLeft;
    curve.origin_ = line.begin + line.position(p) * line.along;
    curve.focus_ = line.height(p, b.side);
    if (!(curve.focus_ > kLeastTurn * kLeastTurn)) return {};
    return curve;
  }
  const Segment& other_line = sites.segment(a.site);
  const Vec2 normal = line.normal(b.side), other_normal = other_line.normal(a.side);
  const Vec2 turn = normal - other_normal;
  const double squared = dot(turn, turn);
  if (!(squared > kLeastTurn * kLeastTurn)) return {};
  curve.kind_ = Bisector::Kind::kOfSegments;
  const double along = dot(other_normal, line.begin - other_line.begin) / squared;
  curve.origin_ = line.begin + along * turn;
  curve.along_ = left_of((1 / std::sqrt(squared)) * turn);
  curve.radius_ = dot(normal, curve.origin_ - line.begin);
  curve.slope_ = dot(normal, curve.along_);
  curve.angle_ = angle_between(normal, other_normal) / 2;
  return curve;
}

}  // namespace medial_vk::plane
