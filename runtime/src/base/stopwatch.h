// Wall-clock seconds of one stage after another.
#pragma once

#include <chrono>
#include <utility>

namespace medial_vk {

class Stopwatch {
 public:
  /// Seconds since the last call, or since construction.
  double lap() {
    const Clock::time_point now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace medial_vk
