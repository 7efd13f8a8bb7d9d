// Places where walls, or gaps, are thinner than demanded.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial_vk/least_wall.h"
#include "medial_vk/thickness.h"

namespace medial_vk {

/// Points of the boundary on both sides of a wall.
struct ThinPlace {
  Bounds least;          ///< Of the point whose interval had the least lower end before it was narrowed.
  Point at = {0, 0, 0};  ///< Its point.
  double area = 0;       ///< Of the boundary; 0: of less than a point's share.
};

/// The thinnest wall, or gap, and how it compares with what is demanded.
struct WallRecord {
  enum class Verdict : std::uint8_t {
    kThickEnough,  ///< Proved.
    kTooThin,      ///< There is a ball that is smaller.
    kUndecided,    ///< No smaller ball was found, but one may exist.
    kMeasured,     ///< Nothing is demanded.
  };

  ThicknessSide side = ThicknessSide::kWalls;
  double demanded = 0;      ///< The least diameter, in mesh units; 0: nothing.
  double object_angle = 0;  ///< Of the balls that count, at least, in radians.
  LeastWall found = {};     ///< Of walls below `demanded`; of all if nothing is.
  Verdict verdict = Verdict::kThickEnough;
  std::vector<ThinPlace> places = {};  ///< If it is too thin: the largest first.
};

/// Walls are too thin if they are thinner than demanded by more than this share, so that those made as thin as that
/// pass.
inline constexpr double kThinShare = 0.01;

/// Groups the points in walls that are proved to be too thin, and not thinner than walls can be: with a ball of at
/// least the object angle, an upper end in the range, and a lower end no more than kThinShare below it. Each point
/// stands for `area_of_point`; those whose balls have centres within three sides of a square of this area are in one
/// place.
std::vector<ThinPlace> group_thin_places(std::span<const Point> points, std::span<const Thickness> at_points,
                                         double area_of_point, const Bounds& range, double object_angle);

}  // namespace medial_vk
