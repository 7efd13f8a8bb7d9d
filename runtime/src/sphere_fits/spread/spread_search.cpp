#include "sphere_fits/spread/spread_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/point_ops.h"
#include "sphere_fits/cover/smallest_ball.h"
#include "sphere_fits/steps/ball_steps.h"
#include "sphere_fits/steps/maximal_ball.h"

namespace medial_vk {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Depths below a place where the balls that touch the boundary next to it begin, as shares of the diagonal.
constexpr std::array<double, 3> kDepths = {1e-3, 6e-3, 3e-2};
/// The least part by which a change must lower the distance that it is about, so that changes end.
constexpr double kLeastFall = 1e-4;
constexpr std::size_t kBlock = 512;  // of places, for one thread

double distance_to(const Point& p, const Ball& ball) { return length(p - ball.centre) - ball.radius; }

}  // namespace

std::optional<Ball> maximal_through(const Solid& solid, const Point& p) {
  if (!solid.contains(p)) return std::nullopt;
  const Ball ball = maximal_ball(solid, p);
  return ball.radius > 0 && stays_inside(solid, ball) ? std::optional(ball) : std::nullopt;
}

std::vector<BoundarySample> places_of(const Solid& solid, std::size_t count) {
  return sample_boundary(solid.mesh().mesh, count);
}

SpreadSearch::SpreadSearch(const Solid& solid, std::vector<BoundarySample> places, Threads threads, bool points_too)
    : solid_(solid),
      places_(std::move(places)),
      threads_(std::move(threads)),
      points_too_(points_too),
      nearest_(places_.size(), {kFar, kFar, 0}),
      dead_(places_.size()),
      reach_(places_.size(), points_too ? Reach::kSome : Reach::kUnknown) {
  arrange(0, places_.size());
  // Where the mesh bounds the solid and nothing else, few places can be next to no ball, and are found one by one.
  if (points_too_ || solid_.has_volume()) return;
  for_all(places_.size(), 64, threads_, [&](std::size_t place) { is_reachable(place); });
}

/// Halves the places across the longest side of their box, until few are left.
void SpreadSearch::arrange(std::size_t first, std::size_t last) {
  constexpr std::size_t kMost = 64;
  if (last - first <= kMost) return add_block(first, last);
  Point lower = places_[first].at, upper = lower;
  for (std::size_t i = first; i < last; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], places_[i].at[k]);
      upper[k] = std::max(upper[k], places_[i].at[k]);
    }
  }
  const Point sides = upper - lower;
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return places_.begin() + static_cast<std::ptrdiff_t>(i); };
  // Sorted by all coordinates, so that the order does not depend on the algorithm.
  std::sort(at(first), at(last), [&](const BoundarySample& a, const BoundarySample& b) {
    return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.at < b.at;
  });
  arrange(first, middle);
  arrange(middle, last);
}

void SpreadSearch::add_block(std::size_t first, std::size_t last) {
  Block block = {first, last, {}, 0};
  for (std::size_t i = first; i < last; ++i) block.middle = block.middle + places_[i].at;
  block.middle = (1 / static_cast<double>(last - first)) * block.middle;
  for (std::size_t i = first; i < last; ++i) {
    block.radius = std::max(block.radius, length(places_[i].at - block.middle));
  }
  blocks_.push_back(block);
}

double SpreadSearch::gap() const {
  double widest = 0;
  for (std::size_t place = 0; place < places_.size(); ++place) {
    if (reach_[place] != Reach::kNone) widest = std::max(widest, nearest_[place].distance);
  }
  return widest;
}

double SpreadSearch::reachable_gap() {
  for (;;) {
    const double widest = gap();
    bool is_reached = true;
    for (std::size_t place = 0; place < places_.size(); ++place) {
      if (reach_[place] != Reach::kNone && nearest_[place].distance == widest) is_reached &= is_reachable(place);
    }
    if (is_reached || widest == 0) return widest;
  }
}

/// A property of the place, whatever the present balls are, so that a search that is repeated finds the same.
bool SpreadSearch::is_reachable(std::size_t place) {
  if (reach_[place] == Reach::kUnknown)
    reach_[place] = balls_at(places_[place], kFar).empty() ? Reach::kNone : Reach::kSome;
  return reach_[place] == Reach::kSome;
}

/// Of those at which a ball may still come; the number of places if there is none.
std::size_t SpreadSearch::farthest_place() {
  for (;;) {
    std::size_t farthest = places_.size();
    for (std::size_t place = 0; place < places_.size(); ++place) {
      if (dead_[place] != 0 || reach_[place] == Reach::kNone || !(nearest_[place].distance > 0)) continue;
      if (farthest == places_.size() || nearest_[place].distance > nearest_[farthest].distance) farthest = place;
    }
    if (farthest == places_.size() || is_reachable(farthest)) return farthest;
    threads_.check();
  }
}

