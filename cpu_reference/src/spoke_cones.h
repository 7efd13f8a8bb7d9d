// Which way spokes can point at the faces, edges and vertices of a mesh (docs/theory.md, lemma D), and the dismissal
// of cells by pairs of such features.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "contacts.h"
#include "cpu_reference/mesh.h"

namespace medial_vk::reference {

/// All directions within `angle` of a unit axis; none if the angle is negative, all if it is pi or more.
struct Cap {
  Eigen::Vector3d axis;
  double angle;
};

struct Aim {
  Eigen::Vector3d base, direction;
  double key;
};

class SpokeCones {
 public:
  SpokeCones(const Mesh& mesh, const Tree& tree);

  /// Spokes to the interior of edge k (from corner k to the next) and to corner k of a trusted triangle.
  const Cap& edge(int triangle, int k) const { return edges_[triangle][k]; }
  const Cap& corner(int triangle, int k) const { return corners_[mesh_triangles_[triangle][k]]; }
  int vertex(int triangle, int k) const { return mesh_triangles_[triangle][k]; }
  std::span<const int> fan(int vertex) const { return fans_[vertex]; }
  double normal_cosine(int vertex) const { return normal_cosines_[vertex]; }
  int neighbour(int triangle, int k) const { return neighbours_[triangle][k]; }

 private:
  std::vector<Eigen::Vector3i> mesh_triangles_;
  std::vector<std::array<Cap, 3>> edges_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<Cap> corners_;
  std::vector<double> normal_cosines_;
  std::vector<std::vector<int>> fans_;
};

/// True if it is proved that no two features can hold the spokes of a point with this object angle in the cube.
bool no_pair_of_features(const Tree& tree, const SpokeCones& cones, const Eigen::Vector3d& centre, double half,
                         const Closest& nearest, std::span<const Contact> contacts, double angle, std::vector<Aim>* aims = nullptr);

}  // namespace medial_vk::reference
