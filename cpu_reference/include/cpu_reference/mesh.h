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
};

}  // namespace medial_vk::reference
