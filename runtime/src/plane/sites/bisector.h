// The points at equal distance from two sites: a line or a parabola (docs/theory.md, "In the plane").
#pragma once

#include <array>
#include <compare>
#include <optional>

#include "plane/sites/site_set.h"

namespace medial_vk::plane {

/// A site, and for a segment the side on which distances from it are measured.
struct Contact {
  std::uint32_t site = 0;
  Side side = Side::kLeft;  ///< Of a point always left.

  auto operator<=>(const Contact&) const = default;  // NOLINT(modernize-use-nullptr): false alarm of clang-tidy 14
};

/// A curve with the parameter t, which is the distance from its apex along a straight line.
class Bisector {
 public:
  enum class Kind : std::uint8_t { kOfPoints, kMixed, kOfSegments };

  Kind kind() const { return kind_; }
  Vec2 at(double t) const;
  double radius_at(double t) const;
  /// Half the angle between the directions to both sites.
  double object_angle_at(double t) const;
  /// Of the point of the curve that is nearest to x, to first order for points near it.
  double parameter_of(Vec2 x) const { return dot(along_, x - origin_); }
  /// The object angle is at least `angle` where |t| is at most this; negative: nowhere.
  double reach(double angle) const;
  /// Whether it is so anywhere.
  bool has_angle(double angle) const { return kind_ != Kind::kOfSegments || angle_ >= angle; }
  /// The parameters at which the curve crosses the line `normal` x = `value`, up to two.
  struct Crossings {
    std::array<double, 2> t = {};
    int count = 0;
  };
  Crossings with_line(Vec2 normal, double value) const;
  /// The parameters at which the radius is this.
  Crossings with_radius(double radius) const;
  Vec2 origin() const { return origin_; }
  Vec2 along() const { return along_; }
  /// From the segment to the point.
  Vec2 up() const { return turns_left_ ? left_of(along_) : -left_of(along_); }
  /// Half the distance of two points; the distance of a point from a line; 0 for two segments.
  double focus() const { return focus_; }
  /// Of two segments: the change of the radius.
  double slope() const { return slope_; }

 private:
  friend std::optional<Bisector> bisector_of(const SiteSet& sites, Contact a, Contact b);
  double rise(double t) const { return (t * t + focus_ * focus_) / (2 * focus_); }

  Kind kind_ = Kind::kOfPoints;
  bool turns_left_ = true;
  Vec2 origin_, along_;
  double focus_ = 0;
  double radius_ = 0, slope_ = 0, angle_ = 0;  // of two segments: radius at 0, its change, the object angle
};

/// None if the contacts are one site, or a segment and its end, or so nearly parallel on one side that no point has an
/// object angle above rounding.
std::optional<Bisector> bisector_of(const SiteSet& sites, Contact a, Contact b);

}  // namespace medial_vk::plane
