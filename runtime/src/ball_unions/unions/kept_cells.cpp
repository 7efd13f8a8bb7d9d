#include "ball_unions/unions/kept_cells.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {

double reach_of(std::span<const PowerCell::Corner> corners) {
  double reach = 0;
  for (const PowerCell::Corner& corner : corners) reach = std::max(reach, length(corner.at) + corner.slack);
  return reach * (1 + 0x1p-30) + 0x1p-40;
}

KeptCells::KeptCells(std::size_t balls, std::size_t usual) : kept_(balls) {
  for (Change* change : {&last_, &before_}) {
    change->balls.reserve(usual);
    change->before.reserve(usual);
  }
  places_.reserve(balls + 2 * usual);
}

void KeptCells::clear() {
  std::ranges::fill(kept_, Kept{});
  last_.clear();
  before_.clear();
  store_.clear();
}

bool KeptCells::may_grow_without(std::uint32_t ball, std::uint32_t i) const {
  const auto name = static_cast<std::int32_t>(i);
  const CellStore::Place& cell = kept_[ball].cell;
  return cell.is_empty() ||
         std::ranges::any_of(store_.planes(cell), [&](const Bisector& plane) { return plane.ball == name; });
}

void KeptCells::start_change() {
  std::swap(last_, before_);
  last_.clear();
}

void KeptCells::forget_changes() {
  last_.clear();
  before_.clear();
}

void KeptCells::put(std::uint32_t ball, const PowerCell& cell, const BallInCell& measured) {
  if (!store_.has_room_for(cell)) close_gaps(cell);
  replace(ball, {store_.keep(cell), measured, reach_of(cell.corners())});
}

void KeptCells::put_for_good(std::uint32_t ball, const PowerCell& cell, const BallInCell& measured) {
  last_.balls.push_back(ball);
  if (!store_.has_room_for(cell)) close_gaps(cell);
  kept_[ball] = {store_.keep(cell), measured, reach_of(cell.corners())};
}

void KeptCells::replace(std::uint32_t ball, const Kept& by) {
  last_.before.emplace_back(ball, kept_[ball]);
  last_.balls.push_back(ball);
  kept_[ball] = by;
}

void KeptCells::undo() {
  for (auto& [ball, kept] : last_.before) std::swap(kept_[ball], kept);
  last_.clear();
}

void KeptCells::give_up() {
  undo();
  std::swap(last_, before_);
}

/// Of the cells that are needed: those of all balls, and those to which changes can be taken back.
void KeptCells::list_places() {
  places_.clear();
  const auto add = [&](Kept& kept) {
    if (kept.cell.planes > 0) places_.push_back(&kept.cell);
  };
  for (Kept& kept : kept_) add(kept);
  for (Change* change : {&last_, &before_}) {
    for (auto& [ball, kept] : change->before) add(kept);
  }
  std::ranges::sort(places_, {}, &CellStore::Place::first_plane);
}

void KeptCells::close_gaps(const PowerCell& next) {
  list_places();
  store_.close_gaps(places_, next);
}

void KeptCells::make_room() {
  list_places();
  store_.make_room(places_);
}

}  // namespace medial_vk
