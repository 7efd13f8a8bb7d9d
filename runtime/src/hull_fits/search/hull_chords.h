// Chords of a hull of balls with lines along an axis of coordinates.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "medial_vk/ball_hull.h"

namespace medial_vk {

/// From `begin` to `end`, none if they are in the other order.
struct Chord {
  double begin, end;
  bool is_empty() const { return !(begin < end); }
};

/// A hull is convex, and its surface consists of parts of spheres, of cones that touch two of them, and of two
/// triangles that touch all three, all of which lie in the hull: a chord begins and ends at the outermost of their
/// points on the line.
class HullChords {
 public:
  /// Lines along coordinate `axis`, 0 to 2, given by the other two, in cyclic order.
  HullChords(const BallHull& hull, std::size_t axis);

  /// The first coordinates of lines with the second coordinate `v` that meet the hull.
  Chord row(double v) const;
  /// The least and greatest second coordinate of lines that meet the hull.
  Chord rows() const { return rows_; }
  Chord at(double u, double v) const;

 private:
  struct Sphere {
    double u, v, z, squared_radius, radius;
  };
  /// The cone that touches the spheres `from` and its next, and the circles where it does.
  struct Cone {
    std::uint32_t from;
    std::array<double, 3> direction;  // of unit length: u, v, z
    double slope, squared_cosine, extent, radius;
    double quadratic;                                  // the coefficient of z^2 on any line
    std::array<std::array<double, 4>, 2> silhouettes;  // u, v of both ends
  };
  /// A triangle that touches all three spheres.
  struct Face {
    double u, v, z;                       // of its first corner
    double b_u, b_v, c_u, c_v, z_b, z_c;  // weights of the others by offsets, and what they add
  };

  void add_cone(const BallHull& hull, std::uint32_t from, std::uint32_t to);
  void add_faces(const BallHull& hull);

  std::array<std::size_t, 3> order_;  // coordinates u, v, z
  std::array<Sphere, 3> spheres_;
  std::array<Cone, 3> cones_;
  std::array<Face, 2> faces_;
  std::uint32_t sphere_count_ = 0, cone_count_ = 0, face_count_ = 0;
  Chord rows_;
};

}  // namespace medial_vk
