// What balls must hold to cover a solid: small pieces of its boundary and cells of its inside, each in one ball.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/queries.h"
#include "mesh/solid.h"

namespace medial_vk {

/// Convex hulls of a few points each: a ball holds a piece if it holds its points. Triangles have three.
class CoverPieces {
 public:
  /// About `pieces` pieces of the boundary (no fewer than it has triangles) and cells of a grid inside.
  CoverPieces(const Solid& solid, std::size_t pieces, unsigned threads);

  std::size_t size() const { return first_.size() - 1; }
  std::span<const Point> points(std::uint32_t piece) const {
    return {points_.data() + first_[piece], first_[piece + 1] - first_[piece]};
  }
  Point middle(std::uint32_t piece) const { return {x_[piece], y_[piece], z_[piece]}; }
  /// Of a triangle; of others zero.
  double area(std::uint32_t piece) const { return area_[piece]; }
  /// Of a triangle, of length 1 and outwards; of others, and of triangles without area, zero.
  const Point& normal(std::uint32_t piece) const { return normal_[piece]; }
  /// The least radius around a centre that holds the piece.
  double needed(const Point& centre, std::uint32_t piece) const;
  /// Indices of all pieces whose middles are in the ball, ascending; a ball that holds a piece holds its middle.
  void gather(const Ball& ball, std::vector<std::uint32_t>& found) const;

  void add(std::span<const Point> points);
  /// Cuts these triangles in four; cells stay as they are. Other pieces may change their indices.
  void refine(const std::vector<bool>& which);

 private:
  void add_triangle(const Point& a, const Point& b, const Point& c, double longest, int depth);
  void add_cells(const Solid& solid, unsigned threads);

  std::vector<Point> points_;
  std::vector<std::uint32_t> first_ = {0};
  // Middles by coordinates: most balls are told from most pieces by these.
  std::vector<double> x_, y_, z_;
  std::vector<double> area_;
  std::vector<Point> normal_;
};

}  // namespace medial_vk
