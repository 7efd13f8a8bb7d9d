// `--check`: the CPU reference's answer about balls as they were written, in double precision and in the plainest way.
#pragma once

#include <span>
#include <vector>

#include "checks/check_report.h"
#include "medial_vk/ball.h"
#include "medial_vk/extraction.h"
#include "medial_vk/mesh.h"

namespace medial_vk {

/// Every medial sphere against what the file promises. `epsilon` and `radius` are lengths, 0: no threshold of the
/// radius; the object angle is in radians.
CheckReport check_medial_spheres(const PreparedMesh& mesh, const VoxelGrid& grid,
                                 const std::vector<MedialSphere>& spheres, double epsilon, double object_angle,
                                 double radius);

/// Does every ball lie inside the solid?
CheckReport check_balls_inside(const PreparedMesh& mesh, std::span<const Ball> balls);
/// Do the balls cover the solid; of an open mesh, its surface?
CheckReport check_balls_cover(const PreparedMesh& mesh, std::span<const Ball> balls);

}  // namespace medial_vk
