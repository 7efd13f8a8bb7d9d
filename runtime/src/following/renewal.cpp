#include "following/renewal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include "ball_unions/unions/union_measurer.h"
#include "following/ascent.h"
#include "following/greatest_ball.h"
#include "following/tangent_rule.h"

namespace medial_vk {
namespace {

// Balls whose exact gain or loss is computed, for each that may be chosen: at vertices of the envelope, at points of
// the surface, and of those that may leave.
constexpr std::size_t kAtVertices = 4, kAtSurface = 4, kLeaving = 2;

/// A gap is passed over where a chosen ball is nearer than this share of its width.
constexpr double kSameGap = 0.5;

/// By which factor a gain exceeds the loss, so that balls do not change places for next to nothing; and by which share
/// the union has grown, far above the rounding of its volume (10^-12).
constexpr double kWorth = 1.1;
constexpr double kCertain = 1 + 1e-10;

/// The steps of a ball that has come, and the first of them as a share of its radius.
constexpr int kSlides = 2;
constexpr double kFirstSlide = 0.2;

constexpr std::uint32_t kNowhere = 0xffffffffu;

/// Balls next to one that leaves or comes, for which memory is allocated beforehand.
constexpr std::size_t kUsualOthersNoted = 128;

/// The width of a place where no ball may come.
constexpr double kNotHere = -1;

/// Of the coordinates of balls in the box of the surface.
double largest_coordinate(const MovingSurface& surface, std::span<const Ball> balls) {
  double largest = 0;
  for (const Ball& ball : balls) {
    for (const double x : ball.centre) largest = std::max(largest, std::fabs(x));
  }
  return largest + 2 * surface.longest_side();
}

template <class Order, class T>
T pop_from(std::vector<T>& heap, const Order& order) {
  std::ranges::pop_heap(heap, order);
  const T top = heap.back();
  heap.pop_back();
  return top;
}

template <class Order, class T>
void push_to(std::vector<T>& heap, const T& value, const Order& order) {
  heap.push_back(value);
  std::ranges::push_heap(heap, order);
}

}  // namespace

Result<Renewal> Renewal::build(const MovingSurface& surface, std::span<const Ball> balls, const GapSamples& samples,
                               std::uint32_t most) {
  Result<DynamicUnion> all =
      DynamicUnion::build(static_cast<std::uint32_t>(balls.size()), largest_coordinate(surface, balls));
  if (!all) return all.error();
  Renewal renewal(std::move(all).value(), {surface, balls.size(), samples}, balls.size(), most);
  if (Status status = renewal.add_balls(balls); !status) return status.error();
  if (Status status = renewal.union_.make_room(); !status) return status.error();
  return renewal;
}

Renewal::Renewal(DynamicUnion all, WatchedPoints watched, std::size_t balls, std::uint32_t most)
    : most_(most), union_(std::move(all)), watched_(std::move(watched)), slot_of_(balls), ball_at_(balls) {
  const std::size_t at_once = std::min<std::size_t>(most, balls);  // each ball leaves once
  const std::size_t usual = (kAtVertices + kAtSurface) * at_once;
  candidates_.reserve(usual);
  gains_.reserve(usual);
  losses_.reserve(balls);
  by_estimate_.reserve(balls);
  exchanges_.reserve(at_once);
  others_.reserve(kUsualOthersNoted * at_once);
  noted_in_.resize(balls);
  places_.reserve(std::max(watched_.points().size(), UnionMeasurer::kRoomOfBall * balls));
}

Result<std::span<const BallExchange>> Renewal::find(const MovingSurface& surface, std::span<const Ball> balls,
                                                    const BallUnion& measured, const ExchangeRegions& regions,
                                                    WorkerPool& pool) {
  const FrameInput in = {surface, balls, measured, regions, pool};
  exchanges_.clear();
  others_.clear();
  std::ranges::fill(noted_in_, 0u);
  if (Status status = union_.clear(largest_coordinate(surface, balls)); !status) return status.error();
  watched_.start(surface, balls, regions.samples, pool);
  if (Status status = add_balls(balls); !status) return status.error();
  candidates_.clear();
  find_pockets(in);
  grow(surface, kAtVertices * most_);
  find_uncovered_points(in);
  grow(surface, kAtSurface * most_);
  if (Status status = value_candidates(); !status) return status.error();
  if (Status status = value_leaving(in); !status) return status.error();
  while (exchanges_.size() < most_) {
    const Result<bool> is_added = add_exchange(surface);
    if (!is_added) return is_added.error();
    if (!is_added.value()) break;
  }
  return std::span<const BallExchange>(exchanges_);
}

bool Renewal::is_lost(std::uint32_t ball) const { return slot_of_[ball] == kNowhere; }

Status Renewal::add_balls(std::span<const Ball> balls) {
  std::ranges::fill(slot_of_, kNowhere);
  std::ranges::fill(ball_at_, kNowhere);
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    if (balls[i].radius > 0) {
      if (Status status = add(i, balls[i]); !status) return status;
    }
  }
  return {};
}

