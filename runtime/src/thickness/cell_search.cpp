#include "thickness/cell_search.h"

#include <algorithm>
#include <cmath>

namespace medial_vk {
namespace {

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

void CellSearch::start() {
  open_.clear();
  number_ = 0;
  left_ = 0;
}

double CellSearch::run() {
  while (!open_.empty() && open_.front().reach > balls_.least_reach() && !balls_.is_exhausted()) divide();
  const double open = open_.empty() ? 0 : open_.front().reach;
  return std::max(left_, open);
}

/// Closes the cell with the greatest reach, or replaces it by its parts.
void CellSearch::divide() {
  std::pop_heap(open_.begin(), open_.end(), kIsLater);
  Open open = open_.back();
  open_.pop_back();
  evaluate(open);
  if (is_closed(open)) return;
  const double reach = reach_along_middle(open);
  if (reach > balls_.target()) {
    balls_.probe(open.cell.middle(), reach);
    evaluate(open);
    show_along(open);
    if (is_closed(open)) return;
  }
  if (!open.cell.can_be_divided()) {
    left_ = std::max(left_, open.reach);
    return;
  }
  for (std::size_t i = 0; i < DirectionCell::kParts; ++i) {
    Open part = open;
    part.cell = open.cell.part(i);
    push(part);
  }
}

double CellSearch::reach_along_middle(const Open& open) {
  return balls_.contacts().reach_along(open.cell.middle(), balls_.slack(), open.reach, open.list).most;
}

void CellSearch::push(Open open) {
  evaluate(open);
  if (open.reach <= balls_.least_reach()) return;
  open.number = number_++;
  open_.push_back(open);
  std::push_heap(open_.begin(), open_.end(), kIsLater);
}

void CellSearch::evaluate(Open& open) {
  const auto [reach, by] = balls_.contacts().narrow(open.cell, balls_.slack(), open.reach, open.list);
  open.reach = reach;
  if (by != ContactLists::kNone && reach <= balls_.least_reach()) balls_.mark_used(by);
}

/// True if no ball around a centre in these directions is larger than the target and on this side.
bool CellSearch::is_closed(const Open& open) {
  if (open.reach <= balls_.least_reach() || is_on_other_side(open)) return true;
  // Where a contact within the target of a centre makes its ball too small, the centre is no farther from p than this.
  if (open.reach > balls_.target() + 2 * balls_.delta()) return false;
  return shown_up_to(open.cell.corners(), open.cell.bulge(), open) >= open.reach;
}

/// In an open mesh, a ball on the other side must hold all centres in question.
bool CellSearch::is_on_other_side(const Open& open) const {
  const double from = balls_.least_reach() / kBoundRounding, to = open.reach * open.cell.bulge();
  return std::ranges::any_of(balls_.others(), [&](const Ball& other) {
    if (balls_.is_closed_mesh()) {
      return balls_.are_on_other_side(other, least_of(along(open.cell.corners(), other.centre)));
    }
    const Contact centre = {other.centre, dot(other.centre, other.centre)};
    const Bounds near = distances_near(open.cell.corners(), centre, balls_.radius_of_other(other));
    return near.lower <= from && to <= near.upper;
  });
}

/// The least distance from p, above the target, at which centres in these directions may have balls larger than the
/// target.
double CellSearch::shown_up_to(const FourDirections& directions, double bulge, const Open& open) {
  double shown = balls_.least_reach();
  const double most = balls_.target_of_contacts();
  if (!(most > 0) || !(shown > 0)) return 0;
  balls_.contacts().intervals_near(directions, open.list, most, shown, intervals_);
  for (bool grows = true; grows && shown < open.reach;) {
    grows = false;
    for (const ContactLists::Interval& interval : intervals_) {
      if (interval.lower > shown || interval.upper / bulge <= shown) continue;
      shown = interval.upper / bulge;
      balls_.mark_used(interval.number);
      grows = true;
    }
  }
  return shown;
}

/// Finds contacts that show on the middle ray that no ball is larger than the target, or larger balls.
void CellSearch::show_along(Open& open) {
  constexpr int kMostSteps = 8;
  if (open.reach > balls_.target() + 2 * balls_.delta()) return;
  const FourDirections middle = four_times(open.cell.middle());
  for (int step = 0; step < kMostSteps; ++step) {
    const double shown = shown_up_to(middle, 1, open);
    if (shown <= 0) return;
    if (shown >= reach_along_middle(open)) return mix_along(open);
    const BallsNear::Probe found = balls_.probe_at(open.cell.middle(), shown);
    if (found.is_near && found.radius > balls_.best().radius) return;  // on the other side
    evaluate(open);
  }
}

/// Adds mixtures of the contacts that take turns along the middle ray to show that no ball is larger: beside it, one
/// contact alone shows it on either side of the medial surface only.
void CellSearch::mix_along(Open& open) {
  const Point& direction = open.cell.middle();
  const double end = reach_along_middle(open);
  double shown = balls_.least_reach();
  std::uint32_t last = ContactLists::kNone;
  while (shown < end) {
    const ContactLists::Interval* next = nullptr;
    for (const ContactLists::Interval& interval : intervals_) {
      if (interval.lower <= shown && interval.upper > (next ? next->upper : shown)) next = &interval;
    }
    if (!next) break;
    if (last != ContactLists::kNone) {
      const std::optional<Contact> mixed =
          mixture(balls_.contacts().contact(last), balls_.contacts().contact(next->number), shown * direction);
      if (mixed) balls_.add_mixture(*mixed);
    }
    last = next->number;
    shown = next->upper;
  }
  evaluate(open);
}

}  // namespace medial_vk
