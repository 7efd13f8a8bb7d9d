// The triangle mesh of a hull: rows of points of its surface, joined.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "ball_hulls/hull_rows.h"
#include "ball_hulls/hull_shape.h"
#include "base/host_memory.h"
#include "base/point_ops.h"
#include "medial_vk/ball_hull.h"

namespace medial_vk {
namespace {

constexpr double kMostTriangles = 1 << 24;

/// Joins rows to a closed surface. A ball of radius 0 has one vertex; triangles that have it more than once are left
/// out, and what they leave is closed, since what shrinks to a point is a disc.
class RowMesher {
 public:
  RowMesher(const HullShape& shape, bool rings) : shape_(shape), rings_(rings) {}

  void add(const HullRow& row) {
    std::array<std::vector<std::uint32_t>, 3> indices;
    for (std::size_t i = 0; i < row.part_count; ++i) add_vertices(row.parts[i], indices[i]);
    if (rings_) {
      if (indices[0].size() > 1) indices[0].push_back(indices[0].front());
      if (!last_[0].empty()) join(last_[0], indices[0]);
    } else if (last_[0].empty()) {
      add_triangle(indices[0][0], indices[2][0], indices[1][0]);
    } else {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        join(last_[i], indices[i]);
        add_triangle(last_[i].back(), last_[next].front(), indices[next].front());
        add_triangle(last_[i].back(), indices[next].front(), indices[i].back());
      }
    }
    last_ = std::move(indices);
  }

  /// After the last row.
  void finish() {
    if (!rings_) add_triangle(last_[0][0], last_[1][0], last_[2][0]);
  }

  Mesh take() { return std::move(mesh_); }

  /// An upper bound of the depth of the mesh in the hull.
  double greatest_depth() const {
    const BallHull hull = shape_.hull();
    double greatest = 0;
    for (const Triangle& triangle : mesh_.triangles) greatest = std::max(greatest, depth_of(triangle, hull));
    return greatest;
  }

 private:
  void add_vertices(const RowPart& part, std::vector<std::uint32_t>& indices) {
    const Ball& ball = shape_.balls[part.ball];
    indices.reserve(part.normals.size() + 1);
    for (const Point& normal : part.normals) {
      if (ball.radius == 0 && point_ball_[part.ball]) {
        indices.push_back(*point_ball_[part.ball]);
        continue;
      }
      indices.push_back(static_cast<std::uint32_t>(mesh_.vertices.size()));
      mesh_.vertices.push_back(ball.centre + ball.radius * normal);
      normals_.push_back(normal);
      if (ball.radius == 0) point_ball_[part.ball] = indices.back();
    }
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
  }

  /// Triangles between two parts of neighbouring rows, whose points are evenly spaced, from their starts to their ends:
  /// at each step forward in the part whose next edge has its middle first.
  void join(const std::vector<std::uint32_t>& lower, const std::vector<std::uint32_t>& upper) {
    const std::size_t m = lower.size() - 1, n = upper.size() - 1;
    std::size_t i = 0, k = 0;
    while (i < m || k < n) {
      if (k == n || (i < m && (2 * i + 1) * n <= (2 * k + 1) * m)) {
        add_triangle(lower[i], lower[i + 1], upper[k]);
        ++i;
      } else {
        add_triangle(lower[i], upper[k + 1], upper[k]);
        ++k;
      }
    }
  }

  /// For any unit vector n the points of a triangle are at most as deep as its lowest corner along n is below the plane
  /// that touches the hull. Two directions are tried: the triangle's normal, which is best for acute triangles, and the
  /// middle of the two normals at its corners that differ most, which is best for obtuse ones.
  double depth_of(const Triangle& triangle, const BallHull& hull) const {
    const Point &a = mesh_.vertices[triangle[0]], &b = mesh_.vertices[triangle[1]], &c = mesh_.vertices[triangle[2]];
    const auto below = [&](const Point& direction) {
      const double size = length(direction);
      if (!(size > 0)) return std::numeric_limits<double>::infinity();
      const Point n = (1 / size) * direction;
      // Relative to a corner, so that nothing is lost where the hull is small and far from the origin.
      double reach = -std::numeric_limits<double>::infinity();
      for (const Ball& ball : hull.balls()) reach = std::max(reach, dot(n, ball.centre - a) + ball.radius);
      return reach - std::min({0.0, dot(n, b - a), dot(n, c - a)});
    };
    double shorter = 0, widest = -1;
    Point middle = {0, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      const Point &first = normals_[triangle[i]], &second = normals_[triangle[(i + 1) % 3]];
      const Point apart = second - first;
      if (dot(apart, apart) <= widest) continue;
      widest = dot(apart, apart);
      middle = first + second;
    }
    return std::min(below(double_area(a, b, c, shorter)), below(middle));
  }

  const HullShape& shape_;
  const bool rings_;
  Mesh mesh_;
  std::vector<Point> normals_;
  std::array<std::vector<std::uint32_t>, 3> last_;
  std::array<std::optional<std::uint32_t>, 3> point_ball_;
};

Error too_many_triangles() {
  return {ErrorCode::kUsage, "the tolerance needs more than 2^24 triangles for one hull; use a greater one"};
}

Result<Mesh> mesh_of_shape(const HullShape& shape, double tolerance) {
  // The steps are those of square cells; where cells are not square they need smaller ones.
  double step = 1;
  for (;;) {
    const HullRows rows(shape, tolerance, step);
    if (!(2 * rows.normals() <= kMostTriangles)) return too_many_triangles();
    RowMesher mesher(shape, rows.is_ring());
    HullRow row;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows.fill(k, row);
      mesher.add(row);
    }
    mesher.finish();
    const double depth = mesher.greatest_depth();
    if (depth <= tolerance) return mesher.take();
    step *= std::max(0.5, 0.98 * std::sqrt(tolerance / depth));
  }
}

}  // namespace

Result<Mesh> mesh_of(const BallHull& hull, double tolerance) {
  if (!(tolerance > 0)) return Error{ErrorCode::kUsage, "the tolerance of a hull's mesh must be positive"};
  for (const Ball& ball : hull.balls()) {
    const double sum = ball.centre[0] + ball.centre[1] + ball.centre[2] + ball.radius;
    if (!std::isfinite(sum) || ball.radius < 0) {
      return Error{ErrorCode::kUsage, "a hull has a number that is not finite, or a negative radius"};
    }
  }
  const HullShape shape = shape_of(hull);
  bool solid = false;
  for (std::size_t i = 0; i < shape.count; ++i) solid = solid || shape.balls[i].radius > 0;
  if (!solid) return Error{ErrorCode::kUsage, "a hull of balls of radius 0 has no volume"};
  // With a tolerance of the hull's size or more the mesh is the coarsest one.
  return catch_out_of_memory("making the mesh of a hull", [&] { return mesh_of_shape(shape, tolerance); });
}

}  // namespace medial_vk
