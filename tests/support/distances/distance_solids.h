// Solids for comparisons of distances with the reference: meshes, the reference's meshes, and bodies with balls.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cpu_reference/distance_mesh.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/mesh.h"
#include "medial_vk/proximity.h"

namespace medial_vk::test {

struct DistanceSolid {
  std::string name;
  bool is_degenerate;  ///< Open, with slivers, or with faults of files.
  reference::DistanceMesh reference;
  Body body;
  Point lower, upper;  ///< Of the box around it.
  double size;         ///< The longest side of that.
};

struct BallSets {
  std::vector<Ball> inside, cover;
};
/// Balls inside a solid, and balls that cover it.
using BallMaker = std::function<BallSets(const IndexedMesh& mesh)>;

/// By a grid of `cells` cells along the longest side: a ball inside around the middle of each cell that lies in the
/// solid, up to the surface, and one that covers each cell that the solid comes near. An open mesh has no balls inside.
BallSets grid_balls(const IndexedMesh& mesh, int cells);

/// Throws std::runtime_error if the library refuses the mesh.
DistanceSolid make_distance_solid(std::string name, const Mesh& mesh, bool is_degenerate, const BallMaker& balls);

/// Some fifty of 4 to 600 triangles: of many shapes and sizes, far from their origins, open ones, and mutations.
std::vector<DistanceSolid> generated_distance_solids(const BallMaker& balls);

}  // namespace medial_vk::test
