#include "thickness/balls_near.h"

#include <algorithm>
#include <cmath>

namespace medial_vk {
namespace {

// Probed centres are closer to p by this share than the bound, so that rounding does not decide whether their balls
// come within delta.
constexpr double kInset = 0x1p-20;

// Smaller balls than this share of delta are not searched for.
constexpr double kLeastShare = 0x1p-4;

// A search also ends when the radius is known to the first share of delta, or to the last share of itself if that is
// less, but not less than the second share of delta (docs/decisions.md).
constexpr double kGapShare = 0.125, kLeastGapShare = 0.1, kUsefulShare = 0.1;

// An interval that is this many times as wide is enough where a narrow one takes too long (docs/decisions.md).
constexpr double kWidening = 4;

// Where a search has taken this many distances, points met elsewhere are no help: they shorten reaches by little, and
// new ones are needed in any case.
constexpr std::size_t kMostRecalling = 25;

constexpr std::size_t kMostOthers = 8, kMostKept = 24;

Point unit_or_zero(const Point& v) {
  const double size = length(v);
  return size > 0 ? (1 / size) * v : Point{0, 0, 0};
}

/// Of a triangle; zero if it has no meaningful direction.
Point normal_of(const Mesh& mesh, const Triangle& t) {
  double shorter = 0;
  const Point area = double_area(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], shorter);
  return length(area) > kAreaRounding * shorter ? unit_or_zero(area) : Point{0, 0, 0};
}

}  // namespace

BallsNear::BallsNear(const ThicknessField& field)
    : field_(field), delta_(field.options.delta), limit_(0.5 * field.options.limit) {}

void BallsNear::start(const Point& p) {
  p_ = p;
  others_.clear();
  best_ = {};
  doubtful_ = 0;
  target_ = kLeastShare * delta_;
  queries_ = 0;
  const BvhHit nearest = field_.tree.closest(field_.solid.bvh(), p);
  const Mesh& mesh = field_.solid.mesh().mesh;
  const double off = std::sqrt(nearest.squared_distance);
  at_p_ = {nearest.point - p, normal_of(mesh, mesh.triangles[nearest.triangle])};
  // Contacts and distances have an error of at most Solid::rounding(), and products with contacts, which are no longer
  // than the diagonal and `off`, one of 4 u times that: docs/theory.md, "Thickness".
  rounding_ = 4 * field_.solid.rounding() + 0x1p-44 * off;
  slack_ = {delta_ + rounding_, delta_ + 2 * rounding_};
  off_ = off + rounding_;
  contacts_.start(most_reach(), slack_);
  pool_.start(p, most_reach(), slack_);
  used_.clear();
  normals_.clear();
  for (const BallContact& kept : kept_) add({kept.at - p, dot(kept.at - p, kept.at - p)}, kept.normal);
}

/// If a direction has a point in the other ball at a distance from p that is above delta and at most that of a centre,
/// the ball around this centre would hold the point, and all points in a ball are on one side. A ray whose product with
/// the other centre is greater is in the other ball from a smaller distance to a greater one.
bool BallsNear::are_on_other_side(const Ball& other, double least_product) const {
  if (!(least_product > 0)) return false;
  const Bounds near = distances_near(least_product, dot(other.centre, other.centre), radius_of_other(other));
  return std::max(near.lower, slack_.product * kBoundRounding) <= std::min(near.upper, least_reach() / kBoundRounding);
}

BallsNear::Probe BallsNear::probe_at(const Point& direction, double distance) {
  const Point offset = distance * direction;
  const double squared = std::max(0.0, contacts_.least_squared_distance(offset)), by_p = distance + off_;
  const double bound = std::min(std::sqrt(squared), by_p) * (1 + 0x1p-20) + rounding_;
  BvhHit hit = field_.tree.closest(field_.solid.bvh(), p_ + offset, bound);
  if (hit.triangle == BvhHit().triangle) hit = field_.tree.closest(field_.solid.bvh(), p_ + offset);  // by rounding
  if (++queries_ == field_.options.patience) raise_target(std::max(best_.radius, doubtful_));
  const double radius = std::sqrt(hit.squared_distance) - rounding_;
  const Point at = hit.point - p_;
  const Point normal = unit_or_zero(at - offset);
  add({at, dot(at, at)}, normal);
  pool_.add({hit.point, normal});
  const bool is_near = distance * kBoundRounding + rounding_ <= radius + delta_;
  if (is_near && radius > std::max(best_.radius, doubtful_)) record(offset, radius);
  return {is_near, dot(direction, at), radius};
}

/// Finds the farthest centre on a ray whose ball comes within delta of p: the excess of |m - p| over radius and delta
/// grows along the ray. Contacts of centres beyond it shorten the reach, in great steps at first; then the next centre
/// is where the excess between two others would be zero if it grew evenly.
void BallsNear::probe(const Point& direction, double reach) {
  constexpr int kMostSteps = 24, kShrinkingSteps = 3;
  const double enough = 1 - field_.options.width / 8;
  double near = 0, near_excess = -delta_, beyond = reach, excess = 0;
  for (int step = 0; step < kMostSteps && reach > target() && near < enough * reach; ++step) {
    double distance = reach * (1 - kInset);
    if (step >= kShrinkingSteps) {
      const double even = near + (beyond - near) * (-near_excess / (excess - near_excess));
      distance = std::clamp(even, std::min(near + 0.1 * (reach - near), distance), distance);
    }
    const Probe found = probe_at(direction, distance);
    if (found.is_near) {
      if (found.along > distance) go_back(direction, distance, found);
      if (step < kShrinkingSteps) return;
      near = distance;
      near_excess = std::min(distance - found.radius - delta_, -0x1p-10 * delta_);
      continue;
    }
    const double next = reach_by(contacts_.contact(contacts_.size() - 1), found.along, slack_);
    if (!(next < reach)) return;
    reach = next;
    beyond = distance;
    excess = std::max(distance - found.radius - delta_, 0x1p-10 * delta_);
  }
}

