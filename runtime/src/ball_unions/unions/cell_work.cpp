#include "ball_unions/unions/cell_work.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <functional>

#include "ball_unions/unions/kept_cells.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Which planes may still cut a cell: those that have a corner beyond them. A plane that has none cuts no part of the
/// cell either.
class Corners {
 public:
  explicit Corners(const std::vector<PowerCell::Corner>& corners) : corners_(corners) {
    for (const PowerCell::Corner& corner : corners) {
      for (std::size_t k = 0; k < 3; ++k) {
        lower_[k] = std::min(lower_[k], corner.at[k]);
        upper_[k] = std::max(upper_[k], corner.at[k]);
      }
      slack_ = std::max(slack_, corner.slack);
    }
    for (std::size_t k = 0; k < 3; ++k) farthest_ = std::max({farthest_, -lower_[k], upper_[k]});
  }

  /// False only if PowerCell::clip() would cut nothing. The plane keeps the points x with 2 d . x <= w, where d leads
  /// from one centre to the other. Products and sums are rounded by less than 2^-40 of their terms.
  bool may_be_cut(const Ball& ball, const Ball& other) const {
    const Point d = other.centre - ball.centre;
    const double w = dot(d, d) + (ball.radius - other.radius) * (ball.radius + other.radius);
    const double size = std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]);
    const double least =
        w - 2 * size * slack_ -
        0x1p-40 * (size * (size + farthest_) + ball.radius * ball.radius + other.radius * other.radius);
    double in_box = 0;
    for (std::size_t k = 0; k < 3; ++k) in_box += std::max(d[k] * lower_[k], d[k] * upper_[k]);
    if (2 * in_box < least) return false;
    return std::any_of(corners_.begin(), corners_.end(),
                       [&](const PowerCell::Corner& corner) { return 2 * dot(d, corner.at) >= least; });
  }

 private:
  const std::vector<PowerCell::Corner>& corners_;
  Point lower_ = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, upper_ = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  double slack_ = 0, farthest_ = 0;
};

}  // namespace

bool is_gone(const Ball& ball) { return std::isnan(ball.radius); }

bool touch(const Ball& a, const Ball& b) {
  const double both = a.radius + b.radius;
  const Point between = b.centre - a.centre;
  return dot(between, between) <= both * both * (1 + 16 * DBL_EPSILON);
}

double offset_of(const Ball& ball, const Ball& other) {
  const Point between = other.centre - ball.centre;
  const double squared = dot(between, between);
  if (squared == 0) return -HUGE_VAL;
  return (squared + ball.radius * ball.radius - other.radius * other.radius) / (2 * std::sqrt(squared));
}

CellWork::CellWork(std::span<const Ball> balls, std::size_t usual) : cell(balls) {
  near.reserve(balls.size());
  cutting.reserve(balls.size());
  order.reserve(balls.size());
  cell.make_room(usual, 0);
}

void CellWork::find_touching(const BallsInSlots& slots, const Ball& ball, std::vector<std::uint32_t>& found) {
  found.clear();
  for (std::uint32_t j = slots.first; j < slots.end; ++j) {
    if (touch(ball, slots.balls[j])) found.push_back(j);
  }
}

/// Cut by the nearest planes first: most others are then beyond all corners, and now and then these are left out.
void CellWork::build(const BallsInSlots& slots, std::uint32_t i, std::uint32_t without) {
  constexpr std::size_t kPeriod = 16;
  const std::span<const Ball> balls = slots.balls;
  find_touching(slots, balls[i], cutting);
  order.clear();
  for (const std::uint32_t j : cutting) {
    if (j != i && j != without) order.emplace_back(offset_of(balls[i], balls[j]), j);
  }
  // Few of them are needed: a heap yields these in order, without sorting the others.
  std::make_heap(order.begin(), order.end(), std::greater<>());
  cell.start(i);
  double reach = reach_of(cell.corners());
  for (std::size_t number = 1; !order.empty() && order.front().first <= reach && !cell.empty(); ++number) {
    std::pop_heap(order.begin(), order.end(), std::greater<>());
    const std::uint32_t j = order.back().second;
    order.pop_back();
    if (cell.clip(j)) reach = reach_of(cell.corners());
    if (number % kPeriod != 0 || cell.empty()) continue;
    const Corners corners(cell.corners());
    std::erase_if(order, [&](const auto& each) { return !corners.may_be_cut(balls[i], balls[each.second]); });
    std::make_heap(order.begin(), order.end(), std::greater<>());
  }
  cell.sharpen();
}

}  // namespace medial_vk
