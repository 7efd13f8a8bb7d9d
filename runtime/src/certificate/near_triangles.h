// The triangles near each of many neighbouring balls: the tree is walked once for all balls, and then its leaves and
// their triangles are tested four at a time, in float.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/bvh.h"

namespace medial_vk {

/// A ball, and the leaves of the tree that reach into it.
struct Region {
  Point centre = {0, 0, 0};
  double radius = -1;
  std::vector<std::uint32_t> leaves;
  std::array<std::vector<float>, 6> boxes;  ///< Of the leaves, lower and upper corners: x, y, z; padded.
};

class NearTriangles {
 public:
  /// `bvh` outlives it.
  explicit NearTriangles(const Bvh& bvh);
  /// The same for balls with centres in a box that holds the triangles: farther ones are slow.
  NearTriangles(const Bvh& bvh, const Point& lower, const Point& upper);

  void surround(const Point& centre, double radius, Region& region) const;
  /// As gather_within(), in another order; fast where the ball lies in `region`. All triangles that may reach into
  /// the smaller ball of `inner_radius` come first; their number is returned.
  std::size_t gather(const Region& region, const Point& centre, double radius, double inner_radius,
                     std::vector<std::uint32_t>& positions) const;
  /// As closest_of(); the order of `positions` changes, and `bounds` is scratch memory.
  BvhHit closest_of(const Point& p, std::span<std::uint32_t> positions, std::vector<float>& bounds) const;

 private:
  static constexpr std::size_t kLanes = 4;
  struct Query {
    std::array<float, 3> centre;
    float squared_limit, inner_squared_limit;
  };
  // Bits for four triangles: near the ball, and near the inner one.
  struct Lanes {
    unsigned near, inner;
  };

  std::array<float, 3> rounded(const Point& p) const;
  float squared_limit(double radius) const;
  std::array<float, kLanes> squared_bounds(const std::array<float, 3>& p,
                                           std::span<const std::uint32_t> positions) const;
  unsigned boxes_near(const Query& query, const Region& region, std::size_t first) const;
  Lanes lanes_near(const Query& query, std::size_t position) const;
  void gather_leaf(const Query& query, std::uint32_t leaf, std::size_t& inner_count,
                   std::vector<std::uint32_t>& positions) const;

  const Bvh& bvh_;
  Point origin_ = {0, 0, 0};
  double scale_ = 1;
  std::array<std::vector<float>, 9> corners_;  // by leaf position: x, y, z of the first corner, and so on
};

}  // namespace medial_vk
