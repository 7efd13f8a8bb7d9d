// The mesh type of the reference.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace medial_vk::reference {

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;  // counter-clockwise from outside
  std::vector<std::uint8_t> trusted;       // one per triangle: its outward normal may be trusted (Lemma B); empty: no
  bool closed = false;                     // inside and outside are defined for whole cells
  bool unbounded = false;                  // the solid is all of space but what the mesh encloses: its outside
  double room = 0;  // the box of the search reaches this far beyond the triangles, and at its lower corner further
};

/// The outside of a mesh as a solid, with its triangles turned over, within a box.
Mesh turned_over(Mesh mesh, double room);

}  // namespace medial_vk::reference
