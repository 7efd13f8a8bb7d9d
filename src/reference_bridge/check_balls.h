// `--check`: tests of the written balls by the CPU reference, in double precision and by the simplest method.
#pragma once

#include <span>
#include <vector>

#include "check_reports/check_report.h"
#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/medial_spheres.h"
#include "medial_vk/mesh.h"

namespace medial_vk {

/// Tests every medial sphere against the guarantees of the file, on the side of the mesh. `epsilon` and `radius` are
/// lengths, with 0 for no threshold of the radius; the object angle is in radians.
CheckReport check_medial_spheres(const IndexedMesh& mesh, const VoxelGrid& grid,
                                 const std::vector<MedialSphere>& spheres, double epsilon, double object_angle,
                                 double radius);

/// Tests that every ball lies inside the solid.
CheckReport check_balls_inside(const PreparedMesh& mesh, std::span<const Ball> balls);
/// Tests that the balls cover the solid or, for an open mesh, its surface.
CheckReport check_balls_cover(const PreparedMesh& mesh, std::span<const Ball> balls);

}  // namespace medial_vk
