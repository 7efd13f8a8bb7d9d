#include "thickness/largest_ball_near.h"

#include <algorithm>
#include <cmath>

namespace medial_vk {
namespace {

// Probed centres are closer to p by this share than the bound, so that rounding does not decide whether their balls
// come within delta.
constexpr double kInset = 0x1p-20;

// Smaller balls than this share of delta are not searched for.
constexpr double kLeastShare = 0x1p-4;

constexpr std::size_t kMostOthers = 8, kMostKept = 40;

/// Cells with a greater reach are divided first.
constexpr auto kIsLater = [](const auto& a, const auto& b) {
  return a.reach != b.reach ? a.reach < b.reach : a.number > b.number;
};

FourDirections four_times(const Point& direction) {
  FourDirections four;
  for (std::size_t k = 0; k < 3; ++k) four[k].fill(direction[k]);
  return four;
}

}  // namespace

LargestBallNear::LargestBallNear(const ThicknessField& field)
    : field_(field), delta_(field.options.delta), limit_(0.5 * field.options.limit) {}

Thickness LargestBallNear::find(const Point& p, const Point& inward) {
  start(p, inward);
  const CubeFrame frame = CubeFrame::around(inward);
  for (std::size_t i = 0; i < DirectionCell::kFaces; ++i) push({DirectionCell::face(frame, i), limit_ + delta_});
  while (!open_.empty() && open_.front().reach > least_reach() && queries_ < field_.options.queries) divide(frame);
  double upper = target();
  if (!open_.empty()) upper = std::max(upper, open_.front().reach + off_);
  keep_used();
  Thickness out;
  out.diameter = {2 * best_.radius, 2 * std::max(best_.radius, std::min(upper, limit_))};
  out.ball = {p + best_.centre, best_.radius};
  out.object_angle = object_angle();
  return out;
}

void LargestBallNear::start(const Point& p, const Point& inward) {
  p_ = p;
  contacts_.clear();
  used_.clear();
  is_point_.clear();
  for (const Point& kept : kept_) add({kept - p, dot(kept - p, kept - p)}, true);
  open_.clear();
  others_.clear();
  best_ = {};
  doubtful_ = 0;
  number_ = 0;
  queries_ = 0;
  const double off = std::sqrt(field_.tree.closest(field_.solid.bvh(), p).squared_distance);
  // Contacts and distances have an error of at most Solid::rounding(), and products with contacts, which are no longer
  // than the diagonal and `off`, one of 4 u times that: docs/theory.md, "Thickness".
  rounding_ = 4 * field_.solid.rounding() + 0x1p-44 * off;
  slack_ = {delta_ + rounding_, delta_ + 2 * rounding_};
  off_ = off + rounding_;
  double reach = limit_ + delta_;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact contact = contacts_.contact(i);
    reach = std::min(reach, reach_by(contact, dot(inward, contact.at), slack_));
  }
  probe(inward, reach);
}

/// Balls that are not larger are of no interest.
double LargestBallNear::target() const {
  const double least = std::max(std::max(best_.radius, doubtful_) * (1 + field_.options.width), kLeastShare * delta_);
  return least * kBoundRounding;
}

/// The ball around a centre that is no farther from p is not larger than the target, as p is on the boundary or this
/// close to it.
double LargestBallNear::least_reach() const { return target() - off_; }

/// Closes the cell with the greatest reach, or replaces it by its parts.
void LargestBallNear::divide(const CubeFrame& frame) {
  std::pop_heap(open_.begin(), open_.end(), kIsLater);
  Open open = open_.back();
  open_.pop_back();
  evaluate(open);
  if (is_closed(open)) return;
  const double reach = reach_along_middle(open);
  if (reach > target()) {
    probe(open.cell.middle(), reach);
    evaluate(open);
    show_along(open);
    if (is_closed(open)) return;
  }
  for (std::size_t i = 0; i < DirectionCell::kParts; ++i) {
    Open part = open;
    part.cell = open.cell.part(frame, i);
    push(part);
  }
}

