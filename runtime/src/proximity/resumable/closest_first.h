// The closest two balls of two placed sets, by a search that may be stopped at any time.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/proximity.h"
#include "proximity/placed/placed_balls.h"

namespace medial_vk {

/// Compares the two nodes with the least separation first. Separations are in double, and have errors.
class ClosestFirst {
 public:
  ClosestFirst(PlacedBalls a, PlacedBalls b);

  /// Straight down to two balls.
  void dive();
  /// Compares two nodes. Precondition: the search is not complete.
  void step();

  bool is_complete() const;
  /// No two balls of the sets have a lesser computed separation. It never decreases.
  double lower() const { return lower_; }
  /// The least computed separation of two balls so far, and these; infinite: there are none yet.
  double closest() const { return closest_; }
  const BallPair& balls() const { return balls_; }

 private:
  struct Task {
    double separation;
    std::uint32_t a, b;
  };

  void compare(const Task& task);
  void take(std::uint32_t a, std::uint32_t b);
  void push(const Task& task);

  PlacedBalls a_, b_;
  std::vector<Task> heap_;  // the least separation first
  double lower_, closest_;
  BallPair balls_;
};

}  // namespace medial_vk
