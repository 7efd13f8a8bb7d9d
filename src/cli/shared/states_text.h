// The numbers of free, hit and undecided among many intervals, and an interval in words.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
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

/// "0.5 to 0.75", or what is proved where a limit has ended the search: "at least 0.5", and with a limit of 0
/// "above 0".
inline std::string interval_text(double lower, double upper) {
  if (upper == 0) return "0";
  if (lower > 0 && lower <= std::numeric_limits<double>::min()) return "above 0";
  if (lower > 0 && std::isinf(upper)) return std::isinf(lower) ? "infinite" : fmt::format("at least {:.9g}", lower);
  return fmt::format("{:.9g} to {:.9g}", lower, upper);
}

}  // namespace medial_vk::cli
