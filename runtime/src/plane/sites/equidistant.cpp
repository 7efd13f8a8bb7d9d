#include "plane/sites/equidistant.h"

#include <algorithm>

namespace medial_vk::plane {
namespace {

/// In the space of (x, y, r), the cone over a point is |(x, y) - p| = r, and a segment's distance the plane
/// n (x, y) - r = c. The difference of the squares of two cones is a plane, too.
struct Plane {
  double x = 0, y = 0, r = 0, value = 0;
};

struct Position {
  double x = 0, y = 0, r = 0;
};

constexpr double det(double a, double b, double c, double d) { return a * d - b * c; }

/// Where three planes meet; none if they are so nearly dependent that rounding decides.
bool meet(const Plane& a, const Plane& b, const Plane& c, Position& point) {
  const double bc_yr = det(b.y, b.r, c.y, c.r), bc_xr = det(b.x, b.r, c.x, c.r), bc_xy = det(b.x, b.y, c.x, c.y);
  const double all = a.x * bc_yr - a.y * bc_xr + a.r * bc_xy;
  const double magnitude = std::fabs(a.x * bc_yr) + std::fabs(a.y * bc_xr) + std::fabs(a.r * bc_xy);
  if (!(std::fabs(all) > 0x1p-48 * magnitude)) return false;
  const double b_vr = det(b.value, b.r, c.value, c.r), b_vy = det(b.value, b.y, c.value, c.y);
  const double b_xv = det(b.x, b.value, c.x, c.value);
  point.x = (a.value * bc_yr - a.y * b_vr + a.r * b_vy) / all;
  point.y = (a.x * b_vr - a.value * bc_xr + a.r * b_xv) / all;
  point.r = (a.x * -b_vy - a.y * b_xv + a.value * bc_xy) / all;
  return true;
}

/// The equations of three sites, in coordinates from `near`.
class System {
 public:
  System(const SiteSet& sites, const std::array<Contact, 3>& contacts, Vec2 near) : sites_(sites), near_(near) {
    std::size_t segments = 0;  // they come first
    for (const Contact& c : contacts) {
      if (!sites.is_point(c.site)) contacts_[segments++] = c;
    }
    points_ = 3 - static_cast<int>(segments);
    for (const Contact& c : contacts) {
      if (sites.is_point(c.site)) contacts_[segments++] = c;
    }
  }

  Circles solve() {
    switch (points_) {
      case 0:
        add_meeting(plane_of(0), plane_of(1), plane_of(2));
        break;
      case 1:
        solve_two_segments();
        break;
      case 2:
        solve_one_segment();
        break;
      default:
        solve_three_points();
    }
    return found_;
  }

 private:
  Vec2 normal(int i) const { return sites_.segment(contacts_[i].site).normal(contacts_[i].side); }
  Vec2 point(int i) const { return sites_.point(contacts_[i].site) - near_; }
  Plane plane_of(int i) const {
    const Vec2 n = normal(i);
    return {n.x, n.y, -1, dot(n, sites_.segment(contacts_[i].site).begin - near_)};
  }
  /// Equal distances from two points.
  Plane between(int i, int k) const {
    const Vec2 p = point(i), q = point(k), d = q - p;
    return {d.x, d.y, 0, dot(d, 0.5 * (p + q))};
  }
  bool joined(int i, int k) const { return sites_.are_joined(contacts_[i].site, contacts_[k].site); }

  void add(const Position& p) {
    if (!(p.r > 0) || found_.count == 2) return;
    found_.circles[found_.count++] = {{near_.x + p.x, near_.y + p.y}, p.r};
  }
  void add_meeting(const Plane& a, const Plane& b, const Plane& c) {
    Position p;
    if (meet(a, b, c, p)) add(p);
  }

  /// A segment and its end: the centre lies on the normal at the end, end + r n.
  void add_on_normal(int segment, int end, double r) {
    const Vec2 x = point(end) + r * normal(segment);
    add({x.x, x.y, r});
  }

  void solve_two_segments() {
    for (const int own : {0, 1}) {
      if (!joined(own, 2)) continue;
      if (joined(1 - own, 2)) return;  // the corner itself
      const Plane against = plane_of(1 - own);
      const Vec2 n = normal(own), m = normal(1 - own), p = point(2);
      const Vec2 turn = n - m;  // 1 - n m, without cancellation
      const double opening = dot(turn, turn) / 2;
      if (opening > 0) add_on_normal(own, 2, (dot(m, p) - against.value) / opening);
      return;
    }
    intersect_with_cone(plane_of(0), plane_of(1), point(2));
  }

