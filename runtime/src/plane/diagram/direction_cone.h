// Directions of the plane within an angle.
#pragma once

#include "plane/sites/vec2.h"

namespace medial_vk::plane {

/// The least cone that holds some directions, as long as it is narrower than a given angle below pi. No function of an
/// angle is evaluated for a direction.
class DirectionCone {
 public:
  /// The angle by its cosine and its sine, which is positive.
  DirectionCone(double cosine, double sine) : cosine_(cosine), sine_(sine) {}

  /// Adds a direction of any length but 0; false if all of them together take the given angle or more.
  bool add(Vec2 way) {
    if (is_empty_) {
      is_empty_ = false;
      right_ = left_ = way;
      return true;
    }
    const double from_right = cross(right_, way), from_left = cross(left_, way);
    if (from_right > 0 && from_left > 0) return extend(left_, way, is_within(right_, way));
    if (from_right < 0 && from_left < 0) return extend(right_, way, is_within(way, left_));
    if (from_right >= 0 && from_left <= 0 && (from_right > 0 || from_left < 0)) return true;
    // Along one of its directions but for rounding, or opposite to a direction of the cone.
    return dot(right_, way) > 0 && dot(left_, way) > 0;
  }

 private:
  static bool extend(Vec2& border, Vec2 way, bool is_fine) {
    border = way;
    return is_fine;
  }
  /// Of directions less than half a turn apart, `to` to the left.
  bool is_within(Vec2 from, Vec2 to) const {
    const Vec2 limit = {cosine_ * from.x - sine_ * from.y, sine_ * from.x + cosine_ * from.y};
    return cross(to, limit) > 0;
  }

  double cosine_, sine_;
  bool is_empty_ = true;
  Vec2 right_, left_;
};

}  // namespace medial_vk::plane
