#include "ball_unions/triangulation/regular_triangulation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "ball_unions/triangulation/ball_insertion.h"
#include "base/point_ops.h"
#include "threads/worker_pool.h"

namespace medial_vk {
namespace {

constexpr std::size_t kMostPerBall = 24, kMostAnyway = 4096;  // tetrahedra
constexpr std::size_t kCornersOfThread = 4096;                // that are placed at a time

/// The round in which a ball is added: half of all in the last, half of the others in the one before, and so on.
std::size_t round_of(std::uint32_t ball) {
  std::uint64_t bits = (ball + 1) * 0x9e3779b97f4a7c15u;
  bits = (bits ^ bits >> 32) * 0xd6e8feb86659fd93u;
  return static_cast<std::size_t>(std::countr_zero(bits >> 32 | std::uint64_t{1} << 32));
}

}  // namespace

std::optional<RegularTriangulation> RegularTriangulation::build(std::span<const Ball> balls,
                                                                std::span<const std::uint32_t> order,
                                                                unsigned threads) {
  RegularTriangulation made;
  BallInsertion insertion;
  WorkerPool pool(threads);
  if (!made.rebuild(balls, order, insertion, pool)) return std::nullopt;
  return made;
}

bool RegularTriangulation::rebuild(std::span<const Ball> balls, std::span<const std::uint32_t> order,
                                   BallInsertion& insertion, WorkerPool& pool) {
  balls_.clear();
  balls_.reserve(balls.size() + kFarPoints);
  balls_.assign(balls.begin(), balls.end());
  add_far_points();
  const auto far = static_cast<std::uint32_t>(balls.size());
  insertion.start(balls_, {far, far + 1, far + 2, far + 3});
  const std::size_t most = most_tetrahedra(balls.size());
  sort_into_rounds(order);
  for (const std::uint32_t ball : rounds_) {
    insertion.insert(ball);
    if (insertion.size() > most) return false;
  }
  insertion.take(tetrahedra_);
  list_stars();
  place_corners(pool);
  return true;
}

// One more ball adds at most twice as many as there are balls: names never run out.
std::size_t RegularTriangulation::most_tetrahedra(std::size_t balls) {
  const std::size_t most = std::min<std::size_t>(kMostPerBall * balls + kMostAnyway, 1u << 31);
  return balls < kMostAnyway ? std::min(most, (balls + 5) * (balls + 2) / 2 - 4) : most;
}

void RegularTriangulation::make_room(std::size_t balls, unsigned threads) {
  const std::size_t all = balls + kFarPoints, most = most_tetrahedra(balls);
  balls_.reserve(all);
  rounds_.reserve(balls);
  counts_.reserve(all);
  first_.reserve(all + 1);
  tetrahedra_.reserve(most);
  corners_.reserve(most);
  positions_.reserve(most);
  around_.reserve(4 * most);
  while (exact_.size() < threads) exact_.push_back(std::make_unique<ExactCorners>());
  for (const auto& exact : exact_) exact->side.make_room();
}

/// Random rounds, each half as large as the next, with neighbours after each other in each: few tetrahedra are created
/// in vain, and the next position is never far (N. Amenta, S. Choi, G. Rote, "Incremental Constructions con BRIO",
/// 2003).
void RegularTriangulation::sort_into_rounds(std::span<const std::uint32_t> order) {
  std::array<std::size_t, 34> begin{};  // of each round, the one of the highest number first
  const auto place = [](std::uint32_t ball) { return 32 - round_of(ball); };
  for (const std::uint32_t ball : order) ++begin[place(ball) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  rounds_.resize(order.size());
  for (const std::uint32_t ball : order) rounds_[begin[place(ball)]++] = ball;
}

/// Four corners of a cube around the middle, 16 times as large as a cube around all balls: the tetrahedron between them
/// holds a ball of 9 times that size.
void RegularTriangulation::add_far_points() {
  Point low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const Ball& ball : balls_) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], ball.centre[k] - ball.radius);
      high[k] = std::max(high[k], ball.centre[k] + ball.radius);
    }
  }
  if (balls_.empty()) low = high = {};
  const Point middle = 0.5 * (low + high), sides = high - low;
  // Large enough that the rounding of the middle, 2^-53, and of radii next to it does not matter.
  const double far = 16 * std::max(0.5 * std::ranges::max(sides), 0x1p-40);
  for (const Point& sign : {Point{-1, -1, -1}, Point{1, 1, -1}, Point{-1, 1, 1}, Point{1, -1, 1}}) {
    balls_.push_back({middle + far * sign, 0});
  }
}

void RegularTriangulation::list_stars() {
  first_.assign(balls_.size() + 1, 0);
  for (const Tetrahedron& t : tetrahedra_) {
    for (const std::uint32_t ball : t.balls) ++first_[ball + 1];
  }
  for (std::size_t i = 0; i < balls_.size(); ++i) first_[i + 1] += first_[i];
  around_.resize(first_.back());
  positions_.resize(tetrahedra_.size());
  counts_.assign(balls_.size(), 0);
  for (std::uint32_t t = 0; t < tetrahedra_.size(); ++t) {
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t ball = tetrahedra_[t].balls[k];
      positions_[t][k] = counts_[ball]++;
      around_[first_[ball] + positions_[t][k]] = t;
    }
  }
}

// Computed once here, not in each of the four cells.
void RegularTriangulation::place_corners(WorkerPool& pool) {
  corners_.resize(tetrahedra_.size());
  while (exact_.size() < pool.threads()) exact_.push_back(std::make_unique<ExactCorners>());
  for (const auto& exact : exact_) exact->side.use(balls_);
  pool.run(tetrahedra_.size(), kCornersOfThread,
           [&](std::size_t t, unsigned worker) { corners_[t] = place_corner(tetrahedra_[t], exact_[worker]->side); });
  share_room(exact_, [](ExactCorners& one, const ExactCorners& of) { one.side.make_room_of(of.side); });
}

RegularTriangulation::Corner RegularTriangulation::place_corner(const Tetrahedron& t, ExactSide& exact) const {
  const auto& [i, p, q, s] = t.balls;
  const auto [at, slack] = meeting_point(bisector(balls_, i, p), bisector(balls_, i, q), bisector(balls_, i, s));
  // Each cell tests whether it is in its box (PowerCell::sharpen).
  const double distance = length(at), radius = balls_[i].radius;
  const bool may_be_in_box = distance <= 2 * radius + slack;
  double smallest = HUGE_VAL;  // of those that have a part of the union
  for (const std::uint32_t ball : t.balls) {
    if (balls_[ball].radius > 0) smallest = std::min(smallest, balls_[ball].radius);
  }
  const bool is_good = slack <= (may_be_in_box ? kSharpCorner * smallest : kRoughCorner * std::max(radius, distance));
  if (is_good) return {at, slack};
  const auto [exact_at, exact_slack] =
      exact.meet(i, static_cast<std::int32_t>(p), static_cast<std::int32_t>(q), static_cast<std::int32_t>(s));
  return {exact_at, exact_slack};
}

}  // namespace medial_vk