  void solve_one_segment() {
    for (const int own : {1, 2}) {
      if (!joined(0, own)) continue;
      if (joined(0, 3 - own)) return;  // a segment with both of its ends
      const Vec2 apart = point(own) - point(3 - own);
      const double fall = -2 * dot(normal(0), apart);
      if (fall > 0) add_on_normal(0, own, dot(apart, apart) / fall);
      return;
    }
    intersect_with_cone(plane_of(0), between(1, 2), point(1));
  }

  void solve_three_points() {
    const Plane a = between(0, 1), b = between(0, 2);
    const double all = det(a.x, a.y, b.x, b.y);
    if (!(std::fabs(all) > 0x1p-48 * (std::fabs(a.x * b.y) + std::fabs(a.y * b.x)))) return;
    const Vec2 x = {det(a.value, a.y, b.value, b.y) / all, det(a.x, a.value, b.x, b.value) / all};
    add({x.x, x.y, plane::distance(x, point(0))});
  }

  /// The line in which two planes meet is followed to the cone over p.
  void intersect_with_cone(const Plane& a, const Plane& b, Vec2 p) {
    const Position along = {det(a.y, a.r, b.y, b.r), -det(a.x, a.r, b.x, b.r), det(a.x, a.y, b.x, b.y)};
    const double squared = along.x * along.x + along.y * along.y + along.r * along.r;
    if (!(squared > 0x1p-90)) return;
    Position base;
    if (!meet(a, b, {along.x, along.y, along.r, along.x * p.x + along.y * p.y}, base)) return;
    // |base + t along - p|^2 = r^2 is qa t^2 + 2 qb t + qc = 0
    const double dx = base.x - p.x, dy = base.y - p.y;
    const double qa = along.x * along.x + along.y * along.y - along.r * along.r;
    const double qb = dx * along.x + dy * along.y - base.r * along.r;
    const double qc = dx * dx + dy * dy - base.r * base.r;
    const auto add_at = [&](double t) { add({base.x + t * along.x, base.y + t * along.y, base.r + t * along.r}); };
    // A circle that the line merely touches has a discriminant of zero, which rounding can make negative.
    const double discriminant = qb * qb - qa * qc, rounding = 0x1p-46 * (qb * qb + std::fabs(qa * qc));
    if (discriminant < -rounding) return;
    const double q = -(qb + std::copysign(std::sqrt(std::max(discriminant, 0.0)), qb));
    if (std::fabs(qa) > 0x1p-50 * squared) add_at(q / qa);
    if (q != 0 && discriminant > rounding) add_at(qc / q);
    if (std::fabs(qa) <= 0x1p-50 * squared && q != 0 && discriminant <= rounding) add_at(qc / q);
  }

  const SiteSet& sites_;
  std::array<Contact, 3> contacts_;
  Vec2 near_;
  int points_ = 0;
  Circles found_;
};

/// The equations of the tangent planes at a circle, for the step of Newton's method on the three distances.
bool linearise(const SiteSet& sites, const std::array<Contact, 3>& contacts, const Circle& circle,
               std::array<Plane, 3>& rows) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Contact c = contacts[i];
    if (sites.is_point(c.site)) {
      const Vec2 from = circle.centre - sites.point(c.site);
      const double d = length(from);
      if (!(d > 0)) return false;
      rows[i] = {from.x / d, from.y / d, -1, circle.radius - d};
    } else {
      const Vec2 n = sites.segment(c.site).normal(c.side);
      rows[i] = {n.x, n.y, -1, circle.radius - sites.segment(c.site).height(circle.centre, c.side)};
    }
  }
  return true;
}

double residual(const std::array<Plane, 3>& rows) {
  return std::max({std::fabs(rows[0].value), std::fabs(rows[1].value), std::fabs(rows[2].value)});
}

}  // namespace

void polish(const SiteSet& sites, const std::array<Contact, 3>& contacts, Circle& circle) {
  const auto joined = [&](int i, int k) { return sites.are_joined(contacts[i].site, contacts[k].site); };
  if (joined(0, 1) || joined(0, 2) || joined(1, 2)) return;
  std::array<Plane, 3> rows;
  if (!linearise(sites, contacts, circle, rows)) return;
  const double before = residual(rows);
  Position step;
  if (!meet(rows[0], rows[1], rows[2], step)) return;
  const Circle next = {{circle.centre.x + step.x, circle.centre.y + step.y}, circle.radius + step.r};
  if (next.radius > 0 && linearise(sites, contacts, next, rows) && residual(rows) < before) circle = next;
}

Circles rough_circles(const SiteSet& sites, const std::array<Contact, 3>& contacts, Vec2 near) {
  return System(sites, contacts, near).solve();
}

}  // namespace medial_vk::plane