double LargestBallNear::reach_along_middle(const Open& open) const {
  return contacts_.reach_along(open.cell.middle(), slack_, open.reach, open.list);
}

void LargestBallNear::push(Open open) {
  evaluate(open);
  if (open.reach <= least_reach()) return;
  open.number = number_++;
  open_.push_back(open);
  std::push_heap(open_.begin(), open_.end(), kIsLater);
}

void LargestBallNear::evaluate(Open& open) {
  const auto [reach, by] = contacts_.narrow(open.cell, slack_, open.reach, open.list);
  open.reach = reach;
  if (by != ContactLists::kNone && reach <= least_reach()) used_[by] = true;
}

/// True if no ball around a centre in these directions is larger than the target and on this side.
bool LargestBallNear::is_closed(const Open& open) {
  if (open.reach <= least_reach() || is_on_other_side(open)) return true;
  // Where a contact within the target of a centre makes its ball too small, the centre is no farther from p than this.
  if (open.reach > target() + 2 * delta_) return false;
  return shown_up_to(open.cell.corners(), open.cell.bulge(), open) >= open.reach;
}

/// True if all centres in question are in one ball on the other side.
bool LargestBallNear::is_on_other_side(const Open& open) const {
  const double from = least_reach() / kBoundRounding, to = open.reach * open.cell.bulge();
  return std::ranges::any_of(others_, [&](const Ball& other) {
    const Contact centre = {other.centre, dot(other.centre, other.centre)};
    const Bounds near = distances_near(open.cell.corners(), centre, other.radius - rounding_);
    return near.lower <= from && to <= near.upper;
  });
}

/// The least distance from p, above the target, at which centres in these directions may have balls larger than the
/// target.
double LargestBallNear::shown_up_to(const FourDirections& directions, double bulge, const Open& open) {
  double shown = least_reach();
  const double most = target() / kBoundRounding - rounding_;
  if (!(most > 0) || !(shown > 0)) return 0;
  contacts_.intervals_near(directions, open.list, most, shown, intervals_);
  for (bool grows = true; grows && shown < open.reach;) {
    grows = false;
    for (const ContactLists::Interval& interval : intervals_) {
      if (interval.lower > shown || interval.upper / bulge <= shown) continue;
      shown = interval.upper / bulge;
      used_[interval.number] = true;
      grows = true;
    }
  }
  return shown;
}

/// Computes the distance of a centre, keeps its contact, and keeps its ball if it comes within delta of p.
LargestBallNear::Probe LargestBallNear::probe_at(const Point& direction, double distance) {
  const Point offset = distance * direction;
  const BvhHit hit = field_.tree.closest(field_.solid.bvh(), p_ + offset, distance * (1 + 0x1p-20) + off_);
  ++queries_;
  const double radius = std::sqrt(hit.squared_distance) - rounding_;
  const Point at = hit.point - p_;
  add({at, dot(at, at)}, true);
  const bool is_near = distance * kBoundRounding + rounding_ <= radius + delta_;
  if (is_near && radius > std::max(best_.radius, doubtful_)) record(offset, radius);
  return {is_near, dot(direction, at), radius};
}

