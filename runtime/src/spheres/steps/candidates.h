// Medial balls to choose from, by what they would add to a union.
#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "medial_vk/dynamic_union.h"

namespace medial_vk {

/// What a ball adds never grows while others come (volume is submodular), so an old answer bounds the new one, and few
/// balls are asked about anew for each choice (M. Minoux, "Accelerated greedy algorithms", 1978). If balls of the union
/// have moved meanwhile, old answers are estimates: the choice may then miss the best by what a move has uncovered.
class Candidates {
 public:
  void add(std::span<const Ball> balls);

  struct Choice {
    Ball ball;
    double gain;
  };
  /// The ball that adds most, which is no candidate any more; nothing if none adds anything. Error: kOutOfMemory.
  Result<std::optional<Choice>> take_best(DynamicUnion& balls);

 private:
  struct Entry {
    double gain;
    std::uint32_t candidate;
    std::uint32_t asked;  // in the round of that number
    bool operator<(const Entry& other) const {
      return gain != other.gain ? gain < other.gain : candidate > other.candidate;
    }
  };
  std::vector<Ball> balls_;
  std::priority_queue<Entry> queue_;
  std::uint32_t round_ = 0;
};

}  // namespace medial_vk
