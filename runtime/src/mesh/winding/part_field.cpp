#include "mesh/winding/part_field.h"

#include <unordered_map>

namespace medial_vk {
namespace {

Mesh copy(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  Mesh part;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  for (const std::uint32_t t : triangles) {
    Triangle corners = mesh.triangles[t];
    for (std::uint32_t& v : corners) {
      const auto [known, is_new] = numbers.try_emplace(v, static_cast<std::uint32_t>(part.vertices.size()));
      if (is_new) part.vertices.push_back(mesh.vertices[v]);
      v = known->second;
    }
    part.triangles.push_back(corners);
  }
  return part;
}

}  // namespace

PartField::PartField(const Mesh& mesh, const std::vector<std::uint32_t>& triangles)
    : part_(copy(mesh, triangles)), tree_(part_), winding_(tree_), position_of_(triangles.size()) {
  for (std::uint32_t position = 0; position < tree_.order.size(); ++position)
    position_of_[tree_.order[position]] = position;
}

}  // namespace medial_vk
