// Rows of outward normals from one end of a hull to the other, of which its mesh is made.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ball_hulls/hull_shape.h"
#include "base/point_ops.h"

namespace medial_vk {

/// The normals of one row at one ball, counter-clockwise seen from the end where the rows end. Together with the ball
/// each is a point of the surface.
struct RowPart {
  std::size_t ball = 0;
  std::vector<Point> normals;
};

/// A row of normals in the closed part of the sphere of directions that belongs to each ball, from south to north.
/// Between neighbouring normals of a part, and between rows, are triangles on that ball; between the end of a part and
/// the start of the next one a strip of a cone.
struct HullRow {
  std::array<RowPart, 3> parts;
  std::size_t part_count = 1;
};

/// The rows of a hull with steps of `step` times the greatest angle that the tolerance allows. A hull without flat
/// triangles has closed rows of one part each, circles, of which the first and the last are a point; neighbouring rows
/// may be the same circle at two balls. One with flat triangles has rows of three parts, of which the first and the
/// last are one normal, that of a flat triangle.
class HullRows {
 public:
  HullRows(const HullShape& shape, double tolerance, double step);

  std::size_t size() const { return shape_.form == HullForm::kSlab ? slab_rows_ + 1 : rings_.size(); }
  bool is_ring() const { return shape_.form != HullForm::kSlab; }
  void fill(std::size_t index, HullRow& row) const;
  /// At least the number of normals of all rows; infinite, and no rows, if one needs more than kMostInRow.
  double normals() const;

  static constexpr double kMostInRow = 1 << 22;

 private:
  struct Ring {
    std::size_t ball = 0;
    Point axis = {}, start = {}, aside = {};  // orthonormal
    double offset = 0;                        // of the circle along its axis
    std::size_t points = 1;
  };
  struct SlabSector {
    std::size_t ball = 0;
    double from = 0, to = 0;  // angles around the normal of the face
    double column_step = 0;   // the greatest length between normals of a row
  };

  double greatest_step(double radius) const;
  std::size_t parts_of(double length, double part);
  void add_ring(std::size_t ball, const Point& axis, const Point& aside, double offset, double radius);
  void add_pole(std::size_t ball, const Point& axis, double offset);
  void add_rings();
  void add_middle(const Point& axis, const Point& next_axis, const Point& aside, double offset, double next_offset);
  void add_sectors();
  void fill_part(const SlabSector& sector, double share, RowPart& part) const;
  Point slab_normal(double angle, double share) const;

  const HullShape shape_;
  double tolerance_, step_;
  std::vector<Ring> rings_;
  std::array<SlabSector, 3> sectors_ = {};
  std::size_t slab_rows_ = 0;
  bool too_many_ = false;
};

}  // namespace medial_vk
