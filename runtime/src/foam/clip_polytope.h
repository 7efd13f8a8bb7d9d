// A convex polytope that is cut by half-spaces one after the other and never loses a point of their intersection.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// The points x with dot(normal, x) <= offset. The normal is a unit vector.
struct HalfSpace {
  Point normal;
  double offset = 0;
};

/// Each cut is made `margin` outside the half-space. The stored surface is closed for any rounding, and each of its
/// faces lies strictly outside the half-space that made it; so the intersection of all half-spaces stays in the convex
/// hull of vertices() (docs/foam.md, "Rounding"). The margin must be above 2^-50 of the largest coordinate for each cut
/// that was made; callers take 2^-40.
class ClipPolytope {
 public:
  struct Vertex {
    Point position;
    std::array<std::int32_t, 3> planes;  ///< Names of the three half-spaces that made it.
  };
  /// Name of the walls of the first box; callers use other names for their half-spaces.
  static constexpr std::int32_t kBox = INT32_MIN;

  /// The cube [-half_side, half_side]^3.
  explicit ClipPolytope(double half_side);

  void clip(const HalfSpace& half_space, std::int32_t name, double margin);

  bool empty() const { return vertices_.empty(); }
  const std::vector<Vertex>& vertices() const { return vertices_; }
  /// Largest distance of a vertex from p.
  double reach_from(const Point& p) const;

 private:
  struct Face {
    std::vector<std::uint32_t> corners;  // counter-clockwise from outside
    std::int32_t name;
  };
  class Cut;

  void drop_unused_vertices();

  std::vector<Vertex> vertices_;
  std::vector<Face> faces_;
};

/// Half-spaces whose intersection is the convex hull of the points, up to 1e-9 of `radius`, and never smaller than it:
/// each touches the points. All points lie within `radius` of the origin, which lies well inside their hull; where it
/// does not, the intersection is larger than the hull.
std::vector<HalfSpace> hull_half_spaces(const std::vector<Point>& points, double radius);

}  // namespace medial_vk
