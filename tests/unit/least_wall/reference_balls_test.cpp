// The thinnest wall, and the bounds of cells, against balls of the reference that shrink from many boundary points.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "least_wall/wall_cells.h"
#include "medial_vk/least_wall.h"
#include "medial_vk/prepare.h"
#include "support/eigen_points.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/smooth_solids.h"
#include "support/solids/solids.h"
#include "unit/least_wall/wall_examples.h"

namespace medial_vk::test {
namespace {

struct WallCase {
  const char* name;
  Mesh mesh;
  ThicknessSide side = ThicknessSide::kWalls;
  bool has_balls = true;  // with the object angle
};

std::vector<WallCase> wall_cases() {
  Mesh irregular = smooth_ellipsoid(1, 0.7, 0.2)->mesh(900);
  make_irregular(*smooth_ellipsoid(1, 0.7, 0.2), irregular, 5);
  return {{"ellipsoid", irregular},
          {"torus", make_turned_torus(30, 20)},
          {"L", turned(make_l_shape(1, 0.3, 0.2))},
          {"plate with a hole", turned(make_plate_with_hole(1, 0.1, 0.3))},
          {"bent torus", bent(make_turned_torus(24, 16))},
          {"bent cup", bent(turned(make_cup(0.5, 0.1, 1, 16)))},
          {"bent L outside", bent(turned(make_l_shape(1, 0.3, 0.2))), ThicknessSide::kGaps, false},
          {"two boxes outside", bent(make_turned_gap(0.03)), ThicknessSide::kGaps}};
}

/// The distances that the reference gives decide when a ball has shrunk, so its radius exceeds the exact one by up to
/// their error over 1 - cos 2 theta, which is more than 1. The place of its contact is rounded by less than that error.
double error_of_balls(const reference::Tree& tree) { return 2 * tree.rounding(); }

/// The ball that is tangent at p, with its centre in this direction, and shrinks from a radius until it
/// holds no point of the mesh, if its object angle is no less than the given one.
std::optional<Ball> shrunk_ball(const reference::Tree& tree, const Eigen::Vector3d& p, const Eigen::Vector3d& direction,
                                double radius, double object_angle) {
  std::optional<Eigen::Vector3d> other;
  for (int step = 0; step < 60; ++step) {
    const Eigen::Vector3d centre = p + radius * direction;
    const reference::Closest closest = tree.closest(centre);
    if (closest.distance >= radius - tree.rounding()) {
      if (!other) return std::nullopt;
      const Eigen::Vector3d a = (p - centre).normalized(), b = (*other - centre).normalized();
      return reference::half_angle(a, b) >= object_angle ? std::optional(Ball{to_point(centre), radius}) : std::nullopt;
    }
    const Eigen::Vector3d chord = closest.point - p;
    const double along = chord.dot(direction);
    if (!(along > 0)) return std::nullopt;
    other = closest.point;
    radius = chord.squaredNorm() / (2 * along);
  }
  return std::nullopt;
}

/// Where tangent balls shrink from.
struct Start {
  Eigen::Vector3d point, direction;
};

std::vector<Start> starts_in_triangles(const reference::Tree& tree, double toward) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<> share(0, 1);
  std::vector<Start> starts;
  for (int t = 0; t < tree.triangle_count(); ++t) {
    for (int i = 0; i < 4000 / tree.triangle_count() + 1; ++i) {
      const double a = std::sqrt(share(random)), b = share(random);
      starts.push_back({(1 - a) * tree.corner(t, 0) + a * (1 - b) * tree.corner(t, 1) + a * b * tree.corner(t, 2),
                        toward * tree.normal(t)});
    }
  }
  return starts;
}

/// On edges that a ball on this side may touch, along sums of both normals.
std::vector<Start> starts_on_edges(const Mesh& mesh, const reference::Tree& tree, double toward) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles;  // by directed edge
  for (int t = 0; t < tree.triangle_count(); ++t) {
    const Triangle& of = mesh.triangles[static_cast<std::size_t>(t)];
    for (std::size_t k = 0; k < 3; ++k) triangles[{of[k], of[(k + 1) % 3]}] = t;
  }
  std::mt19937_64 random(4);
  std::uniform_real_distribution<> share(0, 1);
  std::vector<Start> starts;
  for (const auto& [edge, t] : triangles) {
    const int other = triangles.at({edge.second, edge.first});
    const Eigen::Vector3d a = to_eigen(mesh.vertices[edge.first]), b = to_eigen(mesh.vertices[edge.second]);
    const Eigen::Vector3d out_of_triangle = (b - a).cross(tree.normal(t)).normalized();
    // Edges where a ball touches turn away from it. Those that turn by less show little else than triangles do.
    if (!(toward * tree.normal(other).dot(out_of_triangle) > 1e-3)) continue;
    for (int i = 0; i < 10; ++i) {
      const double x = share(random), y = share(random);
      const Eigen::Vector3d sum = x * tree.normal(t) + (1 - x) * tree.normal(other);
      starts.push_back({a + y * (b - a), toward * sum.normalized()});
    }
  }
  return starts;
}

