#include "ball_hulls/hull_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace medial_vk {
namespace {

using std::numbers::pi;

/// Points at which the lengths of curves on the sphere of directions are measured.
constexpr std::size_t kCurvePoints = 16;
constexpr std::size_t kCurveEnds = kCurvePoints + 1;  // of its pieces

double angle_of(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

}  // namespace

HullRows::HullRows(const HullShape& shape, double tolerance, double step)
    : shape_(shape), tolerance_(tolerance), step_(step) {
  if (shape.form == HullForm::kSlab) {
    add_sectors();
  } else {
    add_rings();
  }
}

/// The side of square cells whose corners are within the angle t of their middles, where the chord of a cap of that
/// angle is `tolerance_` below its top: r (1 - cos t).
double HullRows::greatest_step(double radius) const {
  const double share = tolerance_ / (2 * radius);
  const double angle = share < 0.5 ? 2 * std::asin(std::sqrt(share)) : pi / 2;
  return std::numbers::sqrt2 * angle * step_;
}

/// How many parts of that length at most, one or more.
std::size_t HullRows::parts_of(double length, double part) {
  const double count = std::ceil(length / part);
  if (count < kMostInRow) return std::max<std::size_t>(1, static_cast<std::size_t>(count));
  too_many_ = true;
  return 1;
}

void HullRows::add_pole(std::size_t ball, const Point& axis, double offset) {
  Ring ring;
  ring.ball = ball;
  ring.axis = axis;
  ring.offset = offset;
  rings_.push_back(ring);
}

/// `aside` is perpendicular to the axis; the row starts perpendicular to both, and has an even number of points, so
/// that it has two planes of symmetry. `radius`: of the greatest ball that has this row.
void HullRows::add_ring(std::size_t ball, const Point& axis, const Point& aside, double offset, double radius) {
  Ring ring;
  ring.ball = ball;
  ring.axis = axis;
  ring.aside = aside;
  ring.start = cross(aside, axis);
  ring.offset = offset;
  const double size = std::sqrt(std::max(0.0, (1 - offset) * (1 + offset)));
  ring.points = 2 * std::max<std::size_t>(2, parts_of(pi * size, greatest_step(radius)));
  rings_.push_back(ring);
}

void HullRows::add_rings() {
  const std::size_t last = shape_.count - 1;
  const auto& balls = shape_.balls;
  const auto rows_over = [&](double angle, std::size_t ball) {
    return parts_of(angle, greatest_step(balls[ball].radius));
  };
  std::array<Point, 2> axis = {Point{0, 0, 1}, Point{0, 0, 1}};
  std::array<double, 2> offset{};
  for (std::size_t k = 0; k < last; ++k) {
    const Point along = balls[k + 1].centre - balls[k].centre;
    const double extent = length(along);
    axis[k] = (1 / extent) * along;
    offset[k] = (balls[k].radius - balls[k + 1].radius) / extent;
  }
  if (last < 2) axis[1] = axis[0];
  Point aside = perpendicular_to(axis[0]);
  const Point turn = cross(axis[0], axis[1]);
  if (length(turn) > kAxisRounding) aside = orthogonalized((1 / length(turn)) * turn, axis[0]);

  const double first_angle = last == 0 ? pi : pi - angle_of(offset[0]);
  const std::size_t first_rows = last == 0 ? std::max<std::size_t>(2, rows_over(pi, 0)) : rows_over(first_angle, 0);
  add_pole(0, axis[0], -1);
  for (std::size_t k = 1; k < first_rows; ++k) {
    const double angle = first_angle * static_cast<double>(k) / static_cast<double>(first_rows);
    add_ring(0, axis[0], aside, -std::cos(angle), balls[0].radius);
  }
  if (last == 0) return add_pole(0, axis[0], 1);
  add_ring(0, axis[0], aside, offset[0], std::max(balls[0].radius, balls[1].radius));
  if (last == 2) add_middle(axis[0], axis[1], aside, offset[0], offset[1]);
  const Point& final_axis = axis[last - 1];
  add_ring(last, final_axis, aside, offset[last - 1], std::max(balls[last - 1].radius, balls[last].radius));
  const double last_angle = angle_of(offset[last - 1]);
  const std::size_t last_rows = rows_over(last_angle, last);
  for (std::size_t k = last_rows - 1; k > 0; --k) {
    const double angle = last_angle * static_cast<double>(k) / static_cast<double>(last_rows);
    add_ring(last, final_axis, aside, std::cos(angle), balls[last].radius);
  }
  add_pole(last, final_axis, 1);
}

/// On the middle ball of a chain, from the circle of its first cone to that of its second: circles of the planes
/// through the line in which the planes of these two meet, which is outside of the sphere. They are spaced evenly where
/// the two circles are farthest from each other.
void HullRows::add_middle(const Point& axis, const Point& next_axis, const Point& aside, double offset,
                          double next_offset) {
  const auto& balls = shape_.balls;
  add_ring(1, axis, aside, offset, std::max(balls[0].radius, balls[1].radius));
  const double turn = std::atan2(dot(next_axis, cross(aside, axis)), dot(next_axis, axis));
  const double from = -angle_of(offset), to = turn - angle_of(next_offset);
  const std::size_t count = parts_of(to - from, greatest_step(balls[1].radius));
  for (std::size_t k = 1; k < count; ++k) {
    const double angle = from + (to - from) * static_cast<double>(k) / static_cast<double>(count);
    const double above = std::cos(angle) - offset, beyond = std::cos(angle - turn) - next_offset;
    const double share = above / (above - beyond);
    const Point sum = (1 - share) * axis + share * next_axis;
    const double size = length(sum);
    add_ring(1, (1 / size) * sum, aside, ((1 - share) * offset + share * next_offset) / size, balls[1].radius);
  }
  add_ring(1, next_axis, aside, next_offset, std::max(balls[1].radius, balls[2].radius));
}

/// The normal at `angle` around the face, at a share in [-1, 1] of the arc from one flat triangle's normal to the
/// other's. All arcs are in planes through both.
Point HullRows::slab_normal(double angle, double share) const {
  const AxisFace& face = shape_.face;
  const double c = std::cos(angle), s = std::sin(angle);
  const double beside = face.slope_along * s - face.slope_across * c;  // of the plane from the origin
  const double outside = -face.slope_along * c - face.slope_across * s;
  const double size = std::sqrt((1 - beside) * (1 + beside));
  const double arc = share * std::atan2(face.cosine, outside);
  const double out = size * std::cos(arc);
  return (out * c - beside * s) * face.along + (out * s + beside * c) * face.across +
         size * std::sin(arc) * face.normal;
}

void HullRows::add_sectors() {
  const AxisFace& face = shape_.face;
  const std::array<std::size_t, 3> order = {face.from, face.to, face.third};
  const std::array<double, 3> x = {0, face.extent, face.third_along}, y = {0, 0, face.third_across};
  std::array<double, 3> outward{};  // the angle of the normal of the edge from a corner to the next
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    outward[i] = std::atan2(x[i] - x[j], y[j] - y[i]);
  }
  std::array<double, 3> greatest_arc{};
  for (std::size_t i = 0; i < 3; ++i) {
    SlabSector& sector = sectors_[i];
    sector.ball = order[i];
    sector.from = outward[(i + 2) % 3];
    sector.to = outward[i];
    if (sector.to < sector.from) sector.to += 2 * pi;
    const double radius = shape_.balls[sector.ball].radius;
    if (!(radius > 0)) continue;
    for (std::size_t k = 0; k <= kCurvePoints; ++k) {
      const double angle = sector.from + (sector.to - sector.from) * static_cast<double>(k) / kCurvePoints;
      const double beside = face.slope_along * std::sin(angle) - face.slope_across * std::cos(angle);
      const double outside = -face.slope_along * std::cos(angle) - face.slope_across * std::sin(angle);
      const double arc = 2 * std::sqrt((1 - beside) * (1 + beside)) * std::atan2(face.cosine, outside);
      greatest_arc[i] = std::max(greatest_arc[i], arc);
    }
    slab_rows_ = std::max(slab_rows_, parts_of(greatest_arc[i], greatest_step(radius)));
  }
  slab_rows_ = std::max<std::size_t>(slab_rows_, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    const double radius = shape_.balls[sectors_[i].ball].radius;
    // Flatter cells may be wider: the diagonal is what counts.
    const double most = greatest_step(radius), height = greatest_arc[i] / static_cast<double>(slab_rows_);
    sectors_[i].column_step = std::sqrt(std::max(most * most, 2 * most * most - height * height));
  }
}

