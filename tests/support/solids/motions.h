// Motions of meshes: the vertices of any solid at any time.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk::test {

/// Along the longest side of the box around the rest pose, of length L.
enum class Motion {
  kTwist,   ///< By 60 degrees from end to end.
  kBend,    ///< To an arc of 90 degrees.
  kSquash,  ///< By 20 percent; the volume stays.
  kLimb,    ///< The last third turns by 45 degrees, with a blend over two fifths of L.
  kRipple,  ///< Waves of length L / 10 and height 1.2 percent of L; no part turns inside out.
};
inline constexpr std::array kMotions = {Motion::kTwist, Motion::kBend, Motion::kSquash, Motion::kLimb, Motion::kRipple};

const char* name_of(Motion motion);

/// The vertices at a time from 0, the rest pose, to 1, the full motion.
std::vector<Point> moved_vertices(std::span<const Point> rest, Motion motion, double time);

}  // namespace medial_vk::test
