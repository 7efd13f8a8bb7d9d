// A union of balls from which balls are removed, remeasured only where it changes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "medial_vk/ball.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/result.h"

namespace medial_vk {

struct ShrinkingUnionOptions {
  unsigned threads = 0;  ///< Of the host, 0: one per core. Results do not depend on it.
};

/// Holds all balls, and marks those that are still in the union. A removal changes only the power cells of the
/// neighbours and of balls that the removed ones had hidden, and only these are remeasured. It serves the removal of
/// sheets by significance (S. Stolpner, 2011, Section 6.3) and without changes of topology (Section 6.4.1).
class ShrinkingUnion {
 public:
  /// Conditions and errors are those of measure_ball_union().
  static Result<ShrinkingUnion> build(std::span<const Ball> balls, const ShrinkingUnionOptions& options = {});
  ShrinkingUnion(ShrinkingUnion&&) noexcept;
  ShrinkingUnion& operator=(ShrinkingUnion&&) noexcept;
  ~ShrinkingUnion();

  /// Of the union of the balls still in it.
  double volume() const;
  /// Per ball: of the ball in its power cell; 0 for removed balls. Valid until the next call that is not const.
  std::span<const double> volumes() const;
  bool holds(std::uint32_t ball) const;
  /// Betti numbers of the union of the balls still in it. Time: n log n in their number, for any change. Error:
  /// kOutOfMemory.
  Result<BettiNumbers> betti() const;

  /// Removes balls; those already removed are ignored. Time: that of the cells that change, plus one test for each pair
  /// of a ball without a share and a removed ball. Errors: kUsage (names an index that is out of range), kOutOfMemory;
  /// after an error nothing has changed.
  Status remove(std::span<const std::uint32_t> balls);
  /// Balls in the union whose power cells the last remove() has changed, ascending; empty after undo(). Valid until the
  /// next call that is not const.
  std::span<const std::uint32_t> changed() const;
  /// Restores the balls of the last remove(). Does nothing if that was undone already, or if there was none.
  void undo();

 private:
  class Impl;
  explicit ShrinkingUnion(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
