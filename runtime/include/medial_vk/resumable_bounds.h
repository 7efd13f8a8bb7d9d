// Bounds of the distance between two solids within a budget (S. Stolpner, "Medial Spheres for Shape Representation",
// 2011, Section 8.7.2): a search that may be stopped at any time and continued, with the best interval so far.
#pragma once

#include <cstdint>
#include <memory>

#include "medial_vk/proximity.h"

namespace medial_vk {

/// The search of distance_bounds() for one pose, in steps. It takes longer, that of all pairs where many balls are
/// equal, since it looks first at what would raise the lower bound, and it allocates memory. Its bounds are those of
/// the sets to within 1e-11 of their sizes. For one thread at a time; movable.
class ResumableBounds {
 public:
  /// Begins with a straight way down both trees, so that there is an upper bound at once, where both bodies have balls
  /// inside. Precondition: as for distance_bounds(); where a coordinate of the shift is beyond 1e18, or no number, the
  /// search is complete with the bounds 0 and infinity. Error: kOutOfMemory.
  static Result<ResumableBounds> create(const Body& a, const Body& b, const Pose& pose);

  ResumableBounds(ResumableBounds&&) noexcept;
  ResumableBounds& operator=(ResumableBounds&&) noexcept;
  ~ResumableBounds();

  /// Continues for at most so many comparisons, each of up to 64 pairs of balls, or until the search is complete. The
  /// interval afterwards lies within the one before. Error: kOutOfMemory; the bounds remain true, and the search may
  /// not be continued.
  Status run(std::uint64_t most_comparisons);

  /// They hold at any time. All rounding errors are included.
  const DistanceBounds& bounds() const;
  /// No further comparison will change the bounds: each is that of the sets, or it is decided that the solids meet.
  bool is_complete() const;

 private:
  struct Impl;
  explicit ResumableBounds(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
