// The numbers of free, hit and undecided among many intervals.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>

#include "cli/terminal/numbers.h"
#include "output/distance_files/distances_csv.h"

namespace medial_vk::cli {

/// "3 free, 1 hit, 0 undecided".
template <class Interval>
std::string states_text(std::span<const Interval> intervals) {
  std::string text;
  for (const Collision state : {Collision::kFree, Collision::kHit, Collision::kUndecided}) {
    const auto count = std::ranges::count(intervals, state, &Interval::collision);
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", grouped(static_cast<std::uint64_t>(count)), name_of(state));
  }
  return text;
}

}  // namespace medial_vk::cli
