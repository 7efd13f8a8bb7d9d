// Sets of hulls of all numbers, such that larger ones never cover less.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hull_fits/search/hull_search.h"

namespace medial_vk {

/// One search that grows, and is improved at fixed numbers of hulls, the tops 1, 2, 4, 8, 16, 24, 32, 48, 64, 96 ... A
/// set of n hulls is the better of two: the first n of the next top, in the order of their gains, and the hulls of the
/// top before with those that the search added until there were n. Both grow with n, and the hulls of a top are at
/// least as good as those that have grown to its number, so the volume never falls, as estimated by the lines of the
/// search. At 16 hulls, a second search that was not improved before contends with the first, and the better one goes
/// on: hulls that were improved as few leave less room for many.
class HullFamily {
 public:
  /// Keeps references to the solid and the medial balls.
  HullFamily(const Solid& solid, std::span<const Ball> medial, const SoughtHulls& shape, const HullSearchEffort& effort,
             const Threads& threads);

  /// At most `count` hulls, at least 1; fewer where the search finds no more. The first hulls add most. `progress` gets
  /// the finished share of what the call searches for.
  std::vector<BallHull> set_of(std::size_t count, const std::function<void(double)>& progress = {});
  /// The least top that is at least `count`.
  static std::size_t top_for(std::size_t count);

 private:
  struct Top {
    std::size_t count;
    std::vector<BallHull> before;   // the hulls of the last top, improved, and those added, as they were added
    std::vector<BallHull> ordered;  // improved, by their gains
    std::vector<double> covered_before, covered;  // volumes of the first 1, 2 ... of both
  };

  void search_up_to(std::size_t count, const std::function<void(double)>& progress);
  void note_growth(Top& top) const;
  void improve(HullSearch& search) const;
  void contend(std::size_t count);

  const Solid& solid_;
  std::span<const Ball> medial_;
  SoughtHulls shape_;
  HullSearchEffort effort_;
  Threads threads_;
  std::unique_ptr<HullSearch> search_;
  std::vector<Top> tops_;
  bool has_ended_ = false;
};

}  // namespace medial_vk
