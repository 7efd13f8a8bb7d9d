// Meshes in the poses of a motion, like the three of Figure 7-4 of the source: an articulated animal, a knot that
// deforms elastically, and an octopus with arms that curl. In no pose do triangles cross.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::bench {

struct Sequence {
  std::string name;
  Mesh rest;
  std::vector<std::vector<Point>> poses;  ///< The vertices of `rest` in each of them.
};

/// Made of bones with skin, whose legs, neck and tail turn at their joints: three moments of a walk.
Sequence horse();
/// A tube around a trefoil knot, in three maps that preserve volumes: a squash, a twist and both.
Sequence knot();
/// A head and eight arms of six bones each, which curl: down, up, and in turn. In the last two poses all of it is
/// stretched or squashed, too, at the same volume.
Sequence octopus();

}  // namespace medial_vk::bench
