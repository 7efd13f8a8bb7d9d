// On which side of the surface balls lie that do not meet it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// Two open balls that hold no point of a closed surface and overlap lie on the same side, since the winding number is
/// constant in their union. So one ray decides for each component of the union that is known to hang together.
class BallSides {
 public:
  /// Of balls in the rest pose: those whose parts of the union meet are expected to overlap later, too. Errors:
  /// kOutOfMemory, kUsage (as measure_ball_union()).
  static Result<BallSides> build(std::span<const Ball> rest, unsigned threads);

  /// So that renew() allocates nothing, as long as all balls together have no more than 64 others each. Throws
  /// std::bad_alloc.
  void make_room() { edges_.reserve(std::max(kUsualOthers * largest_.size(), 2 * rest_edges_.size())); }
  /// From now on this ball is expected to overlap these others, and no longer those before.
  void renew(std::uint32_t ball, std::span<const std::uint32_t> others);
  /// Expects what build() found.
  void return_to_rest() { edges_ = rest_edges_; }

  /// Replaces `is_inside`, one element per ball: 1 if it is known to lie inside, 0 otherwise and for a radius of 0. The
  /// surface does not meet any ball.
  void find(const MovingSurface& surface, std::span<const Ball> balls, std::span<std::uint8_t> is_inside);
  /// The number of points whose side the last find() determined.
  std::size_t queries() const { return queries_; }

 private:
  static constexpr std::size_t kUsualOthers = 64;
  void connect(std::span<const Ball> balls);

  std::vector<std::array<std::uint32_t, 2>> edges_, rest_edges_;
  DisjointSets components_;
  std::vector<std::uint32_t> largest_;  // by component: its largest ball
  std::vector<std::uint8_t> sides_;     // by component
  std::size_t queries_ = 0;
};

}  // namespace medial_vk
