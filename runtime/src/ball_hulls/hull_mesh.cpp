// The triangle mesh of a hull: rows of points of its surface, joined.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
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

  Mesh finished() {
    if (!rings_) add_triangle(last_[0][0], last_[1][0], last_[2][0]);
    return std::move(mesh_);
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

  const HullShape& shape_;
  const bool rings_;
  Mesh mesh_;
  std::array<std::vector<std::uint32_t>, 3> last_;
  std::array<std::optional<std::uint32_t>, 3> point_ball_;
};

/// An upper bound of the depth of the mesh in the hull: a point of a triangle is at most as deep as the triangle's
/// plane is below the parallel plane that touches the hull.
double greatest_depth(const Mesh& mesh, const BallHull& hull) {
  double greatest = 0;
  for (const Triangle& triangle : mesh.triangles) {
    const Point &a = mesh.vertices[triangle[0]], &b = mesh.vertices[triangle[1]], &c = mesh.vertices[triangle[2]];
    double shorter = 0;
    const Point area = double_area(a, b, c, shorter);
    const double size = length(area);
    if (!(size > 0x1p-30 * shorter)) continue;  // its points are on edges, which are as deep in other triangles
    const Point normal = (1 / size) * area;
    greatest = std::max(greatest, support(hull, normal) - std::min({dot(normal, a), dot(normal, b), dot(normal, c)}));
  }
  return greatest;
}

Error too_many_triangles() {
  return {ErrorCode::kUsage, "the tolerance needs more than 2^24 triangles for one hull; use a greater one"};
}

Result<Mesh> mesh_of_shape(const HullShape& shape, double tolerance) {
  const BallHull hull = shape.hull();
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
    Mesh mesh = mesher.finished();
    const double depth = greatest_depth(mesh, hull);
    if (depth <= tolerance) return mesh;
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
