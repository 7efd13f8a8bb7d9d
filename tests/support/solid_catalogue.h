// The analytic solids by name, each in a generic position: what recall is measured on, and dismissal tested on.
#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace medial_vk::test {

struct NamedSolid {
  std::string name;
  Mesh (*make)();  ///< Turned, so that no face of it is parallel to a face of a voxel.
  /// Samples to ask for, as a share of those of other solids: the salient medial points of a faceted sphere crowd in
  /// one voxel at its centre, where every query meets all facets.
  double share_of_samples = 1;
};

const std::vector<NamedSolid>& analytic_solids();

}  // namespace medial_vk::test