Status Renewal::add(std::uint32_t i, const Ball& ball) {
  const Result<std::uint32_t> slot = union_.add(ball);
  if (!slot) return slot.error();
  slot_of_[i] = slot.value();
  ball_at_[slot.value()] = i;
  return {};
}

/// Vertices of the envelope, by their distance from the surface: pockets between balls.
void Renewal::find_pockets(const FrameInput& in) {
  const std::vector<EnvelopeVertex>& vertices = in.measured.vertices;
  places_.resize(vertices.size());
  in.pool.run(places_.size(), 16, [&](std::size_t i) {
    const Point& at = vertices[i].at;
    const BvhHit nearest = in.surface.closest(at, std::numeric_limits<double>::infinity());
    const double width = in.is_chosen(nearest.triangle) ? std::sqrt(nearest.squared_distance) : kNotHere;
    places_[i] = {at, width, kNowhere, static_cast<std::uint32_t>(i)};
  });
  sort_places();
}

/// Middles of triangles, by their distance from the balls.
void Renewal::find_uncovered_points(const FrameInput& in) {
  places_.clear();
  for (const WatchedPoint& point : watched_.points()) {
    if (!point.is_middle || !in.is_chosen(point.triangle)) continue;
    places_.push_back({point.at, point.distance, point.triangle, static_cast<std::uint32_t>(places_.size())});
  }
  sort_places();
}

/// Without those where no ball may come.
void Renewal::sort_places() {
  std::erase_if(places_, [](const GapPlace& place) { return place.width == kNotHere; });
  std::ranges::sort(places_, [](const GapPlace& a, const GapPlace& b) {
    return a.width != b.width ? a.width > b.width : a.number < b.number;
  });
}

/// The greatest balls at the first `most` places that are not next to one of them.
void Renewal::grow(const MovingSurface& surface, std::size_t most) {
  for (const GapPlace& place : places_) {
    if (most == 0) return;
    if (is_next_to_candidate(place)) continue;
    --most;
    const TrackedBall grown =
        place.triangle == kNowhere
            ? greatest_ball_at(surface, place.at, {}, {})
            : greatest_ball(surface, {middle_of(place.triangle), surface.inward_normal(place.triangle)}, {});
    if (grown.ball.radius > 0) candidates_.push_back(grown);
  }
}

bool Renewal::is_next_to_candidate(const GapPlace& place) const {
  const double near = (place.triangle == kNowhere ? 0 : kSameGap) * place.width;
  return std::ranges::any_of(candidates_, [&](const TrackedBall& candidate) {
    return length(place.at - candidate.ball.centre) - candidate.ball.radius < near;
  });
}

Status Renewal::value_candidates() {
  gains_.clear();
  for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
    const Result<double> gain = union_.gain(candidates_[k].ball);
    if (!gain) return gain.error();
    push_to(gains_, Valued{gain.value(), k}, std::less<>());
  }
  return {};
}

/// Lost balls lose nothing. Of the others, those are tried first whose removal would lose least if the area a that
/// each has on the envelope were a cap, which has the height h = a / (2 pi r) and nearly the volume pi r h^2.
Status Renewal::value_leaving(const FrameInput& in) {
  losses_.clear();
  by_estimate_.clear();
  for (std::uint32_t i = 0; i < in.balls.size(); ++i) {
    if (is_lost(i)) {
      push_to(losses_, Valued{0, i}, std::greater<>());
    } else {
      by_estimate_.emplace_back(in.measured.areas[i] * in.measured.areas[i] / in.balls[i].radius, i);
    }
  }
  std::ranges::sort(by_estimate_);
  by_estimate_.resize(std::min(by_estimate_.size(), kLeaving * most_));
  for (const Valued& valued : by_estimate_) {
    const Result<double> loss = union_.loss(slot_of_[valued.second]);
    if (!loss) return loss.error();
    push_to(losses_, Valued{loss.value(), valued.second}, std::greater<>());
  }
  return {};
}

