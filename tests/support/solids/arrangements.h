// Arrangements of several parts, with gaps and cavities, whose outside has a medial surface.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

struct Arrangement {
  std::string name;
  Mesh (*make)();  ///< Closed, without crossings; in a generic position.
};

/// Ten of them.
const std::vector<Arrangement>& arrangements();

/// `count` regular tetrahedra of this edge, at seeded points of the unit cube, no nearer to each other than 0.15.
Mesh make_points(std::size_t count, double edge);

}  // namespace medial_vk::test
