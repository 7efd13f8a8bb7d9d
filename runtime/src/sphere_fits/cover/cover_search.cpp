#include "sphere_fits/cover/cover_search.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sphere_fits/cover/smallest_ball.h"
#include "sphere_fits/quality/nearest_ball_tree.h"

namespace medial_vk {

CoverSearch::CoverSearch(CoverElements elements, std::vector<Ball> balls, double ease, Threads threads)
    : elements_(std::move(elements)), balls_(std::move(balls)), ease_(ease), threads_(std::move(threads)) {
  const NearestBallTree tree(balls_);
  std::vector<std::uint32_t> owner(elements_.size());
  for_all(elements_.size(), 64, threads_, [&](std::size_t element) {
    owner[element] = tree.nearest(elements_.middle(static_cast<std::uint32_t>(element))).ball;
  });
  for (std::uint32_t element = 0; element < owner.size(); ++element) {
    Ball& ball = balls_[owner[element]];
    ball.radius = std::max(ball.radius, elements_.needed(ball.centre, element) * kCoverRoom);
  }
  recount();
}

double CoverSearch::highest(std::uint32_t element, std::uint32_t but) const {
  const Highest& two = highest_[element];
  return two[0].ball == but ? two[1].height : two[0].height;
}

void CoverSearch::rank(const Holder& holder, Highest& two) {
  if (holder.height > two[0].height) {
    two = {holder, two[0]};
  } else if (holder.height > two[1].height) {
    two[1] = holder;
  }
}

void CoverSearch::add_holder(std::uint32_t element, const Holder& holder) {
  holders_[element].push_back(holder);
  rank(holder, highest_[element]);
}

void CoverSearch::remove_holder(std::uint32_t element, std::uint32_t ball) {
  std::vector<Holder>& holders = holders_[element];
  *std::find_if(holders.begin(), holders.end(), [ball](const Holder& h) { return h.ball == ball; }) = holders.back();
  holders.pop_back();
  Highest& two = highest_[element];
  if (two[0].ball != ball && two[1].ball != ball) return;
  two = {};
  for (const Holder& holder : holders) rank(holder, two);
}

void CoverSearch::recount() {
  touched_.assign(balls_.size(), {});
  holders_.assign(elements_.size(), {});
  held_.assign(elements_.size(), 0);
  highest_.assign(elements_.size(), {});
  total_ = 0;
  std::vector<Ball> balls(balls_.size());
  balls.swap(balls_);
  for (std::uint32_t i = 0; i < balls.size(); ++i) balls_[i] = {balls[i].centre, 0};
  for (std::uint32_t i = 0; i < balls.size(); ++i) replace(i, balls[i]);
}

void CoverSearch::replace(std::uint32_t i, const Ball& ball) {
  for (const Touch& touch : touched_[i]) {
    remove_holder(touch.element, i);
    held_[touch.element] -= touch.holds;
    const double rest = highest_[touch.element][0].height;
    if (touch.height > rest) total_ += cost_of(touch.element, rest) - cost_of(touch.element, touch.height);
  }
  balls_[i] = ball;
  touched_[i].clear();
  if (ball.radius == 0) return;
  elements_.gather(ball, found_);
  touched_[i].reserve(found_.size());
  for (const std::uint32_t element : found_) {
    const double height = elements_.area(element) > 0 ? column(element).height(ball) : 0;
    const double rest = highest_[element][0].height;
    if (height > rest) total_ += cost_of(element, height) - cost_of(element, rest);
    const bool holds = elements_.is_in(ball, element);
    touched_[i].push_back({element, holds, height});
    held_[element] += holds;
    add_holder(element, {i, height});
  }
}

void CoverSearch::undo(const std::vector<Saved>& saved) {
  for (std::size_t n = saved.size(); n-- > 0;) replace(saved[n].ball, saved[n].before);
}

std::vector<std::uint32_t> CoverSearch::exclusive(std::uint32_t i) const {
  std::vector<std::uint32_t> alone;
  for (const Touch& touch : touched_[i]) {
    if (touch.holds && held_[touch.element] == 1) alone.push_back(touch.element);
  }
  return alone;
}

double CoverSearch::needed(const Point& centre, const std::vector<std::uint32_t>& some) const {
  return elements_.needed(centre, some) * kCoverRoom;
}

Ball CoverSearch::around(const std::vector<std::uint32_t>& some) const {
  std::vector<Point> points;
  for (const std::uint32_t element : some) {
    points.insert(points.end(), elements_.points(element).begin(), elements_.points(element).end());
  }
  Ball ball = smallest_ball(points);
  ball.radius *= kCoverRoom;
  return ball;
}

double CoverSearch::share(std::uint32_t i) const {
  double sum = 0;
  for (const Touch& touch : touched_[i]) {
    const double rest = highest(touch.element, i);
    if (touch.height > rest) sum += cost_of(touch.element, touch.height) - cost_of(touch.element, rest);
  }
  return sum;
}

double CoverSearch::share_beside(std::uint32_t i, std::uint32_t j) const {
  double sum = 0;
  for (const Touch& touch : touched_[i]) {
    double rest = 0;
    for (const Holder& holder : holders_[touch.element]) {
      if (holder.ball != i && holder.ball != j) rest = std::max(rest, holder.height);
    }
    if (touch.height > rest) sum += cost_of(touch.element, touch.height) - cost_of(touch.element, rest);
  }
  return sum;
}

bool CoverSearch::costs_more(std::uint32_t i, double radius, double most) const {
  const Ball ball = {balls_[i].centre, radius};
  double sum = 0;
  for (const Touch& touch : touched_[i]) {
    const std::uint32_t element = touch.element;
    if (!(elements_.area(element) > 0)) continue;
    const double height = column(element).height(ball);
    const double paid = highest_[element][0].height;
    if (height > paid) sum += cost_of(element, height) - cost_of(element, paid);
    if (sum > most) return true;
  }
  return false;
}

void CoverSearch::refine() {
  constexpr double kSmall = 0.05;  // of the ball's radius: such an element reaches only negligibly out of it
  std::vector<bool> which(elements_.size());
  for (std::uint32_t i = 0; i < balls_.size(); ++i) {
    for (const std::uint32_t element : exclusive(i)) {
      const bool holds_up = elements_.needed(balls_[i].centre, element) > 0.98 * balls_[i].radius;
      if (holds_up && elements_.needed(elements_.middle(element), element) > kSmall * balls_[i].radius)
        which[element] = true;
    }
  }
  elements_.refine(which);
  recount();
}

void CoverSearch::restore(std::vector<Ball> balls) {
  balls_ = std::move(balls);
  recount();
}

void CoverSearch::add(std::span<const Point> points) {
  for (const Point& p : points) {
    elements_.add({&p, 1});
    Ball* taker = &balls_.front();
    double least = std::numeric_limits<double>::infinity();
    for (Ball& ball : balls_) {
      const double growth = std::max(0.0, length(p - ball.centre) - ball.radius);
      if (ball.radius > 0 && growth < least) least = growth, taker = &ball;
    }
    taker->radius = std::max(taker->radius, length(p - taker->centre) * kCoverRoom);
  }
  recount();
}

}  // namespace medial_vk
