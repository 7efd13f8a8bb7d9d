#include "following/renewal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

#include "base/parallel.h"
#include "following/ascent.h"
#include "following/greatest_ball.h"
#include "following/tangent_rule.h"
#include "following/watched_points.h"
#include "medial_vk/dynamic_union.h"

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

/// The places in decreasing order of their widths.
struct GapPlace {
  Point at = {0, 0, 0};
  double width = 0;
  std::uint32_t triangle = kNowhere;  // of a point of the surface
};

/// The width of a place where no ball may come.
constexpr double kNotHere = -1;

std::vector<GapPlace> widest_first(std::vector<GapPlace> places) {
  std::erase_if(places, [](const GapPlace& place) { return place.width == kNotHere; });
  std::ranges::stable_sort(places, std::greater<>(), &GapPlace::width);
  return places;
}

/// The exchanges of one frame.
class Renewal {
 public:
  Renewal(const MovingSurface& surface, std::span<const Ball> balls, const BallUnion& measured,
          const ExchangeRegions& regions, std::uint32_t most, unsigned threads, DynamicUnion all)
      : surface_(surface),
        balls_(balls),
        measured_(measured),
        regions_(regions),
        most_(most),
        threads_(threads),
        union_(std::move(all)),
        watched_(surface, balls, regions.samples, threads) {}

  Result<std::vector<BallExchange>> run() {
    if (Status status = add_balls(); !status) return status.error();
    find_candidates();
    if (Status status = value_candidates(); !status) return status.error();
    if (Status status = value_leaving(); !status) return status.error();
    std::vector<BallExchange> exchanges;
    while (exchanges.size() < most_) {
      Result<std::optional<BallExchange>> exchange = next_exchange();
      if (!exchange) return exchange.error();
      if (!exchange.value()) break;
      exchanges.push_back(std::move(*exchange.value()));
    }
    return exchanges;
  }

 private:
  using Valued = std::pair<double, std::uint32_t>;  // a volume, and a candidate or a ball

  bool is_lost(std::uint32_t ball) const { return slot_of_[ball] == kNowhere; }