/// Evenly spaced by length along the row.
void HullRows::fill_part(const SlabSector& sector, double share, RowPart& part) const {
  part.ball = sector.ball;
  part.normals.clear();
  part.normals.push_back(slab_normal(sector.from, share));
  if (std::fabs(share) == 1 || shape_.balls[sector.ball].radius == 0) return;  // one normal, or one point
  std::array<double, kCurveEnds> along{};
  Point last = part.normals[0];
  const double piece = (sector.to - sector.from) / kCurvePoints;
  for (std::size_t k = 1; k <= kCurvePoints; ++k) {
    const Point next = slab_normal(sector.from + piece * static_cast<double>(k), share);
    along[k] = along[k - 1] + length(next - last);
    last = next;
  }
  const auto count = static_cast<std::size_t>(std::ceil(along[kCurvePoints] / sector.column_step));
  std::size_t k = 1;
  for (std::size_t i = 1; i < count; ++i) {
    const double wanted = along[kCurvePoints] * static_cast<double>(i) / static_cast<double>(count);
    while (k < kCurvePoints && along[k] < wanted) ++k;
    const double part_of_piece = (wanted - along[k - 1]) / (along[k] - along[k - 1]);
    part.normals.push_back(slab_normal(sector.from + piece * (static_cast<double>(k - 1) + part_of_piece), share));
  }
  part.normals.push_back(last);
}

void HullRows::fill(std::size_t index, HullRow& row) const {
  if (shape_.form == HullForm::kSlab) {
    const double share = 2 * static_cast<double>(index) / static_cast<double>(slab_rows_) - 1;
    row.part_count = 3;
    for (std::size_t i = 0; i < 3; ++i) fill_part(sectors_[i], share, row.parts[i]);
    return;
  }
  const Ring& ring = rings_[index];
  row.part_count = 1;
  row.parts[0].ball = ring.ball;
  auto& normals = row.parts[0].normals;
  normals.clear();
  const double size = ring.points > 1 ? std::sqrt(std::max(0.0, (1 - ring.offset) * (1 + ring.offset))) : 0;
  for (std::size_t i = 0; i < ring.points; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(ring.points);
    normals.push_back(ring.offset * ring.axis + size * std::cos(angle) * ring.start +
                      size * std::sin(angle) * ring.aside);
  }
}

double HullRows::normals() const {
  if (too_many_) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (const Ring& ring : rings_) sum += static_cast<double>(ring.points);
  for (const SlabSector& sector : sectors_) {
    if (slab_rows_ == 0 || !(shape_.balls[sector.ball].radius > 0)) continue;
    // A part of a row is at most as long as the circle around the sphere, turned by its angle.
    sum += static_cast<double>(slab_rows_) * ((sector.to - sector.from) / sector.column_step + 2);
  }
  return sum;
}

}  // namespace medial_vk
