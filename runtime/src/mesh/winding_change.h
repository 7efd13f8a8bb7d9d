// How far a winding number that is known at one point holds around it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/mesh.h"
#include "mesh/mesh_topology.h"

namespace medial_vk {

/// The change of the winding number along paths that cross no triangle: by the law of Biot and Savart it depends on the
/// open edges alone (docs/theory.md, "Outside"). On a closed mesh there is none.
class WindingChange {
 public:
  WindingChange(const Mesh& mesh, const MeshTopology& topology);

  /// A radius of at least `least` around `p` within which the change is at most `most`; 0: none is known. Precondition:
  /// `least` is positive.
  double radius(const Point& p, double most, double least) const;
  /// True if the change within `radius` of `p` is known to be at most `most`. Both are positive.
  bool stays_within(const Point& p, double most, double radius) const;

 private:
  struct OpenEdge {
    Point from, to;
    double times;  // it is traversed so much more often in one direction
  };

  /// Neighbouring edges, in their box.
  struct Group {
    std::size_t first, end;
    Point lower, upper;
    double length = 0;  // the sum, each as often as it is open
  };

  void add_group(std::size_t first, std::size_t end);
  static double distance(const Point& p, const OpenEdge& e);
  static double distance(const Point& p, const Group& group);
  double distance_to_edges(const Point& p) const;
  /// A bound of the change within that radius. Near edges count one by one and far ones in groups. The bound is sharp
  /// enough for a comparison with `most`, which decides which edges are near.
  double change_within(const Point& p, double radius, double most) const;

  std::vector<OpenEdge> edges_;
  std::vector<Group> groups_;
  bool too_many_ = false;
};

/// Visits triangles that are connected to `start` and lie within `radius` of `centre`, over edges of two triangles that
/// agree in their orientation. `take(t)`: true if the triangle is wanted, has not been visited before, and no other
/// crosses it.
template <class Take>
void visit_neighbours(const Mesh& mesh, const MeshTopology& topology, std::uint32_t start, const Point& centre,
                      double radius, Take take) {
  const auto is_near = [&](std::uint32_t t) {
    return std::ranges::all_of(mesh.triangles[t],
                               [&](std::uint32_t v) { return length(mesh.vertices[v] - centre) <= radius; });
  };
  std::vector<std::uint32_t> left = {start};
  while (!left.empty()) {
    const std::uint32_t t = left.back();
    left.pop_back();
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t edge = topology.edge_of(t, k);
      const auto beside = topology.triangles_of(edge);
      if (beside.size() != 2) continue;
      const std::uint32_t other = beside[0] == t ? beside[1] : beside[0];
      const auto& ends = topology.ends(edge);
      if (runs_upwards(mesh.triangles[t], ends) == runs_upwards(mesh.triangles[other], ends)) continue;
      if (is_near(other) && take(other)) left.push_back(other);
    }
  }
}

}  // namespace medial_vk
