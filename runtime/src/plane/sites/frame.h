// The coordinates in which the library works in the plane: a box of interest within [-1/2, 1/2].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "plane/sites/vec2.h"

namespace medial_vk::plane {

/// The bounding box of points.
struct Box {
  Vec2 lower = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 upper = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(Vec2 x) {
    lower = {std::min(lower.x, x.x), std::min(lower.y, x.y)};
    upper = {std::max(upper.x, x.x), std::max(upper.y, x.y)};
  }
  double longest_side() const { return std::max(upper.x - lower.x, upper.y - lower.y); }
};

inline Box box_of(std::span<const std::array<double, 2>> points) {
  Box box;
  for (const std::array<double, 2>& p : points) box.add({p[0], p[1]});
  return box;
}

/// A power of two as scale, so that scaling does not round.
class Frame {
 public:
  /// The square around the middle of `box` that reaches `margin` beyond its longest side is within [-1/2, 1/2].
  Frame(const Box& box, double margin)
      : centre_{box.lower.x / 2 + box.upper.x / 2, box.lower.y / 2 + box.upper.y / 2},
        scale_(std::exp2(std::ceil(std::log2(std::max(box.longest_side() + 2 * margin, kLeast))))) {}

  Vec2 to_unit(const std::array<double, 2>& p) const {
    return {(p[0] - centre_.x) / scale_, (p[1] - centre_.y) / scale_};
  }
  std::array<double, 2> to_input(Vec2 x) const { return {centre_.x + scale_ * x.x, centre_.y + scale_ * x.y}; }
  /// The nearest coordinates that are the image of input coordinates.
  Vec2 representable(Vec2 x) const { return to_unit(to_input(x)); }
  double scale() const { return scale_; }

 private:
  static constexpr double kLeast = 0x1p-900;
  Vec2 centre_;
  double scale_;
};

}  // namespace medial_vk::plane
