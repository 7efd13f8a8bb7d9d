// Medial balls as candidates, by the volume that they would add to a union.
#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "medial_vk/dynamic_union.h"

namespace medial_vk {

/// The gain of a ball never grows while others are added (volume is submodular), so an old gain bounds the new one, and
/// few gains are recomputed for each choice (M. Minoux, "Accelerated greedy algorithms", 1978). If balls of the union
/// have moved meanwhile, old gains are estimates: the choice may then miss the best by the volume that a move has
/// uncovered.
class Candidates {
 public:
  void add(std::span<const Ball> balls);

  struct Choice {
    Ball ball;
    double gain;
  };
  /// The ball with the greatest gain, which is then no candidate any more; no value if none has a gain. Error:
  /// kOutOfMemory.
  Result<std::optional<Choice>> take_best(DynamicUnion& balls);

 private:
  struct Entry {
    double gain;
    std::uint32_t candidate;
    std::uint32_t evaluated;  // the round of the last evaluation
    bool operator<(const Entry& other) const {
      return gain != other.gain ? gain < other.gain : candidate > other.candidate;
    }
  };
  void take_stale(std::vector<Entry>& stale);

  std::vector<Ball> balls_;
  std::priority_queue<Entry> queue_;
  std::uint32_t round_ = 0;
};

}  // namespace medial_vk