/// The candidate with the greatest gain. An old gain is a bound of the new one but for balls that have left.
Result<Renewal::Valued> Renewal::pop_best() {
  while (true) {
    const std::uint32_t candidate = pop_from(gains_, std::less<>()).second;
    const Result<double> gain = union_.gain(candidates_[candidate].ball);
    if (!gain) return gain.error();
    const Valued valued = {gain.value(), candidate};
    if (gains_.empty() || valued >= gains_.front()) return valued;
    push_to(gains_, valued, std::less<>());
  }
}

/// The ball with the least loss. An old loss is a bound of the new one but for balls that have come.
Result<Renewal::Valued> Renewal::pop_weakest() {
  while (true) {
    const std::uint32_t ball = pop_from(losses_, std::greater<>()).second;
    if (is_lost(ball)) return Valued{0, ball};
    const Result<double> loss = union_.loss(slot_of_[ball]);
    if (!loss) return loss.error();
    const Valued valued = {loss.value(), ball};
    if (losses_.empty() || valued <= losses_.front()) return valued;
    push_to(losses_, valued, std::greater<>());
  }
}

/// False if no further exchange is worth it.
Result<bool> Renewal::add_exchange(const MovingSurface& surface) {
  while (!gains_.empty() && !losses_.empty()) {
    const Result<Valued> best = pop_best();
    if (!best) return best.error();
    const TrackedBall& by = candidates_[best.value().second];
    if (!surface.holds(by.ball)) continue;  // on the other side, where faces cross
    while (!losses_.empty()) {
      const Result<Valued> weakest = pop_weakest();
      if (!weakest) return weakest.error();
      if (!(best.value().first > kWorth * weakest.value().first)) return false;
      if (watched_.can_leave(weakest.value().second)) return make_exchange(surface, weakest.value().second, by);
    }
  }
  return false;
}

/// No exchange if the union does not grow by it.
Result<bool> Renewal::make_exchange(const MovingSurface& surface, std::uint32_t ball, const TrackedBall& by) {
  const double before = union_.volume();
  const Status status = is_lost(ball) ? add(ball, by.ball) : union_.move(slot_of_[ball], by.ball);
  if (!status) return status.error();
  if (!(union_.volume() > kCertain * before)) return false;
  BallExchange exchange = {ball, by, others_.size()};
  note_others(exchange);
  if (Status moved = slide(surface, exchange); !moved) return moved.error();
  watched_.exchange(ball, exchange.by.ball);
  exchanges_.push_back(exchange);
  return true;
}

/// Those of the last change of the union that are not noted yet.
void Renewal::note_others(BallExchange& exchange) {
  const auto number = static_cast<std::uint32_t>(exchanges_.size() + 1);
  for (const std::uint32_t slot : union_.changed()) {
    const std::uint32_t other = ball_at_[slot];
    if (!union_.holds(slot) || other == exchange.ball || noted_in_[other] == number) continue;
    noted_in_[other] = number;
    others_.push_back(other);
  }
  exchange.others = others_.size() - exchange.first_other;
}

/// Steps of the new ball towards more volume, as long as the union grows.
Status Renewal::slide(const MovingSurface& surface, BallExchange& exchange) {
  const std::uint32_t slot = slot_of_[exchange.ball];
  for (int step = 0; step < kSlides; ++step) {
    TrackedBall moved = exchange.by;
    if (step == 0) moved.step = kFirstSlide;
    ascend(surface, union_.exposure(slot), moved);
    if (!surface.holds(moved.ball)) return {};
    const double before = union_.volume();
    if (Status status = union_.move(slot, moved.ball); !status) return status.error();
    if (!(union_.volume() > before)) {
      union_.undo();
      return {};
    }
    exchange.by = moved;
    note_others(exchange);
  }
  return {};
}

}  // namespace medial_vk
