// Solids whose boundary is the zero set of a function, with meshes of it: curvatures are known at every point.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::bench {

/// Normal, principal curvatures (the greater one first, positive where convex) and their directions.
struct SmoothPoint {
  Point position, normal;
  std::array<double, 2> kappa;
  std::array<Point, 2> directions;
};

struct SmoothBoundary {
  std::string name;
  std::function<double(const Point&)> height;  ///< 0 on the boundary, negative inside.
  std::function<bool(const Point&)> is_known;  ///< Whether a point of the boundary is away from sharp edges.
  Mesh mesh;

  /// The boundary point near p, along the gradient of `height`, and the curvatures there by differences of `height`
  /// whose errors are below 10^-6 of the curvature.
  SmoothPoint nearest(Point p) const;
  /// Moves every vertex at which is_known() along the surface, by up to `share` of its shortest edge.
  void jitter(double share, std::uint64_t seed);
};

/// triaxial, oblate, pipe, plate, flat torus, tight torus, with about `triangles` triangles; slivers: the flat torus
/// with triangles much longer than wide, jittered; lantern: a Schwarz lantern, a pipe whose rings of vertices
/// alternate. prism: over a triangle of three arcs. capsule, disc: the balls of one radius around a segment, and around
/// a disc.
SmoothBoundary make_boundary(const std::string& name, std::uint32_t triangles);

}  // namespace medial_vk::bench
