// The directions of the spokes that balls around some centres may have, in two groups (docs/theory.md, "Least wall").
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/point_ops.h"

namespace medial_vk {

/// Above the rounding of products of unit vectors, of the inverse cosine near 0, where it is the square root of that,
/// and of sums of angles.
constexpr double kAngleRounding = 0x1p-24;

/// Between unit vectors, up to that rounding.
inline double angle_between(const Point& a, const Point& b) { return std::acos(std::clamp(dot(a, b), -1.0, 1.0)); }

/// Directions within an angle of a unit vector. An axis of zero: any directions.
struct SpokeCone {
  Point axis = {0, 0, 0};
  double angle = 0;
};

/// What is known of balls with two contacts and an object angle of at least theta.
struct PairsOfContacts {
  bool are_possible = true;  ///< There may be such balls.
  bool are_apart = false;    ///< The half-angle of each cap is less than half the angle between the axes of both.
  double object_angle = 0;   ///< Of the balls whose spokes are each in one cap, at least.
};

/// The cones that contain the spokes of all contacts, or sums of them with weights that are not negative.
class SpokeGroups {
 public:
  /// Groups the cones by their angle with the one of this index.
  PairsOfContacts divide(std::span<const SpokeCone> cones, std::size_t first, double theta);
  /// Of the last call, if pairs are possible: 0 for the group of the first one, 1 for the other one.
  std::size_t group_of(std::size_t cone) const { return groups_[cone]; }
  /// Of a group that is not empty, if spokes are apart.
  const SpokeCone& cap(std::size_t group) const { return caps_[group]; }

 private:
  std::vector<std::size_t> groups_;
  std::array<std::vector<SpokeCone>, 2> members_;
  std::array<SpokeCone, 2> caps_;
};

/// A narrow cap that holds all cones. Where none was found whose half-angle is below `limit`, at most a right angle,
/// the one that is returned is wider, or that of all directions. The first one below `enough` is returned at once.
SpokeCone narrow_cap(std::span<const SpokeCone> cones, double limit, double enough = 0);

}  // namespace medial_vk
