// Covers by any number of balls, of which more are never worse.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "spheres/cover/cover.h"
#include "spheres/measures/threads.h"

namespace medial_vk {

/// The numbers for which a cover is searched from balls inside: 1, 4, 16, 64 and the powers of two beyond. Those
/// between take balls away from the next.
constexpr std::size_t cover_top(std::size_t count) {
  std::size_t top = 1;
  while (top < count) top *= top < 64 ? 4 : 2;
  return top;
}

/// For every top T there are covers of T, T - 1, T - 2 ... balls, one after the other, that depend on the solid and on
/// T only; one that is smaller than that before it, which has more balls, is left out. The answer for n balls is the
/// smallest cover of no more than n that any of the tops up to cover_top(n) has. For a larger number there are these
/// and others, so it is never larger.
class CoverFamily {
 public:
  /// By top: balls inside, T of them, or fewer for the greatest; more may come later. Keeps references.
  CoverFamily(const Solid& solid, const std::map<std::size_t, std::vector<Ball>>& starts, unsigned threads,
              const SphereProgress& progress)
      : solid_(solid), starts_(starts), threads_(threads), progress_(progress) {}

  struct Answer {
    std::vector<Ball> balls;
    double volume = 0;  ///< Of their union.
  };
  /// All are proved. Throw std::bad_alloc, and Stopped where progress says stop.
  Answer of(std::size_t count);
  /// Of no more balls than `count`, but more than the top before: with few balls, of no more than this volume; none if
  /// that for `count` is larger.
  std::vector<Ball> few(std::size_t count, double volume);

 private:
  Answer certify(const std::vector<Ball>& balls) const;
  Answer best_below(std::size_t top, std::size_t count, const Cover::Report& report, std::optional<Cover>& found) const;
  Cover::Report report(bool shown);

  const Solid& solid_;
  const std::map<std::size_t, std::vector<Ball>>& starts_;
  unsigned threads_;
  const SphereProgress& progress_;
  std::map<std::size_t, Answer> tops_;  // for as many balls as the top has
  std::map<std::size_t, Cover> found_;  // of the last search, by top
  std::mutex mutex_;                    // of progress_, and
  double shown_ = 0;                    // the share of the search that takes longest
};

}  // namespace medial_vk
