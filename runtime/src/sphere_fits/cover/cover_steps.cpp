// The steps of the search: each changes balls and keeps changes that lower the sum.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "base/point_ops.h"
#include "sphere_fits/cover/centre_search.h"
#include "sphere_fits/cover/cover_search.h"
#include "sphere_fits/cover/smallest_ball.h"
#include "sphere_fits/quality/branch_and_bound.h"

namespace medial_vk {

/// By steps that are halved when none of them lowers the sum, from the present centre and from that of the smallest
/// ball.
Ball CoverSearch::best_around(std::uint32_t i, const std::vector<std::uint32_t>& some, int halvings) const {
  std::vector<Point> points;
  points.reserve(3 * some.size());
  for (const std::uint32_t element : some) {
    points.insert(points.end(), elements_.points(element).begin(), elements_.points(element).end());
  }
  constexpr double kReach = 1.6;
  const Ball smallest = smallest_ball(points);
  const Point from = balls_[i].centre;
  const double away = length(smallest.centre - from);
  const double reach = kReach * std::max(farthest_of(points, from), smallest.radius + away);
  // All elements that a step may touch.
  std::vector<std::uint32_t> near;
  elements_.gather({from, reach}, near);
  std::vector<PaidColumn> columns;
  columns.reserve(near.size());
  for (const std::uint32_t element : near) {
    if (!(elements_.area(element) > 0)) continue;
    const double rest = highest(element, i);
    const Column over = column(element);
    columns.push_back({over, elements_.area(element), rest, over.cost(rest, ease_)});
  }
  CentreSearch search(std::move(points), std::move(columns), ease_, {from, reach});
  search.attempt(smallest.centre);
  search.attempt(0.5 * (smallest.centre + from));
  return search.descend(smallest.centre, halvings);
}

std::vector<std::uint32_t> CoverSearch::costliest_first() const {
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < balls_.size(); ++i) {
    if (balls_[i].radius > 0) order.emplace_back(-share(i), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> balls;
  balls.reserve(order.size());
  for (const auto& [cost, i] : order) balls.push_back(i);
  return balls;
}

/// Without a change since the last call, this call would change nothing.
bool CoverSearch::is_same_as_slid(std::uint32_t i, std::size_t alone) const {
  return slid_[i] == Slid{alone, balls_[i].radius, share(i)};
}

void CoverSearch::slide() {
  constexpr std::size_t kBatch = 16;
  slid_.resize(balls_.size());
  std::vector<std::uint32_t> batch;
  for (const std::uint32_t i : costliest_first()) {
    if (is_same_as_slid(i, exclusive(i).size())) continue;
    batch.push_back(i);
    if (batch.size() < kBatch) continue;
    slide_batch(batch);
    batch.clear();
  }
  slide_batch(batch);
}

/// The moves of all balls are computed at once, on all threads. If another ball's move has left a ball with more to
/// hold, its move is recomputed in its turn.
void CoverSearch::slide_batch(std::span<const std::uint32_t> batch) {
  constexpr int kHalvings = 5;
  struct Plan {
    std::vector<std::uint32_t> alone;
    Ball ball;
  };
  const auto where = [&](std::uint32_t i, const std::vector<std::uint32_t>& alone) {
    return alone.empty() ? Ball{balls_[i].centre, 0} : best_around(i, alone, kHalvings);
  };
  std::vector<Plan> plans(batch.size());
  for_all(batch.size(), 1, threads_, [&](std::size_t k) {
    plans[k].alone = exclusive(batch[k]);
    plans[k].ball = where(batch[k], plans[k].alone);
  });
  for (std::size_t k = 0; k < batch.size(); ++k) {
    const std::uint32_t i = batch[k];
    std::vector<std::uint32_t> alone = exclusive(i);
    if (alone != plans[k].alone) plans[k] = {alone, where(i, alone)};
    const Ball before = balls_[i];
    const double total = total_;
    replace(i, plans[k].ball);
    if (total_ > total) replace(i, before);
    slid_[i] = {alone.size(), balls_[i].radius, share(i)};
  }
}

std::vector<std::uint32_t> CoverSearch::neighbours(std::uint32_t i, std::size_t count) const {
  std::vector<std::pair<double, std::uint32_t>> near;
  for (std::uint32_t j = 0; j < balls_.size(); ++j) {
    if (j == i || balls_[j].radius == 0) continue;
    near.emplace_back(length(balls_[j].centre - balls_[i].centre) - balls_[j].radius, j);
  }
  count = std::min(count, near.size());
  std::partial_sort(near.begin(), std::next(near.begin(), static_cast<std::ptrdiff_t>(count)), near.end());
  std::vector<std::uint32_t> balls;
  for (std::size_t k = 0; k < count; ++k) balls.push_back(near[k].second);
  return balls;
}

/// At most so much is gained if ball i shrinks around those of the elements `alone` that are not in `taker`.
double CoverSearch::gain_without(std::uint32_t i, const std::vector<std::uint32_t>& alone, const Ball& taker) const {
  std::vector<std::uint32_t> rest;
  std::ranges::copy_if(alone, std::back_inserter(rest), [&](std::uint32_t e) { return !elements_.is_in(taker, e); });
  const Ball shrunk = {balls_[i].centre, needed(balls_[i].centre, rest)};
  double gain = 0;
  for (const Touch& touch : touched_[i]) {
    const double other = highest(touch.element, i);
    if (!(touch.height > other)) continue;
    const bool is_touched = length(elements_.middle(touch.element) - shrunk.centre) <= shrunk.radius;
    const double least = is_touched ? std::max(other, column(touch.element).height(shrunk)) : other;
    if (touch.height > least) gain += cost_of(touch.element, touch.height) - cost_of(touch.element, least);
  }
  return gain;
}

bool CoverSearch::trade_one(std::uint32_t i) {
  threads_.check();
  const std::vector<std::uint32_t> alone = exclusive(i);
  const Ball whole = balls_[i];
  std::uint32_t support = 0;
  double most = -1;
  for (const std::uint32_t element : alone) {
    const double here = elements_.needed(whole.centre, element);
    if (here > most) {
      most = here;
      support = element;
    }
  }
  const double total = total_;
  for (const double part : {0.03, 0.12, 0.3}) {
    std::vector<std::uint32_t> given;
    for (const std::uint32_t element : alone) {
      if (length(elements_.middle(element) - elements_.middle(support)) <= part * whole.radius)
        given.push_back(element);
    }
    if (given.size() == alone.size()) return false;
    // Those that must grow least.
    std::vector<std::pair<double, std::uint32_t>> takers;
    const Point at = elements_.middle(support);
    for (std::uint32_t j = 0; j < balls_.size(); ++j) {
      if (j == i || balls_[j].radius == 0) continue;
      const double gap = length(balls_[j].centre - at) - balls_[j].radius;
      if (gap < 0.3 * whole.radius) takers.emplace_back(gap, j);
    }
    const std::size_t count = std::min<std::size_t>(3, takers.size());
    std::partial_sort(takers.begin(), std::next(takers.begin(), static_cast<std::ptrdiff_t>(count)), takers.end());
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t j = takers[k].second;
      const Ball grown = {balls_[j].centre, std::max(balls_[j].radius, needed(balls_[j].centre, given))};
      if (costs_more(j, grown.radius, gain_without(i, alone, grown))) continue;
      const std::vector<Saved> saved = {{j, balls_[j]}, {i, whole}};
      replace(j, grown);
      const std::vector<std::uint32_t> rest = exclusive(i);
      replace(i, rest.empty() ? Ball{whole.centre, 0} : Ball{whole.centre, needed(whole.centre, rest)});
      if (total_ < total * (1 - 1e-6)) return true;
      undo(saved);
    }
  }
  return false;
}

std::size_t CoverSearch::trade() {
  std::size_t traded = 0;
  for (std::uint32_t i = 0; i < balls_.size(); ++i) {
    for (int again = 0; again < 4 && balls_[i].radius > 0 && trade_one(i); ++again) ++traded;
  }
  return traded;
}

/// Assigns the elements that only ball i holds to the neighbour that must grow least for them, except `but`, unless the
/// sum surely rises by more than `most`.
bool CoverSearch::leave(std::uint32_t i, std::uint32_t but, double most, std::vector<Saved>& saved) {
  threads_.check();
  const std::vector<std::uint32_t> left = exclusive(i);
  if (!left.empty()) {
    std::uint32_t taker = i;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t j : neighbours(i, 6)) {
      const double growth = needed(balls_[j].centre, left) - balls_[j].radius;
      if (j != but && growth < least) {
        least = growth;
        taker = j;
      }
    }
    if (taker == i) return false;
    if (costs_more(taker, balls_[taker].radius + least, most + share(i))) return false;
    saved.push_back({taker, balls_[taker]});
    replace(taker, {balls_[taker].centre, std::max(balls_[taker].radius, needed(balls_[taker].centre, left))});
  }
  saved.push_back({i, balls_[i]});
  replace(i, {balls_[i].centre, 0});
  return true;
}

