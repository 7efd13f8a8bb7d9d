#include "ball_unions/unions/cell_work.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <functional>

#include "ball_unions/unions/kept_cells.h"
#include "base/point_ops.h"

namespace medial_vk {

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

/// Cut by the nearest planes first: most others are then beyond all corners.
void CellWork::build(const BallsInSlots& slots, std::uint32_t i, std::uint32_t without) {
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
  for (auto end = order.end(); end != order.begin() && order.front().first <= reach && !cell.empty(); --end) {
    std::pop_heap(order.begin(), end, std::greater<>());
    if (cell.clip((end - 1)->second)) reach = reach_of(cell.corners());
  }
  cell.sharpen();
}

}  // namespace medial_vk
