// The centres of balls that cover a surface in motion.
#include "cover_following/carried_balls.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "unit/cover_following/cover_example.h"

namespace medial_vk {
namespace {

// One ball around a cube of side 1, whose twelve triangles have the same area, and a stretch along x. The map H Q^-1 of
// docs/theory.md, "Covers that follow a surface": the stretch doubles the part of the corners along x, and leaves that
// of the normals, of which a third of the area has each axis.
TEST(CarriedBalls, CentresFollowTheAffineMapOfLeastSquares) {
  const IndexedMesh cube = test::indexed(test::view_of(test::make_box({1, 1, 1})));
  MovingSurface surface = MovingSurface::build(cube, MovingSurface::Sides::kUnneeded).value();
  const Ball around = {{0.6, 0.3, 0.4}, 2};
  const std::vector<Ball> balls = {around};
  const CarriedBalls carried(surface, divide_boundary(surface.vertices(), surface.triangles(), balls, 1), balls);
  HeldCorners memory;
  constexpr double kEnlarged = 1e-8;  // Q by 1e-9 of its trace, which is below 2
  EXPECT_LE(length(carried.ball(surface, 0, memory).centre - around.centre), kEnlarged);

  const auto vector_of = [](const Point& p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d corners = Eigen::Matrix3d::Zero();
  for (const Triangle& t : cube.view().triangles) {
    for (const std::uint32_t v : t) mean += vector_of(cube.view().vertices[v]) / 36;
  }
  for (const Triangle& t : cube.view().triangles) {
    for (const std::uint32_t v : t) {
      const Eigen::Vector3d d = vector_of(cube.view().vertices[v]) - mean;
      corners += d * d.transpose() / 36;
    }
  }
  const Eigen::Matrix3d normals = around.radius * around.radius / 12 * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d stretch = Eigen::Vector3d(2, 1, 1).asDiagonal();
  const Eigen::Vector3d shift(100, 0, 0);
  const Eigen::Vector3d expected =
      stretch * mean + shift +
      (stretch * corners + normals) * (corners + normals).inverse() * (vector_of(around.centre) - mean);

  CoverFrame stretched(cube.view().vertices.begin(), cube.view().vertices.end());
  for (Point& p : stretched) p = {2 * p[0] + 100, p[1], p[2]};
  ASSERT_TRUE(surface.move(stretched, 1).ok());
  const Ball moved = carried.ball(surface, 0, memory);
  EXPECT_LE((vector_of(moved.centre) - expected).norm(), kEnlarged);
  for (const Point& p : stretched) EXPECT_LE(length(p - moved.centre), moved.radius);
}

}  // namespace
}  // namespace medial_vk
