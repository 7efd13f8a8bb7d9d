// A polytope around a point whose faces divide the directions from it (docs/theory.md, "Thickness").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/point_ops.h"
#include "thickness/direction_cell.h"

namespace medial_vk {

/// Begins as a cube around the origin and is cut by planes. At each vertex three faces meet. Whatever the rounding of
/// its vertices, each direction is in the cone over one of the faces, which are polygons with these corners: a cut
/// replaces polygons with corners on one side of a plane through the origin by others on that side, joined to the same
/// edges.
class DirectionPolytope {
 public:
  static constexpr std::uint32_t kCubeFaces = 6;
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::array<std::uint32_t, 3> kPrevious = {2, 0, 1};  // of three places around a vertex

  struct Vertex {
    Point at = {0, 0, 0};
    double length = 0;                             // of `at`; 0: the place is unused
    std::array<std::uint32_t, 3> neighbours = {};  // counterclockwise, seen from outside
    std::array<std::uint8_t, 3> back = {};         // the place of this vertex among the neighbours of each
    std::array<std::uint32_t, 3> faces = {};       // between a neighbour and the next one
    bool is_settled = false;
  };

  void start(const CubeFrame& frame, double half_width);
  /// Cuts off the part beyond a plane, {m: m.normal > offset}, with its farthest vertex. The new face gets this number.
  /// False if there is no such part, or rounding makes it other than a disk: nothing has changed then.
  bool cut(const Point& normal, double offset, std::uint32_t face);

  /// The vertex that is farthest from the origin, of those that are not settled; kNone if there is none.
  std::uint32_t farthest() const;
  void settle(std::uint32_t vertex) { vertices_[vertex].is_settled = true; }

  const std::vector<Vertex>& vertices() const { return vertices_; }

 private:
  /// An edge by one of its ends, and its place among the edges of this end.
  struct Edge {
    std::uint32_t end;
    std::uint32_t place;
  };

  std::uint32_t farthest_along(const Point& normal);
  Edge find_part(std::uint32_t first, double offset);
  bool walk_around(Edge first);
  void replace_part(double offset, std::uint32_t face);
  std::uint32_t take_place();

  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> unused_;
  std::vector<double> heights_;      // by vertex, along the normal
  std::vector<bool> is_cut_;         // by vertex
  std::vector<std::uint32_t> part_;  // vertices that are cut off
  std::vector<Edge> border_;         // edges of these vertices to others, in the order around the part
  std::vector<std::uint32_t> added_;
  std::size_t border_edges_ = 0;
  double longest_ = 0;
};

}  // namespace medial_vk
