// A flattened torus that bends and ripples: the mesh of the example.
#pragma once

#include <medial_vk/mesh_view.h>

#include <cstdint>
#include <vector>

class DeformingTorus {
 public:
  DeformingTorus(std::uint32_t around, std::uint32_t along);

  /// Moves the vertices to their positions at `phase`, 0 to 1 for a whole period.
  void deform(double phase);

  medial_vk::MeshView view() const { return {vertices_, triangles_, flags_, true}; }
  std::size_t vertex_count() const { return vertices_.size(); }
  std::size_t index_count() const { return 3 * triangles_.size(); }

  /// Position and normal of every vertex, six floats.
  void write_vertices(float* to) const;
  void write_indices(std::uint32_t* to) const;

 private:
  std::uint32_t around_, along_;
  std::vector<medial_vk::Point> vertices_;
  std::vector<medial_vk::Triangle> triangles_;
  std::vector<std::uint8_t> flags_;
};
