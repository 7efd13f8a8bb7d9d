// The winding numbers of some triangles of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/crossings/triangle_tree.h"
#include "mesh/winding/winding_number.h"

namespace medial_vk {

/// A triangle of the part is named by its index in the list from which the part was made.
class PartField {
 public:
  PartField(const Mesh& mesh, const std::vector<std::uint32_t>& triangles);
  PartField(const PartField&) = delete;  // winding_ refers to tree_
  PartField& operator=(const PartField&) = delete;

  double at(const Point& p) const { return winding_.at(p); }
  /// Beside a point of this triangle of the part, without that triangle.
  double beside(std::uint32_t number, const Point& p) const { return winding_.beside(position_of_[number], p); }
  /// Beside its centroid.
  double beside(std::uint32_t number) const { return winding_.beside(position_of_[number]); }

 private:
  Mesh part_;
  TriangleTree tree_;
  WindingTree winding_;
  std::vector<std::uint32_t> position_of_;
};

}  // namespace medial_vk
