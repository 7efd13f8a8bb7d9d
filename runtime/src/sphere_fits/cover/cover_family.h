// Covers by any number of balls, such that more balls never give a larger volume.
#pragma once

#include <bit>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "sphere_fits/cover/cover.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// The numbers for which a cover is searched from balls inside: 1, 4, 16, 64, 96, 128, 192, 256 ..., from 64 on the
/// powers of two and the numbers halfway. Covers of numbers in between come from the next one by removal of balls.
constexpr std::size_t cover_top(std::size_t count) {
  std::size_t top = 1;
  while (top < 64 && top < count) top *= 4;
  while (top < count) top = std::has_single_bit(top) ? top / 2 * 3 : top / 3 * 4;
  return top;
}

/// For every top T there are covers of T, T - 1, T - 2 ... balls, one after the other, that depend only on the solid
/// and on T. The answer for n balls is the cover of least volume with no more than n balls among those of the tops up
/// to cover_top(n). For a larger number the candidates include these, so the volume of the answer is never larger. A
/// cover of a top is left out if it has less volume than an earlier cover of this top, which has more balls.
class CoverFamily {
 public:
  /// By top: balls inside, T of them, or fewer for the greatest; more tops may be added later. Keeps references.
  CoverFamily(const Solid& solid, const std::map<std::size_t, std::vector<Ball>>& starts, unsigned threads,
              const SphereProgress& progress)
      : solid_(solid), starts_(starts), threads_(threads), progress_(progress) {}

  struct Answer {
    std::vector<Ball> balls;
    double volume = 0;  ///< Of their union.
  };
  /// All answers are proved. Throw std::bad_alloc, and Stopped at the request of the progress callback.
  Answer of(std::size_t count);
  /// A cover with few balls and at most this volume: its number of balls is at most `count` and above the previous top.
  /// Empty if the cover for `count` balls has a larger volume.
  std::vector<Ball> few(std::size_t count, double volume);

 private:
  Answer certify(const std::vector<Ball>& balls) const;
  Answer best_below(std::size_t top, std::size_t count, const Cover::Report& report, std::optional<Cover>& found) const;
  Cover::Report report(bool shown);

  const Solid& solid_;
  const std::map<std::size_t, std::vector<Ball>>& starts_;
  unsigned threads_;
  const SphereProgress& progress_;
  std::map<std::size_t, Answer> tops_;  // for the number of balls of the top
  std::map<std::size_t, Cover> found_;  // of the last search, by top
  std::mutex mutex_;                    // of progress_, and
  double shown_ = 0;                    // the share of the longest search
};

}  // namespace medial_vk
