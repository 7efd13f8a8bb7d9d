// The side of a ball on closed and open meshes: what is stated holds for points of the ball.
#include <gtest/gtest.h>

#include <random>

#include "base/point_ops.h"
#include "medial_vk/prepare.h"
#include "solid/solid.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr Point kSize = {1, 0.8, 0.6}, kMiddle = {0.5, 0.4, 0.3};

Solid solid_of(Mesh mesh) {
  return Solid::build(IndexedMesh::build(prepare_mesh(std::move(mesh)).value()).value()).value();
}

/// A box whose last face, two triangles, is missing.
Mesh open_box() {
  Mesh box = test::make_box(kSize);
  box.triangles.resize(box.triangles.size() - 2);
  return box;
}

class Balls {
 public:
  Point point() { return {range_(random_), range_(random_), range_(random_)}; }
  double radius() { return 0.02 + 0.2 * std::abs(range_(random_)); }

 private:
  std::mt19937_64 random_{5};
  std::uniform_real_distribution<double> range_{-0.9, 0.9};
};

int expect_sides_hold(const Solid& solid) {
  Balls balls;
  int known = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point centre = kMiddle + balls.point();
    const double radius = balls.radius();
    const SolidSide side = solid.side_of_ball(centre, radius);
    if (side == SolidSide::kUnknown) continue;
    ++known;
    EXPECT_GT(solid.distance(centre), radius);
    for (int k = 0; k < 20; ++k) {
      const Point away = balls.point();
      if (length(away) > 0.9) continue;
      EXPECT_EQ(solid.contains(centre + (radius / 0.9) * away), side == SolidSide::kInside);
    }
  }
  return known;
}

TEST(SolidSideOfBall, OfAClosedMeshIsKnownOffTheBoundary) {
  const Solid solid = solid_of(test::make_box(kSize));
  EXPECT_GT(expect_sides_hold(solid), 500);
  EXPECT_EQ(solid.side_of_ball(kMiddle, 0.29), SolidSide::kInside);
  EXPECT_EQ(solid.side_of_ball(kMiddle, 0.31), SolidSide::kUnknown);
  EXPECT_EQ(solid.side_of_ball({2, 2, 2}, 0.5), SolidSide::kOutside);
}

TEST(SolidSideOfBall, OfAnOpenMeshHoldsForAllPointsOfTheBall) {
  const Solid solid = solid_of(open_box());
  ASSERT_FALSE(solid.mesh().report.closed);
  EXPECT_GT(expect_sides_hold(solid), 200);
}

}  // namespace
}  // namespace medial_vk
