#include "thickness/direction_cell.h"

#include <limits>

namespace medial_vk {

CubeFrame CubeFrame::around(const Point& axis) {
  const Point across = perpendicular_to(axis);
  return {{across, cross(axis, across), axis}};
}

// A direction u is a sum of corners c_i with weights w_i >= 0. By |u| = 1 and |c_i| = 1, their sum is at least 1; by
// 1 >= m.u >= sum w_i min m.c_i, for the unit vector m of the middle, it is at most 1 / min m.c_i.
DirectionCell::DirectionCell(const std::array<Point, 3>& corners, int divisions)
    : middle_(corners[0] + corners[1] + corners[2]), bulge_(0), divisions_(divisions) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) corners_[axis][i] = corners[std::min<std::size_t>(i, 2)][axis];
  }
  const double size = length(middle_);
  middle_ = size > 0 ? (1 / size) * middle_ : corners[0];
  const double least = least_of(along(corners_, middle_));
  bulge_ = least > 0 ? kBoundRounding / least : std::numeric_limits<double>::infinity();
}

DirectionCell DirectionCell::part(std::size_t index) const {
  const std::array<Point, 3> corners = {corner(0), corner(1), corner(2)};
  std::size_t first = 0;  // the longest edge begins at this corner
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const double cosine = dot(corners[i], corners[(i + 1) % 3]);
    if (cosine < least) {
      least = cosine;
      first = i;
    }
  }
  const Point &a = corners[first], &b = corners[(first + 1) % 3], &c = corners[(first + 2) % 3];
  const Point between = a + b;  // not zero: all corners are on one side of a plane through the origin
  const Point middle = (1 / length(between)) * between;
  const std::array<Point, 3> half = index == 0 ? std::array{a, middle, c} : std::array{middle, b, c};
  return {half, divisions_ + 1};
}

}  // namespace medial_vk
