#include "thickness/direction_cell.h"

namespace medial_vk {
namespace {

Point direction_through(const CubeFrame& frame, std::uint8_t face, double x, double y) {
  const std::size_t axis = (face / 2 + 2) % 3;
  const double side = face % 2 == 0 ? 1 : -1;
  const Point through = side * frame.axes[axis] + x * frame.axes[(axis + 1) % 3] + y * frame.axes[(axis + 2) % 3];
  return (1 / length(through)) * through;
}

}  // namespace

CubeFrame CubeFrame::around(const Point& axis) {
  const Point across = perpendicular_to(axis);
  return {{across, cross(axis, across), axis}};
}

DirectionCell DirectionCell::face(const CubeFrame& frame, std::size_t face) {
  return {frame, static_cast<std::uint8_t>(face), 0, 0, 1};
}

DirectionCell DirectionCell::part(const CubeFrame& frame, std::size_t index) const {
  const double half = 0.5 * half_;
  return {frame, face_, x_ + (index % 2 == 0 ? -half : half), y_ + (index < 2 ? -half : half), half};
}

// A direction u is a sum of corners c_i with weights w_i >= 0. By |u| = 1 and |c_i| = 1, their sum is at least 1; by
// 1 >= m.u >= sum w_i min m.c_i, for the unit vector m of the middle, it is at most 1 / min m.c_i.
DirectionCell::DirectionCell(const CubeFrame& frame, std::uint8_t face, double x, double y, double half)
    : middle_(direction_through(frame, face, x, y)), bulge_(0), x_(x), y_(y), half_(half), face_(face) {
  for (std::size_t i = 0; i < 4; ++i) {
    const Point corner = direction_through(frame, face, i % 2 == 0 ? x - half : x + half, i < 2 ? y - half : y + half);
    for (std::size_t k = 0; k < 3; ++k) corners_[k][i] = corner[k];
  }
  bulge_ = kBoundRounding / least_of(along(corners_, middle_));
}

}  // namespace medial_vk
