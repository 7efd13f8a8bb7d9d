// A complex of triangles that loses triangles by collapses, which preserve its homotopy type.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial_vk/ball_union.h"

namespace medial_vk {

/// Edges and triangles are identified by their indices in the lists of a dual complex.
class SurfaceComplex {
 public:
  /// Without tetrahedra, and without the triangles of `gone`. The complex must outlive it.
  SurfaceComplex(const DualComplex& complex, std::vector<bool> gone);

  bool has_edge(std::uint32_t edge) const { return !gone_edges_[edge]; }
  bool has_triangle(std::uint32_t triangle) const { return !gone_triangles_[triangle]; }
  const std::array<std::uint32_t, 3>& sides(std::uint32_t triangle) const { return sides_[triangle]; }
  /// The number of triangles at an edge.
  std::uint32_t count(std::uint32_t edge) const { return counts_[edge]; }
  /// The first triangle at an edge, except a given one. Precondition: it exists.
  std::uint32_t triangle_at(std::uint32_t edge, std::uint32_t but_for = 0xffffffffu) const;
  /// Edges of one triangle, ascending.
  std::vector<std::uint32_t> free_edges() const;

  /// Removes an edge with its triangle. Precondition: it has exactly one.
  void collapse(std::uint32_t edge);

 private:
  std::vector<std::array<std::uint32_t, 3>> sides_;
  std::vector<std::size_t> starts_;  // by edge, into triangles_at_
  std::vector<std::uint32_t> triangles_at_;
  std::vector<std::uint32_t> counts_;
  std::vector<bool> gone_edges_, gone_triangles_;
};

}  // namespace medial_vk