/// No cell of a size that the search examines and that holds the centre of a ball has a bound above its radius.
void expect_bounds_below(const IndexedMesh& mesh, const LeastWallOptions& options, const std::vector<Ball>& balls,
                         double error) {
  const Solid solid = Solid::build(mesh).value();
  const WideTree tree(solid.bvh());
  const std::vector<SpokeCone> normals = normals_of(solid);
  const double rounding = 16 * solid.rounding(), small = 0x1p-14 * mesh.longest_side();
  const WallField field = {solid, tree, normals, options, small, rounding};
  WallCells cells(field);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<> offset(-1, 1);
  for (const Ball& ball : balls) {
    for (int k = 0; k < 36; ++k) {
      WallCell cell = {.centre = ball.centre, .half = ball.radius * std::ldexp(1, 1 - k)};
      if (cell.half < 8 * rounding) break;
      for (double& x : cell.centre) x += cell.half * offset(random);
      // Alone, and after larger balls were found, which limit the reach.
      for (const double larger : {std::numeric_limits<double>::infinity(), 1.5, 1.01, 1 + 1e-9}) {
        WallCell examined = cell;
        cells.examine(examined, larger * (ball.radius + error));
        EXPECT_LE(examined.least, ball.radius + error) << k << " at " << testing::PrintToString(ball.centre);
      }
    }
  }
}

class LeastWallOf : public testing::TestWithParam<WallCase> {};

TEST_P(LeastWallOf, HoldsWhatTheReferenceFinds) {
  const PreparedMesh prepared = prepare_mesh(GetParam().mesh).value();
  const reference::Tree tree(to_reference(prepared));
  LeastWallOptions options = width_of(0.05);
  options.side = GetParam().side;
  const LeastWall found = measure_least_wall(indexed(prepared), options).value();
  EXPECT_LE(found.diameter.upper, found.diameter.lower * 1.05 * (1 + 1e-12));
  const double longest = prepared.report.longest_side(), toward = options.side == ThicknessSide::kWalls ? -1 : 1;
  if (found.thinnest) expect_touches(found, prepared, options);
  std::vector<Start> starts = starts_in_triangles(tree, toward);
  const std::vector<Start> on_edges = starts_on_edges(prepared.mesh, tree, toward);
  starts.insert(starts.end(), on_edges.begin(), on_edges.end());
  std::vector<Ball> balls;
  for (const auto& [point, direction] : starts) {
    const auto ball = shrunk_ball(tree, point, direction, 0.5 * longest, options.object_angle + 1e-6);
    if (ball) balls.push_back(*ball);
  }
  for (const Ball& ball : balls) EXPECT_GE(2 * (ball.radius + error_of_balls(tree)), found.diameter.lower);
  expect_bounds_below(indexed(prepared), options, balls, error_of_balls(tree));
  EXPECT_EQ(balls.size() > 10, GetParam().has_balls) << balls.size();
}

INSTANTIATE_TEST_SUITE_P(Solids, LeastWallOf, testing::ValuesIn(wall_cases()), [](const auto& example) {
  std::string name = example.param.name;
  std::erase(name, ' ');
  return name;
});

}  // namespace
}  // namespace medial_vk::test
