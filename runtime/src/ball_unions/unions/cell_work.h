// A power cell that is built among balls in slots, some of them empty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ball_unions/cells/power_cell.h"
#include "medial_vk/ball.h"

namespace medial_vk {

constexpr Ball kGone = {{0, 0, 0}, std::numeric_limits<double>::quiet_NaN()};  ///< In an empty slot; touches nothing.
bool is_gone(const Ball& ball);

bool touch(const Ball& a, const Ball& b);
/// The offset of the plane between two balls, from the centre of the first towards the other.
double offset_of(const Ball& ball, const Ball& other);

/// Those at [first, end) are in slots.
struct BallsInSlots {
  std::span<const Ball> balls;
  std::uint32_t first, end;
};

/// The cell, and the memory that building it needs. For one thread.
struct CellWork {
  /// Among `balls`, any number of which may be in slots. As long as no more than `usual` of them touch one, cells
  /// allocate nothing. Throws std::bad_alloc.
  CellWork(std::span<const Ball> balls, std::size_t usual);

  static void find_touching(const BallsInSlots& slots, const Ball& ball, std::vector<std::uint32_t>& found);
  /// The cell of ball i among all balls in slots except `without`.
  void build(const BallsInSlots& slots, std::uint32_t i, std::uint32_t without);

  PowerCell cell;
  std::vector<std::uint32_t> near, cutting;
  std::vector<std::pair<double, std::uint32_t>> order;  // offsets of planes, and their balls
};

}  // namespace medial_vk
