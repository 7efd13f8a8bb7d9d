// The results of `--check`, condition by condition, for every checker.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace medial_vk {

struct CheckLine {
  std::string condition;  ///< A phrase for readers, e.g. "radius <= exact distance".
  std::uint64_t tested = 0;
  std::uint64_t failed = 0;
  double worst = 0;  ///< Largest violation or smallest margin, depending on `unit`.
  std::string unit;
  std::string first_failure;  ///< "ball 17 at (x, y, z): ..." or empty.
};

struct CheckReport {
  std::vector<CheckLine> lines;

  bool passed() const {
    return std::ranges::all_of(lines, [](const CheckLine& line) { return line.failed == 0; });
  }
};

}  // namespace medial_vk