/// Finds the farthest centre on a ray whose ball comes within delta of p: the excess of |m - p| over radius and delta
/// grows along the ray. Contacts of centres beyond it shorten the reach, in great steps at first; then the next centre
/// is where the excess between two others would be zero if it grew evenly.
void LargestBallNear::probe(const Point& direction, double reach) {
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
void LargestBallNear::go_back(const Point& direction, double distance, Probe found) {
  constexpr int kMostSteps = 8;
  for (int step = 0; step < kMostSteps && found.along > distance; ++step) {
    const double next = contacts_.contact(contacts_.size() - 1).squared / (2 * found.along);
    if (!(next < distance) || next <= target()) return;
    distance = next;
    found = probe_at(direction, distance);
  }
}

/// Finds contacts that show on the middle ray that no ball is larger than the target, or larger balls.
void LargestBallNear::show_along(Open& open) {
  constexpr int kMostSteps = 8;
  if (open.reach > target() + 2 * delta_) return;
  const FourDirections middle = four_times(open.cell.middle());
  for (int step = 0; step < kMostSteps; ++step) {
    const double shown = shown_up_to(middle, 1, open);
    if (shown <= 0) return;
    if (shown >= reach_along_middle(open)) return mix_along(open);
    const Probe found = probe_at(open.cell.middle(), shown);
    if (found.is_near && found.radius > best_.radius) return;  // on the other side
    evaluate(open);
  }
}

/// Adds mixtures of the contacts that take turns along the middle ray to show that no ball is larger: beside it, one
/// contact alone shows it on either side of the medial surface only.
void LargestBallNear::mix_along(Open& open) {
  const Point& direction = open.cell.middle();
  const double end = reach_along_middle(open);
  double shown = least_reach();
  std::uint32_t last = ContactLists::kNone;
  while (shown < end) {
    const ContactLists::Interval* next = nullptr;
    for (const ContactLists::Interval& interval : intervals_) {
      if (interval.lower <= shown && interval.upper > (next ? next->upper : shown)) next = &interval;
    }
    if (!next) break;
    if (last != ContactLists::kNone) {
      const std::optional<Contact> mixed =
          mixture(contacts_.contact(last), contacts_.contact(next->number), shown * direction);
      if (mixed) add(*mixed, false);
    }
    last = next->number;
    shown = next->upper;
  }
  evaluate(open);
}

void LargestBallNear::add(const Contact& contact, bool is_point) {
  contacts_.add(contact);
  used_.push_back(false);
  is_point_.push_back(is_point);
}

/// Keeps a ball that comes within delta of p, on whichever side. On an open mesh the side of a centre may be that of
/// this centre alone; then the ball counts on both sides for the upper bound.
void LargestBallNear::record(const Point& offset, double radius) {
  const bool walls = field_.options.side == ThicknessSide::kWalls;
  const SolidSide wanted = walls ? SolidSide::kInside : SolidSide::kOutside, side = side_of(offset, radius);
  const double counted = std::min(radius, limit_);
  if (side == SolidSide::kUnknown) {
    doubtful_ = std::max(doubtful_, counted);
    if (field_.solid.contains(p_ + offset) == walls && counted > best_.radius) best_ = {offset, counted};
  } else if (side == wanted) {
    best_ = {offset, counted};
  } else if (others_.size() < kMostOthers) {
    others_.push_back({offset, radius});
  } else {
    others_[queries_ % kMostOthers] = {offset, radius};
  }
}

/// The side of all centres in a ball. In a closed mesh, balls that overlap are on one side, as the boundary meets
/// neither.
SolidSide LargestBallNear::side_of(const Point& centre, double radius) const {
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

void LargestBallNear::keep_used() {
  kept_.clear();
  for (std::size_t i = contacts_.size(); i-- > 0 && kept_.size() < kMostKept;) {
    if (used_[i] && is_point_[i]) kept_.push_back(p_ + contacts_.contact(i).at);
  }
}

double LargestBallNear::object_angle() const {
  if (!(best_.radius > 0)) return 0;
  std::vector<Point> spokes;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    if (!is_point_[i]) continue;
    const Point spoke = contacts_.contact(i).at - best_.centre;
    const double distance = length(spoke);
    if (distance <= best_.radius + delta_) spokes.push_back((1 / distance) * spoke);
  }
  const double to_p = length(best_.centre);
  if (to_p > 0) spokes.push_back((-1 / to_p) * best_.centre);
  double least_cosine = 1;
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) least_cosine = std::min(least_cosine, dot(spokes[i], spokes[k]));
  }
  return 0.5 * std::acos(std::max(-1.0, least_cosine));
}

}  // namespace medial_vk
