// How much of balls that may reach out of a solid does.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"

namespace medial_vk::bench {

struct ShareOutside {
  double percent, standard_error;  ///< Of the volume of the solid.
};

/// The volume of the balls outside the solid, by OutsideSamples. Balls reach out of it by at most `protrusion`.
ShareOutside share_outside(const IndexedMesh& mesh, const std::vector<Point>& frame, std::span<const Ball> balls,
                           double protrusion);

}  // namespace medial_vk::bench
