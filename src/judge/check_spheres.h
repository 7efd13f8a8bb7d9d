// The contract of a set of balls, checked by the CPU reference.
#pragma once

#include <vector>

#include "cpu_reference/certificate.h"
#include "medial_vk/mesh.h"
#include "medial_vk/spheres.h"

namespace medial_vk {

/// Do the balls cover the mesh (contract cover), or lie inside it (the others)?
reference::Certificate check_by_reference(const PreparedMesh& mesh, const std::vector<Ball>& balls,
                                          SphereContract contract);

}  // namespace medial_vk
