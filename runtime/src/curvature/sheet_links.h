// Balls of the same medial sheet, from their centres and radii.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "curvature/point_grid.h"
#include "medial_vk/ball.h"
#include "medial_vk/curvature.h"

namespace medial_vk {

/// How the centres lie around a ball.
struct LocalShape {
  /// kKnown: like a sheet. kCurve, kPoint, kSeam, kFew and kNested as in the result.
  CurvatureState state = CurvatureState::kFew;
  Point direction = {0, 0, 0};  ///< The normal of the sheet, or the tangent of the curve; of unit length.
  /// kCurve: half the width of the strip of centres that counts as a curve, or more, but at most a spacing. kPoint: how
  /// far away the centres lie that count as one with that of the ball.
  double blur = 0;
};

/// Balls that lie side by side on one sheet are linked.
class SheetLinks {
 public:
  /// `spacing` is positive.
  SheetLinks(std::span<const Ball> balls, double spacing, unsigned threads);

  std::span<const Ball> balls() const { return balls_; }
  double spacing() const { return spacing_; }
  const LocalShape& shape(std::uint32_t ball) const { return shapes_[ball]; }
  const std::vector<Point>& centres() const { return centres_; }
  const PointGrid& grid() const { return grid_; }
  std::span<const std::uint32_t> linked(std::uint32_t ball) const {
    return {links_.data() + starts_[ball], starts_[ball + 1] - starts_[ball]};
  }

 private:
  LocalShape shape_around(std::uint32_t ball) const;
  double range_across(std::uint32_t ball, const Point& axis) const;
  bool is_nested(std::uint32_t ball) const;
  void check_points(const std::vector<std::uint8_t>& is_nested, unsigned threads);
  bool are_linked(std::uint32_t a, std::uint32_t b) const;
  void link(unsigned threads);

  std::span<const Ball> balls_;
  double spacing_;
  std::vector<Point> centres_;
  PointGrid grid_;
  std::vector<LocalShape> shapes_;
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> links_;
};

/// The balls of one sheet around a ball.
class SheetWindow {
 public:
  struct Member {
    std::uint32_t ball;
    double distance;  ///< Of the centres.
  };

  explicit SheetWindow(const SheetLinks& links) : links_(links), state_(links.balls().size()) {}
  /// The balls within `radius` that chains of links within it join to `ball`, which is among them, in an order that
  /// depends on the centres alone. The result holds until the next call.
  const std::vector<Member>& collect(std::uint32_t ball, double radius);

 private:
  const SheetLinks& links_;
  std::vector<Member> members_;
  std::vector<std::uint8_t> state_;  // by ball: 0 far away, 1 near, 2 reached
  std::vector<std::uint32_t> near_, open_;
};

}  // namespace medial_vk