/// If the contact of a ball lies ahead, balls on the way to it are larger, up to the one that has p and this contact on
/// its sphere.
void BallsNear::go_back(const Point& direction, double distance, Probe found) {
  constexpr int kMostSteps = 8;
  for (int step = 0; step < kMostSteps && found.along > distance; ++step) {
    const double next = contacts_.contact(contacts_.size() - 1).squared / (2 * found.along);
    if (!(next < distance) || next <= target()) return;
    distance = next;
    found = probe_at(direction, distance);
  }
}

double BallsNear::recall(const Point& direction, double reach) {
  if (queries_ >= kMostRecalling) return reach;
  const std::uint32_t number = pool_.least_reach(direction, reach);
  if (number == kNoContact) return reach;
  const Point at = pool_[number].at - p_;
  const Contact contact = {at, dot(at, at)};
  const double found = reach_by(contact, dot(direction, at), slack_);
  if (!(found < reach)) return reach;
  add(contact, pool_[number].normal);
  return found;
}

void BallsNear::add(const Contact& contact, const Point& normal) {
  contacts_.add(contact);
  used_.push_back(false);
  normals_.push_back(normal);
}

/// Keeps a ball that comes within delta of p, on whichever side. On an open mesh the side of a centre may be that of
/// this centre alone; then the ball counts on both sides for the upper bound.
void BallsNear::record(const Point& offset, double radius) {
  const bool walls = field_.options.side == ThicknessSide::kWalls;
  const SolidSide wanted = walls ? SolidSide::kInside : SolidSide::kOutside, side = side_of(offset, radius);
  const double counted = std::min(radius, limit_);
  if (side == SolidSide::kUnknown) {
    doubtful_ = std::max(doubtful_, counted);
    if (field_.solid.contains(p_ + offset) == walls && counted > best_.radius) best_ = {offset, counted};
  } else if (side == wanted) {
    best_ = {offset, counted};
  } else {
    if (others_.size() == kMostOthers) others_.erase(others_.begin());
    others_.push_back({offset, radius});
    return;
  }
  const double gap = gap_above(counted);
  if (counted + 0.5 * gap > target_) target_ = (counted + gap) * kBoundRounding;
}

/// How much larger balls need not be found.
double BallsNear::gap_above(double radius) const {
  const double width = (queries_ < field_.options.patience ? 1 : kWidening) * field_.options.width;
  return std::max(width * radius, std::clamp(kUsefulShare * radius, kLeastGapShare * delta_, kGapShare * delta_));
}

void BallsNear::raise_target(double radius) {
  if (radius > 0) target_ = std::max(target_, (radius + gap_above(radius)) * kBoundRounding);
}

/// The side of all centres in a ball. In a closed mesh, balls that overlap are on one side, as the boundary meets
/// neither.
SolidSide BallsNear::side_of(const Point& centre, double radius) const {
  const bool walls = field_.options.side == ThicknessSide::kWalls;
  const auto overlaps = [&](const Ball& ball) {
    return length(centre - ball.centre) * kBoundRounding < radius + ball.radius;
  };
  if (field_.solid.mesh().report.closed) {
    if (best_.radius > 0 && overlaps(best_)) return walls ? SolidSide::kInside : SolidSide::kOutside;
    if (std::ranges::any_of(others_, overlaps)) return walls ? SolidSide::kOutside : SolidSide::kInside;
  }
  return field_.solid.side_around(p_ + centre, radius);
}

void BallsNear::keep_used() {
  kept_.clear();
  for (std::size_t i = contacts_.size(); i-- > 0 && kept_.size() < kMostKept;) {
    if (used_[i] && is_point(i)) kept_.push_back({p_ + contacts_.contact(i).at, normals_[i]});
  }
}

/// Among points at equal distances from a centre, one that is nearest to a place off it, towards the other side, is the
/// one whose direction is closest to that side.
void BallsNear::look_across(const Point& direction) {
  const Point centre = best_.centre - (0.5 * best_.radius) * direction;
  const Point at = field_.tree.closest(field_.solid.bvh(), p_ + centre).point - p_;
  add({at, dot(at, at)}, unit_or_zero(at - centre));
}

/// A normal belongs to a point where the ball may touch: its plane does not cut the ball by more than a plane through
/// any point that close does, and by kNormalSlack where the boundary is bent towards the ball.
void BallsNear::collect_contacts(double beyond, std::vector<BallContact>& found) const {
  constexpr double kNormalSlack = 0.1;
  found.clear();
  const double most = best_.radius + beyond;
  const double least_cosine = std::cos(std::acos(best_.radius / most) + kNormalSlack);
  const auto consider = [&](const BallContact& contact) {
    const Point spoke = contact.at - best_.centre;
    const double distance = length(spoke);
    if (!(distance <= most)) return;
    if (dot(spoke, contact.normal) >= std::max(least_cosine, 0.0) * distance) found.push_back(contact);
  };
  const Point to_p = at_p_.at - best_.centre;
  const double along = dot(to_p, at_p_.normal);  // triangles of open meshes, and those of gaps, may face the centre
  consider({at_p_.at, along == 0 ? unit_or_zero(to_p) : (along > 0 ? 1.0 : -1.0) * at_p_.normal});
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (is_point(i)) consider({contacts_.contact(i).at, normals_[i]});
  }
}

}  // namespace medial_vk
