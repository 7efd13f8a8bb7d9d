// The reference's own mesh.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace medial_vk::reference {

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;  // counter-clockwise from outside
  std::vector<std::uint8_t> trusted;       // one per triangle: may its outward normal be trusted (Lemma B)? empty: no
  bool closed = false;                     // inside and outside can be decided for whole cells
};

}  // namespace medial_vk::reference
