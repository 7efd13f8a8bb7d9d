// Balls that overlap a given one, however far away their centres lie.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "curvature/point_grid.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// Some of a set of balls in one grid for each power of two of their radii, so that no large ball makes the search
/// among small ones wide.
class MeetingBalls {
 public:
  /// Of the balls that are not left out.
  MeetingBalls(std::span<const Ball> balls, const std::vector<std::uint8_t>& is_left_out);

  /// Whether one of them that does not lie in `ball` overlaps it. Those whose centres are within `near` of its centre
  /// count only if they contain it and are larger.
  bool meets_other(const Ball& ball, double near) const;

 private:
  struct Group {
    double greatest;  ///< No radius of the group is above this.
    std::vector<double> radii;
    std::vector<Point> centres;
    PointGrid grid;
  };

  std::deque<Group> groups_;
};

}  // namespace medial_vk
