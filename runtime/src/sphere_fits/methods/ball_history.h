// The balls of a set that grows ball by ball, at each of its earlier numbers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"

namespace medial_vk {

/// Remembers which balls moved while each one was added.
class BallHistory {
 public:
  /// To be called for each added ball: the balls in these slots, those that are not new among them, were `before` and
  /// are `now`.
  void add(std::span<const std::uint32_t> slots, std::span<const Ball> before, std::span<const Ball> now) {
    for (std::size_t k = 0; k < slots.size(); ++k) {
      const bool is_same = before[k].centre == now[k].centre && before[k].radius == now[k].radius;
      if (!is_same) moves_.push_back({slots[k], before[k]});
    }
    ends_.push_back(moves_.size());
  }

  /// What the present balls, by slot, were when there were `count`.
  std::vector<Ball> at(std::size_t count, std::vector<Ball> balls) const {
    for (std::size_t moves = moves_.size(); moves > (count > 0 ? ends_[count - 1] : 0); --moves) {
      balls[moves_[moves - 1].slot] = moves_[moves - 1].from;
    }
    balls.resize(count);
    return balls;
  }

 private:
  struct Move {
    std::uint32_t slot;
    Ball from;
  };
  std::vector<Move> moves_;
  std::vector<std::size_t> ends_;  // of the moves, by added ball
};

}  // namespace medial_vk
