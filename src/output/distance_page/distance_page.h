// A page that shows distances of solids: a picture, the states of all poses, and a histogram.
#pragma once

#include <span>
#include <string>

#include "medial_vk/proximity.h"

namespace medial_vk {

/// The interval of a pose, from triangles or from balls.
struct PoseInterval {
  double lower = 0, upper = 0;
  Collision collision = Collision::kUndecided;
};

struct DistancePage {
  std::string title;          ///< "Distances of a.obj and b.obj".
  std::string pose = "pose";  ///< What has an interval each; its plural ends in s.
  std::string unit = "units of the mesh";
  std::string picture = "Both solids as glass, with their nearest points";  ///< In words.
  std::span<const PoseInterval> intervals;                                  ///< At least one.
  std::size_t shown = 0;                                                    ///< The pose of the picture.
  bool is_chosen = false;  ///< That pose is one of the user's choice, not that of the least distance.
  std::string png;         ///< The picture.
  bool by_balls = false;   ///< Intervals are those of balls alone.
};

/// One HTML file that works from disk, loads nothing and runs no script.
std::string encode_distance_page(const DistancePage& page);

/// The histogram of the upper ends, as SVG. Poses that are hit, or whose upper end is infinite, are not among them.
std::string encode_distances_svg(const DistancePage& page);

}  // namespace medial_vk
