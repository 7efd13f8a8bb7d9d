#include "thickness/cell_search.h"

#include <algorithm>
#include <cmath>

namespace medial_vk {
namespace {

/// Cells with a greater reach are divided first.
constexpr auto kIsLater = [](const auto& a, const auto& b) {
  return a.reach != b.reach ? a.reach < b.reach : a.number > b.number;
};

}  // namespace

void CellSearch::start() {
  open_.clear();
  number_ = 0;
  left_ = 0;
}

double CellSearch::run() {
  while (!open_.empty() && open_.front().reach > balls_.least_reach() && !balls_.is_exhausted(number_)) divide();
  const double open = open_.empty() ? 0 : open_.front().reach;
  return std::max(left_, open);
}

/// Closes the cell with the greatest reach, or replaces it by its parts.
void CellSearch::divide() {
  std::pop_heap(open_.begin(), open_.end(), kIsLater);
  Open open = open_.back();
  open_.pop_back();
  evaluate_again(open);
  if (is_closed(open)) return;
  const double reach = reach_along_middle(open);
  if (reach > balls_.target()) {
    balls_.probe(open.cell.middle(), reach);
    evaluate_again(open);
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
  return balls_.contacts().reach_along(open.cell.middle(), open.reach, open.list).most;
}

void CellSearch::push(Open open) {
  evaluate(open);
  if (open.reach <= balls_.least_reach()) return;
  open.number = number_++;
  open_.push_back(open);
  std::push_heap(open_.begin(), open_.end(), kIsLater);
}

void CellSearch::evaluate(Open& open) {
  const auto [reach, by] = balls_.contacts().narrow(open.cell, open.reach, open.list);
  open.reach = reach;
  if (by != ContactLists::kNone && reach <= balls_.least_reach()) balls_.mark_used(by);
}

/// Of a cell that was evaluated before.
void CellSearch::evaluate_again(Open& open) {
  if (open.list.seen < balls_.contacts().size()) evaluate(open);
}

/// True if no ball around a centre in these directions is larger than the target and on this side.
bool CellSearch::is_closed(const Open& open) {
  if (open.reach <= balls_.least_reach() || is_on_other_side(open)) return true;
  // Where a contact within the target of a centre makes its ball too small, the centre is no farther from p than this.
  if (open.reach > balls_.target() + 2 * balls_.delta()) return false;
  return shown_in(open) >= open.reach;
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

/// The least distance from p, above the target, at which centres in the cell may have balls larger than the target.
double CellSearch::shown_in(const Open& open) {
  const double most = balls_.target_of_contacts();
  double shown = balls_.least_reach();
  if (!(most > 0) || !(shown > 0)) return 0;
  const double bulge = open.cell.bulge();
  intervals_.measure(balls_.contacts().scale(), balls_.contacts().range_of(open.list), open.cell, most);
  while (shown < open.reach) {
    const std::uint32_t next = intervals_.farthest(shown);
    if (next == ContactLists::kNone) break;
    const Bounds near = distances_near(open.cell.corners(), balls_.contacts().contact(next), most);
    if (near.lower > shown || near.upper / bulge <= shown) break;
    shown = near.upper / bulge;
    balls_.mark_used(next);
  }
  return shown;
}

/// The same along the middle ray. `turns`: contacts that show it, and the distances up to which they do.
double CellSearch::shown_along_middle(const Open& open) {
  const double most = balls_.target_of_contacts();
  double shown = balls_.least_reach();
  turns_.clear();
  if (!(most > 0) || !(shown > 0)) return 0;
  intervals_.measure(balls_.contacts().scale(), balls_.contacts().range_of(open.list), open.cell.middle(), most);
  while (shown < open.reach) {
    const std::uint32_t next = intervals_.farthest(shown);
    if (next == ContactLists::kNone) break;
    const Contact& contact = balls_.contacts().contact(next);
    const Bounds near = distances_near(dot(open.cell.middle(), contact.at), contact.squared, most);
    if (near.lower > shown || near.upper <= shown) break;
    shown = near.upper;
    balls_.mark_used(next);
    turns_.push_back({next, shown});
  }
  return shown;
}

/// Finds contacts that show on the middle ray that no ball is larger than the target, or larger balls.
void CellSearch::show_along(Open& open) {
  constexpr int kMostSteps = 8;
  if (open.reach > balls_.target() + 2 * balls_.delta()) return;
  for (int step = 0; step < kMostSteps; ++step) {
    const double shown = shown_along_middle(open);
    if (shown <= 0) return;
    if (shown >= reach_along_middle(open)) return mix_along(open);
    const BallsNear::Probe found = balls_.probe_at(open.cell.middle(), shown);
    if (found.is_near && found.radius > balls_.best().radius) return;  // on the other side
    evaluate_again(open);
  }
}

/// Adds mixtures of the contacts that take turns along the middle ray to show that no ball is larger: beside it, one
/// contact alone shows it on either side of the medial surface only.
void CellSearch::mix_along(Open& open) {
  const double end = reach_along_middle(open);
  for (std::size_t i = 1; i < turns_.size() && turns_[i - 1].end < end; ++i) {
    const ContactLists& contacts = balls_.contacts();
    const std::optional<Contact> mixed =
        mixture(contacts.contact(turns_[i - 1].contact), contacts.contact(turns_[i].contact),
                turns_[i - 1].end * open.cell.middle());
    if (mixed) balls_.add_mixture(*mixed);
  }
  evaluate_again(open);
}

}  // namespace medial_vk
