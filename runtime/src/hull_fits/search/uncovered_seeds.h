// Medial balls in parts of a solid that no hull covers yet.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/split_mix.h"
#include "medial_vk/ball.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk {

/// Medial points are spread evenly over the sheets, and the part of the solid beside a piece of a sheet is as thick as
/// its balls: drawn with weights of their radii and of the share of a few points in each ball that no hull holds, they
/// are drawn about evenly from the uncovered volume.
class UncoveredSeeds {
 public:
  /// Of at least one ball; some are left out where there are too many.
  explicit UncoveredSeeds(std::span<const Ball> medial);

  /// Takes these balls in the place of the others, none of which has an uncovered point any more, and these hulls.
  void take(std::span<const Ball> balls, std::span<const BallHull> hulls);
  void add(const BallHull& hull) { count(hull, 1); }
  void remove(const BallHull& hull) { count(hull, -1); }
  /// To be called after changes, before draws.
  void update();
  const std::vector<Ball>& balls() const { return balls_; }
  /// A ball at random.
  const Ball& draw(SplitMix& random) const;
  /// False if no point is uncovered.
  bool any() const { return !sums_.empty() && sums_.back() > 0; }

 private:
  static constexpr std::size_t kPoints = 8;  // of a ball

  void count(const BallHull& hull, int change);

  std::vector<Ball> balls_;
  std::vector<Point> points_;
  std::vector<std::int32_t> holders_;  // by point: the number of hulls that hold it
  std::vector<double> sums_;           // of weights, up to each ball
};

}  // namespace medial_vk
