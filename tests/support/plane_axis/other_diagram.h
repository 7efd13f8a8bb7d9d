// Voronoi diagrams of points and segments by others, and medial axes compared with them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "medial_vk/plane_axis.h"

namespace medial_vk::test {

/// Of the points and segments of a shape, on both sides of its boundary.
struct OtherDiagram {
  struct Vertex {
    PlanePoint point = {};
    std::vector<PlaneContact> contacts;  ///< At least three.
  };
  /// Points at equal distance from two contacts, between two vertices.
  struct Edge {
    std::array<std::uint32_t, 2> vertices = {};
    std::array<PlaneContact, 2> contacts = {};
  };
  std::vector<Vertex> vertices;
  std::vector<Edge> edges;
};

/// Boost.Polygon's diagram of a shape with integral coordinates; none where Boost is not installed.
std::optional<OtherDiagram> boost_diagram(const PreparedShape& integral);

struct ComparisonCounts {
  std::uint64_t shapes = 0, segments = 0;
  std::uint64_t vertices = 0, edges = 0;  ///< Of the other diagram, inside and salient.
  std::uint64_t nodes = 0, arcs = 0;      ///< Of ours.
  std::uint64_t slides = 0;               ///< Vertices and nodes whose place along the axis is left to rounding.
  std::uint64_t missed_vertices = 0, missed_edges = 0, missed_nodes = 0, unknown_nodes = 0, wrong_arcs = 0;
  std::uint64_t other_is_wrong = 0;  ///< Vertices of the other diagram that something is nearer to.
  double farthest = 0;               ///< Of a vertex or edge from the axis, over the longest side.

  std::uint64_t disagreements() const {
    return missed_vertices + missed_edges + missed_nodes + unknown_nodes + wrong_arcs;
  }
  void add(const ComparisonCounts& other);
};

/// Compares the axis of `shape` inside, with an object angle of at least `object_angle`, with a diagram of the same
/// shape whose coordinates are to be multiplied by `scale`. A description of each disagreement is appended to `words`.
ComparisonCounts compare(const PreparedShape& shape, const OtherDiagram& other, double scale, double object_angle,
                         std::vector<std::string>& words);

}  // namespace medial_vk::test