/// The two balls nearest to any of the places are among those that are no farther from the middle than the second one
/// there by more than twice the radius of the block.
void SpreadSearch::assign(const Block& block) {
  constexpr double kRoom = 1e-12;  // more than distances are rounded by, of the largest
  std::vector<double> from_middle(balls_.size());
  double first = kFar, second = kFar;
  for (std::size_t i = 0; i < balls_.size(); ++i) {
    const double distance = from_middle[i] = distance_to(block.middle, balls_[i]);
    second = std::min(second, std::max(first, distance));
    first = std::min(first, distance);
  }
  const double most = second + 2 * block.radius + kRoom * (solid_.diagonal() + std::fabs(second));
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < balls_.size(); ++i) {
    if (from_middle[i] <= most) near.push_back(i);
  }
  for (std::size_t place = block.first; place < block.last; ++place) {
    Nearest& nearest = nearest_[place] = {kFar, kFar, 0};
    for (const std::uint32_t i : near) {
      const double distance = distance_to(places_[place].at, balls_[i]);
      if (distance < nearest.distance) {
        nearest = {distance, nearest.distance, i};
      } else if (distance < nearest.next) {
        nearest.next = distance;
      }
    }
  }
}

void SpreadSearch::assign() {
  for_all(blocks_.size(), 8, threads_, [&](std::size_t i) { assign(blocks_[i]); });
}

void SpreadSearch::restore(std::vector<Ball> balls) {
  balls_ = std::move(balls);
  std::ranges::fill(dead_, 0);
  assign();
}

void SpreadSearch::add_place(const BoundarySample& place) {
  places_.push_back(place);
  nearest_.push_back({kFar, kFar, 0});
  dead_.push_back(0);
  reach_.push_back(points_too_ ? Reach::kSome : Reach::kUnknown);
  add_block(places_.size() - 1, places_.size());
  assign(blocks_.back());
}

void SpreadSearch::take(const Ball& ball) {
  const auto number = static_cast<std::uint32_t>(balls_.size());
  balls_.push_back(ball);
  for_all(places_.size(), kBlock, threads_, [&](std::size_t place) {
    Nearest& nearest = nearest_[place];
    const double distance = distance_to(places_[place].at, ball);
    if (distance < nearest.distance) {
      nearest = {distance, nearest.distance, number};
    } else {
      nearest.next = std::min(nearest.next, distance);
    }
  });
}

/// The maximal ball through the point, or, if that lies outside, through one next to the boundary point nearest to it.
std::optional<Ball> SpreadSearch::ball_near(const Point& p) const {
  if (std::optional<Ball> ball = maximal_through(solid_, p)) return ball;
  const Point at = solid_.closest(p).point, across = at - p;
  const double away = length(across);
  if (!(away > 0)) return std::nullopt;
  double depth = kDepths.front() * solid_.diagonal();
  while (depth > 4 * solid_.rounding()) {
    if (std::optional<Ball> ball = maximal_through(solid_, at + (depth / away) * across)) return ball;
    depth /= 4;
  }
  return std::nullopt;
}

/// Balls that touch the boundary next to the place, or hold it.
std::vector<Ball> SpreadSearch::balls_at(const BoundarySample& place, double gap) const {
  constexpr int kTries = 6;
  std::vector<Ball> found;
  const auto offer = [&](const std::optional<Ball>& ball) {
    if (ball) found.push_back(*ball);
  };
  if (place.inward == Point{}) {
    offer(ball_near(place.at));
    return found;
  }
  std::vector<double> depths;
  depths.reserve(kDepths.size() + 1);
  for (const double share : kDepths) depths.push_back(share * solid_.diagonal());
  if (std::isfinite(gap)) depths.push_back(0.5 * gap);
  for (double depth : depths) {
    std::optional<Ball> ball;
    for (int tries = 0; tries < kTries && !ball; ++tries, depth /= 4) {
      ball = maximal_through(solid_, place.at + depth * place.inward);
    }
    offer(ball);
  }
  return found;
}

/// By how much the ball lowers the sum of the squares of the distances. (Without any ball, the least sum counts.)
double SpreadSearch::saving(const Ball& ball) const {
  double sum = 0;
  for (std::size_t place = 0; place < places_.size(); ++place) {
    const double distance = std::max(0.0, distance_to(places_[place].at, ball));
    const double before = balls_.empty() ? 0 : std::max(0.0, nearest_[place].distance);
    if (distance < before || balls_.empty()) sum += before * before - distance * distance;
  }
  return sum;
}

bool SpreadSearch::insert() {
  for (std::size_t farthest = farthest_place(); farthest < places_.size(); farthest = farthest_place()) {
    threads_.check();
    std::optional<Ball> best;
    double most = 0;
    for (const Ball& ball : balls_at(places_[farthest], nearest_[farthest].distance)) {
      if (!(distance_to(places_[farthest].at, ball) < (1 - kLeastFall) * nearest_[farthest].distance)) continue;
      const double here = saving(ball);
      if (best && !(here > most)) continue;
      best = ball;
      most = here;
    }
    if (!best && points_too_) best = Ball{places_[farthest].at, 0};
    if (best) {
      take(*best);
      return true;
    }
    dead_[farthest] = 1;
  }
  return false;
}

