// The directions of spokes at the faces, edges and vertices of a mesh (docs/theory.md, Lemmas D and I).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cpu_reference/mesh.h"
#include "cpu_reference/queries.h"

namespace medial_vk::reference {

/// The unit vectors within `angle` of a unit axis.
struct Cap {
  Eigen::Vector3d axis;
  double angle;         // below pi/2, or pi: all directions
  double cosine, sine;  // of the angle

  static Cap around(const Eigen::Vector3d& axis, double angle);
  static Cap all();
  bool holds_all() const { return cosine <= 0; }
};

/// Unit vectors across an edge, within `angle` of the one in the middle.
struct Arc {
  Eigen::Vector3d along;   // unit, of the edge
  Eigen::Vector3d middle;  // unit, across it
  double angle;            // at most pi/2
};

/// A small cap that holds these unit vectors; all directions if none below pi/2 is found.
Cap cap_around(std::span<const Eigen::Vector3d> directions);

/// Half-angle that is added to caps made from normals: those of trusted triangles are right to 5e-10 (spoke_cones.cpp).
inline constexpr double kNormalSlack = 1e-9;
/// Edges and vertices whose spokes are in a cap as narrow as this are flat: they count as a part of their faces, whose
/// spokes are within twice that of the normal.
inline constexpr double kFlatAngle = 5e-8;
inline constexpr double kFaceAngle = 2 * kFlatAngle;

class SpokeCones {
 public:
  SpokeCones(const Mesh& mesh, const Tree& tree);

  /// The flags of the mesh, without triangles whose normal is lost in rounding and triangles at open edges.
  const std::vector<std::uint8_t>& trusted() const { return trusted_; }

  /// Spokes from inside to the interior of edge k (from corner k to the next) and to corner k of a triangle. Null if
  /// there are none, if the feature is flat, if an untrusted triangle holds it, or if it is listed with a triangle of
  /// smaller index.
  const Cap* edge(int triangle, int k) const { return cap(edges_[triangle][k]); }
  const Cap* vertex(int triangle, int k) const { return cap(vertices_[triangle][k]); }

  /// For an untrusted triangle: true if its normal is known nevertheless. If not, it is a carrier as a whole.
  bool has_sides(int triangle) const { return has_sides_[triangle] != 0; }

  /// The vertices of a triangle.
  const std::array<int, 3>& corners(int triangle) const { return corners_[triangle]; }

  /// The spokes to an edge or a corner that an untrusted triangle holds, from either side. Null as above, and if a
  /// triangle without a known normal holds it.
  const Arc* arc(int triangle, int k) const {
    return arcs_of_[triangle][k] < 0 ? nullptr : &arcs_[arcs_of_[triangle][k]];
  }
  const Cap* cone(int triangle, int k) const { return cap(cones_[triangle][k]); }

  /// The triangle on the other side of edge k; -1 if there is none.
  int neighbour(int triangle, int k) const { return neighbours_[triangle][k]; }

 private:
  const Cap* cap(int index) const { return index < 0 ? nullptr : &caps_[index]; }
  int add(const Cap& cap);
  void find_neighbours(const Mesh& mesh);
  void distrust(const Mesh& mesh, const Tree& tree);
  void measure_turns(const Tree& tree);
  void add_edges(const Tree& tree);
  void add_vertices(const Mesh& mesh, const Tree& tree);
  void add_arcs(const Mesh& mesh, const Tree& tree);
  void add_cones(const Mesh& mesh);

  std::vector<std::uint8_t> trusted_, has_sides_;
  std::vector<std::array<int, 3>> neighbours_;
  std::vector<std::array<double, 3>> turns_;  // sine of the turn of normals across an edge; positive: convex
  std::vector<Cap> caps_;
  std::vector<std::array<int, 3>> corners_;
  std::vector<Arc> arcs_;
  std::vector<std::array<int, 3>> edges_, vertices_, cones_;  // indices of caps_, -1: none
  std::vector<std::array<int, 3>> arcs_of_;                   // of arcs_
};

}  // namespace medial_vk::reference
