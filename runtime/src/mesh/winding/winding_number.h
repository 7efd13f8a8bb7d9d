// The generalised winding number of a triangle mesh (Jacobson, Kavan, Sorkine-Hornung 2013): the solid angle under
// which a point sees the oriented surface, over 4 pi. 1 inside of a closed mesh, 0 outside, and a smooth transition
// between them where the mesh is open.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh.h"
#include "mesh/crossings/triangle_tree.h"

namespace medial_vk {

/// The solid angle of triangle (a, b, c) seen from p, over 4 pi: positive from behind (van Oosterom, Strackee 1983).
double triangle_winding(const std::array<Point, 3>& triangle, const Point& p);

/// The sum over the whole mesh, term by term.
double exact_winding_number(const Mesh& mesh, const Point& p);

/// The same by a tree (Barill, Dickson, Schmidt, Levin, Jacobson 2018): far groups of triangles are replaced by their
/// expansion around a common point, up to second order in their size over the distance.
class WindingTree {
 public:
  /// The tree must outlive this.
  explicit WindingTree(const TriangleTree& tree);

  /// The error against the sum term by term is at most 0.03 near ordinary meshes, and 0.005 in the mean (measured, and
  /// checked by a unit test). This suffices to round to the integer of a closed mesh.
  double at(const Point& p) const {
    std::uint64_t cost = 0;
    return sum(p, kNoPosition, cost);
  }

  /// At the centroid of the triangle at a position of the tree, without that triangle. The triangle itself adds 1/2
  /// just behind it and -1/2 just in front, so this number gives the values on both sides without a step off the
  /// surface.
  double beside(std::uint32_t position) const {
    std::uint64_t cost = 0;
    return beside(position, cost);
  }
  /// The same at another point of that triangle.
  double beside(std::uint32_t position, const Point& p) const {
    std::uint64_t cost = 0;
    return sum(p, position, cost);
  }
  /// At the centroid; adds the number of triangles evaluated one by one to `cost`: usually hundreds; all of them in a
  /// tangle of large triangles, where no group is far from any point.
  double beside(std::uint32_t position, std::uint64_t& cost) const;

 private:
  static constexpr std::uint32_t kNoPosition = 0xffffffffu;

  /// sum over triangles of area vector n, centroid at c: f(p) = n.(c - p) / (4 pi |c - p|^3), expanded around `centre`.
  struct Expansion {
    Point centre;
    double far_squared;            // from this squared distance on the expansion is sufficiently accurate
    Point area;                    // sum of n
    std::array<double, 9> moment;  // sum of n (x) (c - centre), row by row
    bool is_leaf;
    std::uint32_t first, count, left, right;
  };

  double sum(const Point& p, std::uint32_t without, std::uint64_t& cost) const;

  const TriangleTree& tree_;
  std::vector<Expansion> nodes_;
};

}  // namespace medial_vk