double SpreadSearch::farthest(const Ball& ball, const std::vector<std::uint32_t>& own, Point* at) const {
  double widest = -kFar;
  for (const std::uint32_t place : own) {
    const double distance = distance_to(places_[place].at, ball);
    if (!(distance > widest)) continue;
    widest = distance;
    if (at != nullptr) *at = places_[place].at;
  }
  return widest;
}

/// A ball whose greatest distance from these places is less: around the centre of the smallest ball that holds them, or
/// else a small step towards the farthest of them (M. Badoiu, K. Clarkson, 2003).
Ball SpreadSearch::shifted(const Ball& ball, const std::vector<std::uint32_t>& own) const {
  Point far = ball.centre;
  const double now = farthest(ball, own, &far);
  const auto is_better = [&](const std::optional<Ball>& other) {
    return other && farthest(*other, own) < now - kLeastFall * std::fabs(now);
  };
  std::vector<Point> points;
  points.reserve(own.size());
  for (const std::uint32_t place : own) points.push_back(places_[place].at);
  if (const std::optional<Ball> middle = ball_near(smallest_ball(points).centre); is_better(middle)) return *middle;
  for (const double step : {0.3, 0.1, 0.03}) {
    const std::optional<Ball> nearer = ball_near(ball.centre + step * (far - ball.centre));
    if (is_better(nearer)) return *nearer;
  }
  return ball;
}

/// Every ball by the places that are nearest to it: their greatest distance does not grow.
bool SpreadSearch::shift_all() {
  std::vector<std::vector<std::uint32_t>> own(balls_.size());
  for (std::uint32_t place = 0; place < places_.size(); ++place) {
    if (reach_[place] != Reach::kNone) own[nearest_[place].ball].push_back(place);
  }
  std::vector<std::uint8_t> moved(balls_.size());
  std::vector<Ball> next = balls_;
  for_all(balls_.size(), 1, threads_, [&](std::size_t i) {
    if (own[i].empty()) return;
    next[i] = shifted(balls_[i], own[i]);
    moved[i] = next[i].centre == balls_[i].centre ? 0 : 1;
  });
  if (std::ranges::find(moved, 1) == moved.end()) return false;
  restore(std::move(next));
  return true;
}

std::size_t SpreadSearch::count_farther(double distance) const {
  std::size_t count = 0;
  for (std::size_t place = 0; place < places_.size(); ++place) {
    count += reach_[place] != Reach::kNone && nearest_[place].distance >= distance;
  }
  return count;
}

/// A ball without which no place is as far as the farthest now comes where the gap is widest, if fewer places are then
/// that far.
bool SpreadSearch::exchange() {
  const double far = (1 - kLeastFall) * gap();
  std::vector<double> without(balls_.size(), 0);
  for (std::size_t place = 0; place < places_.size(); ++place) {
    const Nearest& nearest = nearest_[place];
    if (reach_[place] != Reach::kNone) without[nearest.ball] = std::max(without[nearest.ball], nearest.next);
  }
  const auto least = std::ranges::min_element(without);
  if (!(*least < far)) return false;
  const std::size_t farther = count_farther(far);
  std::vector<Ball> before = balls_, fewer = balls_;
  std::vector<Nearest> nearest_before = nearest_;
  fewer.erase(fewer.begin() + (least - without.begin()));
  restore(std::move(fewer));
  if (insert() && count_farther(far) < farther) return true;
  balls_ = std::move(before);
  nearest_ = std::move(nearest_before);
  return false;
}

void SpreadSearch::improve(int rounds) {
  constexpr int kPatience = 3;
  constexpr double kEnough = 5e-3;  // a smaller fall of the gap is none
  constexpr std::size_t kMany = 1024, kExchangesOfMany = 64, kExchangesOfBall = 64;
  if (balls_.empty()) return;
  std::vector<Ball> best = balls_;
  double least = gap(), at_rest = least;
  int idle = 0;
  for (int round = 0; round < rounds && idle < kPatience; ++round) {
    threads_.check();
    bool has_changed = false;
    // Of many balls each exchange takes long, and gains little.
    const std::size_t most = balls_.size() > kMany ? kExchangesOfMany : balls_.size() * kExchangesOfBall;
    for (std::size_t k = 0; k < most && balls_.size() > 1 && exchange(); ++k) has_changed = true;
    has_changed = shift_all() || has_changed;
    const double now = gap();
    if (now < least) {
      least = now;
      best = balls_;
    }
    if (!has_changed) break;
    idle = now < (1 - kEnough) * at_rest ? 0 : idle + 1;
    at_rest = std::min(at_rest, now);
  }
  restore(std::move(best));
}

}  // namespace medial_vk