  Status add_balls() {
    slot_of_.assign(balls_.size(), kNowhere);
    ball_at_.assign(balls_.size(), kNowhere);
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
      if (balls_[i].radius > 0) {
        if (Status status = add(i, balls_[i]); !status) return status;
      }
    }
    return {};
  }

  Status add(std::uint32_t i, const Ball& ball) {
    const Result<std::uint32_t> slot = union_.add(ball);
    if (!slot) return slot.error();
    slot_of_[i] = slot.value();
    ball_at_[slot.value()] = i;
    return {};
  }

  bool is_chosen(std::uint32_t triangle) const { return regions_.chosen[regions_.samples.region_of(triangle)] != 0; }

  /// Vertices of the envelope, by their distance from the surface: pockets between balls.
  std::vector<GapPlace> pockets() const {
    std::vector<GapPlace> places(measured_.vertices.size());
    parallel_for(places.size(), 16, threads_, [&](std::size_t i) {
      const Point& at = measured_.vertices[i].at;
      const BvhHit nearest = surface_.closest(at, std::numeric_limits<double>::infinity());
      const double width = is_chosen(nearest.triangle) ? std::sqrt(nearest.squared_distance) : kNotHere;
      places[i] = {at, width, kNowhere};
    });
    return widest_first(std::move(places));
  }

  /// Middles of triangles, by their distance from the balls.
  std::vector<GapPlace> uncovered_points() const {
    std::vector<GapPlace> places;
    places.reserve(watched_.points().size());
    for (const WatchedPoint& point : watched_.points()) {
      if (point.is_middle && is_chosen(point.triangle)) places.push_back({point.at, point.distance, point.triangle});
    }
    return widest_first(std::move(places));
  }

  void find_candidates() {
    grow(pockets(), kAtVertices * most_);
    grow(uncovered_points(), kAtSurface * most_);
  }

  /// The greatest balls at the first `most` places that are not next to one of them.
  void grow(const std::vector<GapPlace>& places, std::size_t most) {
    for (const GapPlace& place : places) {
      if (most == 0) return;
      if (is_next_to_candidate(place)) continue;
      --most;
      const TrackedBall grown =
          place.triangle == kNowhere
              ? greatest_ball_at(surface_, place.at, {}, {})
              : greatest_ball(surface_, {middle_of(place.triangle), surface_.inward_normal(place.triangle)}, {});
      if (grown.ball.radius > 0) candidates_.push_back(grown);
    }
  }

  bool is_next_to_candidate(const GapPlace& place) const {
    const double near = (place.triangle == kNowhere ? 0 : kSameGap) * place.width;
    return std::ranges::any_of(candidates_, [&](const TrackedBall& candidate) {
      return length(place.at - candidate.ball.centre) - candidate.ball.radius < near;
    });
  }

  Status value_candidates() {
    for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
      const Result<double> gain = union_.gain(candidates_[k].ball);
      if (!gain) return gain.error();
      gains_.push({gain.value(), k});
    }
    return {};
  }

  /// Lost balls lose nothing. Of the others, those are tried first whose removal would lose least if the area a that
  /// each has on the envelope were a cap, which has the height h = a / (2 pi r) and nearly the volume pi r h^2.
  Status value_leaving() {
    std::vector<Valued> by_estimate;
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
      if (is_lost(i)) {
        losses_.push({0, i});
      } else {
        by_estimate.emplace_back(measured_.areas[i] * measured_.areas[i] / balls_[i].radius, i);
      }
    }
    std::ranges::sort(by_estimate);
    by_estimate.resize(std::min(by_estimate.size(), kLeaving * most_));
    for (const Valued& valued : by_estimate) {
      const Result<double> loss = union_.loss(slot_of_[valued.second]);
      if (!loss) return loss.error();
      losses_.push({loss.value(), valued.second});
    }
    return {};
  }

  /// The candidate with the greatest gain. An old gain is a bound of the new one but for balls that have left.
  Result<Valued> pop_best() {
    while (true) {
      const std::uint32_t candidate = gains_.top().second;
      gains_.pop();
      const Result<double> gain = union_.gain(candidates_[candidate].ball);
      if (!gain) return gain.error();
      const Valued valued = {gain.value(), candidate};
      if (gains_.empty() || valued >= gains_.top()) return valued;
      gains_.push(valued);
    }
  }

  /// The ball with the least loss. An old loss is a bound of the new one but for balls that have come.
  Result<Valued> pop_weakest() {
    while (true) {
      const std::uint32_t ball = losses_.top().second;
      losses_.pop();
      if (is_lost(ball)) return Valued{0, ball};
      const Result<double> loss = union_.loss(slot_of_[ball]);
      if (!loss) return loss.error();
      const Valued valued = {loss.value(), ball};
      if (losses_.empty() || valued <= losses_.top()) return valued;
      losses_.push(valued);
    }
  }

  /// The next exchange, or none if no further one is worth it.
  Result<std::optional<BallExchange>> next_exchange() {
    while (!gains_.empty() && !losses_.empty()) {
      const Result<Valued> best = pop_best();
      if (!best) return best.error();
      const TrackedBall& by = candidates_[best.value().second];
      if (!surface_.holds(by.ball)) continue;  // on the other side, where faces cross
      while (!losses_.empty()) {
        const Result<Valued> weakest = pop_weakest();
        if (!weakest) return weakest.error();
        if (!(best.value().first > kWorth * weakest.value().first)) return std::optional<BallExchange>();
        if (watched_.can_leave(weakest.value().second)) return make_exchange(weakest.value().second, by);
      }
    }
    return std::optional<BallExchange>();
  }

  /// No exchange if the union does not grow by it.
  Result<std::optional<BallExchange>> make_exchange(std::uint32_t ball, const TrackedBall& by) {
    const double before = union_.volume();
    const Status status = is_lost(ball) ? add(ball, by.ball) : union_.move(slot_of_[ball], by.ball);
    if (!status) return status.error();
    if (!(union_.volume() > kCertain * before)) return std::optional<BallExchange>();
    BallExchange exchange = {ball, by, {}};
    note_others(exchange);
    if (Status moved = slide(exchange); !moved) return moved.error();
    watched_.exchange(ball, exchange.by.ball);
    return std::optional<BallExchange>(std::move(exchange));
  }

  void note_others(BallExchange& exchange) const {
    for (const std::uint32_t slot : union_.changed()) {
      const std::uint32_t other = ball_at_[slot];
      if (union_.holds(slot) && other != exchange.ball) exchange.others.push_back(other);
    }
  }

  /// Steps of the new ball towards more volume, as long as the union grows.
  Status slide(BallExchange& exchange) {
    const std::uint32_t slot = slot_of_[exchange.ball];
    for (int step = 0; step < kSlides; ++step) {
      TrackedBall moved = exchange.by;
      if (step == 0) moved.step = kFirstSlide;
      ascend(surface_, union_.exposure(slot), moved);
      if (!surface_.holds(moved.ball)) return {};
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

  const MovingSurface& surface_;
  const std::span<const Ball> balls_;
  const BallUnion& measured_;
  const ExchangeRegions regions_;
  const std::size_t most_;
  const unsigned threads_;
  DynamicUnion union_;
  WatchedPoints watched_;
  std::vector<std::uint32_t> slot_of_, ball_at_;  // by ball, by slot
  std::vector<TrackedBall> candidates_;
  std::priority_queue<Valued> gains_;
  std::priority_queue<Valued, std::vector<Valued>, std::greater<>> losses_;
};

/// Of the coordinates of balls in the box of the surface.
double largest_coordinate(const MovingSurface& surface, std::span<const Ball> balls) {
  double largest = 0;
  for (const Ball& ball : balls) {
    for (const double x : ball.centre) largest = std::max(largest, std::fabs(x));
  }
  return largest + 2 * surface.longest_side();
}

}  // namespace

Result<std::vector<BallExchange>> find_exchanges(const MovingSurface& surface, std::span<const Ball> balls,
                                                 const BallUnion& measured, const ExchangeRegions& regions,
                                                 std::uint32_t most, unsigned threads) {
  Result<DynamicUnion> all =
      DynamicUnion::build(static_cast<std::uint32_t>(balls.size()), largest_coordinate(surface, balls));
  if (!all) return all.error();
  return Renewal(surface, balls, measured, regions, most, threads, std::move(all).value()).run();
}

}  // namespace medial_vk
