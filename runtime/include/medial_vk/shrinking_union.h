// A union of balls from which balls are taken away, measured again only where it changes.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "medial_vk/ball_union.h"

namespace medial_vk {

/// Holds all balls, and which of them are still in. Taking some away changes the power cells of their neighbours only,
/// and those of balls that had been hidden by them; only these are measured again. For volumes of parts (S. Stolpner,
/// 2011, Section 6.3) and for simplification that keeps the topology (Section 6.4.1).
class ShrinkingUnion {
 public:
  /// As measure_ball_union(), whose errors these are. `threads` of 0: one per core; results do not depend on it.
  static Result<ShrinkingUnion> build(std::span<const Ball> balls, unsigned threads = 0);
  ShrinkingUnion(ShrinkingUnion&&) noexcept;
  ShrinkingUnion& operator=(ShrinkingUnion&&) noexcept;
  ~ShrinkingUnion();

  /// Of the union of the balls that are in.
  double volume() const;
  /// Per ball: of the ball in its power cell; 0 for balls that are out. Until the next call that is not const.
  std::span<const double> volumes() const;
  bool holds(std::uint32_t ball) const;
  /// Of the union of the balls that are in. Time: n log n in their number, whatever has changed. Error: kOutOfMemory.
  Result<BettiNumbers> betti() const;

  /// Takes balls away; those that are out already stay out. Time: that of the cells that change, and for balls without
  /// a share each of them against each that goes. Errors: kUsage (names a number that is none of a ball's),
  /// kOutOfMemory; then nothing has changed.
  Status remove(std::span<const std::uint32_t> balls);
  /// Balls that are in and whose power cells the last remove() has changed, ascending; empty after undo(). Until the
  /// next call that is not const.
  std::span<const std::uint32_t> changed() const;
  /// Puts back what the last remove() took. Does nothing if it was undone, or if there was none.
  void undo();

 private:
  class Impl;
  explicit ShrinkingUnion(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