/// Of the elements that only `wide` holds, ball i, which holds nothing, takes the share that is nearest to the `tip`.
void CoverSearch::take_share(std::uint32_t i, std::uint32_t wide, const Point& tip, double share) {
  constexpr int kHalvings = 3;
  std::vector<std::pair<double, std::uint32_t>> sorted;
  for (const std::uint32_t element : exclusive(wide))
    sorted.emplace_back(length(elements_.middle(element) - tip), element);
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint32_t> part;
  const auto count = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  for (std::size_t k = 0; k < std::min(count, sorted.size()); ++k) part.push_back(sorted[k].second);
  if (part.empty()) return;
  balls_[i].centre = 0.5 * (balls_[wide].centre + around(part).centre);
  replace(i, best_around(i, part, kHalvings));
  for (const std::uint32_t each : {wide, i}) {
    const std::vector<std::uint32_t> own = exclusive(each);
    replace(each, own.empty() ? Ball{balls_[each].centre, 0} : best_around(each, own, kHalvings));
  }
}

/// The point at which a ball reaches out most, and the farthest point to which it reaches for an element that only it
/// holds.
std::array<Point, 2> CoverSearch::tips(std::uint32_t i) const {
  std::array<Point, 2> tips{};
  std::array<double, 2> most = {-1, -1};
  for (const std::uint32_t element : exclusive(i)) {
    const std::array<double, 2> here = {elements_.area(element) > 0 ? highest(element, 0xffffffffu) : -1,
                                        elements_.needed(balls_[i].centre, element)};
    for (std::size_t k = 0; k < 2; ++k) {
      if (here[k] <= most[k]) continue;
      most[k] = here[k];
      tips[k] = elements_.middle(element);
    }
  }
  return tips;
}

