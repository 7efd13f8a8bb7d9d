// The analytic solids by name, each in a generic position, on which recall is measured and dismissal is tested.
#pragma once

#include <string>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

struct NamedSolid {
  std::string name;
  Mesh (*make)();  ///< Turned, so that no face of it is parallel to a face of a voxel.
  /// All salient points are next to one point, as in a sphere: samples must climb past corners to reach them.
  bool salient_at_a_point = false;
};

const std::vector<NamedSolid>& analytic_solids();

}  // namespace medial_vk::test