bool CoverSearch::move_to(std::uint32_t free, std::uint32_t wide) {
  const double total = total_;
  std::vector<Saved> saved = {{wide, balls_[wide]}};
  if (!leave(free, wide, share_beside(wide, free), saved)) return false;
  // Two balls in place of `wide` leave at least what others cause.
  if (total_ - share(wide) >= total * (1 - 1e-6)) {
    undo(saved);
    return false;
  }
  const Ball whole = balls_[wide], none = balls_[free];
  const std::array<Point, 2> at = tips(wide);
  for (const auto& [k, share] : {std::pair<std::size_t, double>{0, 0.5}, {1, 0.2}}) {
    take_share(free, wide, at[k], share);
    if (total_ < total * (1 - 1e-6)) return true;
    replace(wide, whole);
    replace(free, none);
  }
  undo(saved);
  return false;
}

/// An estimate, in which one neighbour takes over all elements. Only a trial gives the actual increase.
double CoverSearch::price_to_leave(std::uint32_t i) const {
  const std::vector<std::uint32_t> alone = exclusive(i);
  if (alone.empty()) return 0;
  double price = std::numeric_limits<double>::infinity();
  for (const std::uint32_t j : neighbours(i, 6)) {
    const double radius = std::max(balls_[j].radius, needed(balls_[j].centre, alone));
    price = std::min(price, (radius - balls_[j].radius) * radius * radius);
  }
  return price;
}

std::size_t CoverSearch::relocate() {
  // The share of the volume that a ball adds bounds the gain by another ball beside it; elements that a ball holds
  // alone must be held by a neighbour. The balls whose removal is cheapest are tried first.
  const std::size_t tries = std::max<std::size_t>(4, balls_.size() / 6);
  std::vector<std::pair<double, std::uint32_t>> free, wide;
  for (std::uint32_t i = 0; i < balls_.size(); ++i) {
    wide.emplace_back(-share(i), i);
    free.emplace_back(price_to_leave(i), i);
  }
  std::sort(free.begin(), free.end());
  std::sort(wide.begin(), wide.end());
  std::size_t relocated = 0, at = 0, next = 0;
  for (std::size_t k = 0; k < 2 * tries && at < free.size() && next < wide.size(); ++k) {
    const std::uint32_t from = free[at].second;
    const bool is_idle = free[at].first == 0;
    const bool moved = from != wide[next].second && move_to(from, wide[next].second);
    relocated += moved;
    ++next;
    // The removal of an idle ball costs nothing, so it is tried at one ball after the other.
    if (moved || !is_idle) ++at;
  }
  return relocated;
}

void CoverSearch::remove_one() {
  constexpr std::size_t kTries = 6;
  std::vector<std::pair<double, std::uint32_t>> order(balls_.size());
  for (std::uint32_t i = 0; i < balls_.size(); ++i) order[i] = {price_to_leave(i), i};
  std::sort(order.begin(), order.end());
  std::uint32_t cheapest = order.front().second;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < std::min(kTries, order.size()); ++k) {
    std::vector<Saved> saved;
    if (leave(order[k].second, order[k].second, HUGE_VAL, saved) && total_ < least) {
      least = total_;
      cheapest = order[k].second;
    }
    undo(saved);
  }
  std::vector<Saved> saved;
  leave(cheapest, cheapest, HUGE_VAL, saved);
  const auto last = static_cast<std::uint32_t>(balls_.size() - 1);
  const Ball moved = balls_[last];
  replace(last, {moved.centre, 0});
  if (cheapest != last) replace(cheapest, moved);
  slid_.resize(balls_.size());
  slid_[cheapest] = slid_[last];
  balls_.pop_back();
  touched_.pop_back();
  slid_.pop_back();
}

}  // namespace medial_vk
