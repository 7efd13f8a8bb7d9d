// Proofs about balls, and statements that must not be proved.
#include <gtest/gtest.h>

#include <cmath>

#include "base/point_ops.h"
#include "cpu_reference/sphere_certificate.h"
#include "sphere_fits/quality/sphere_certificate.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/reference_balls.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

class SphereCertificate : public testing::Test {
 protected:
  explicit SphereCertificate(Mesh input = make_box({2, 2, 2}))
      : mesh_(prepare(std::move(input))), solid_(Solid::build(test::indexed(mesh_)).value()) {}

  bool inside(const std::vector<Ball>& balls) const {
    const bool proved = prove_inside(solid_, balls).proved();
    EXPECT_EQ(proved, reference::check_inside(test::to_reference(mesh_), test::to_reference(balls)).passed());
    return proved;
  }
  CoverProof cover(const std::vector<Ball>& balls) const {
    const CoverProof proof = prove_cover(solid_, balls).value();
    EXPECT_EQ(proof.proved(), reference::check_cover(test::to_reference(mesh_), test::to_reference(balls)).passed());
    return proof;
  }

  PreparedMesh mesh_;
  Solid solid_;
};

TEST_F(SphereCertificate, InsideUpToRounding) {
  EXPECT_TRUE(inside({{{1, 1, 1}, 1 - 1e-13}, {{0.5, 1, 1.2}, 0.5 - 1e-13}, {{0.1, 0.1, 0.1}, 0}}));
  EXPECT_FALSE(inside({{{1, 1, 1}, 1 + 1e-9}}));
  EXPECT_FALSE(inside({{{1, 1, 1}, 0.5}, {{3, 1, 1}, 0.5}}));  // outside, though no boundary is in it
  EXPECT_FALSE(inside({{{1, 1, 1}, std::nan("")}}));
  const InsideProof proof = prove_inside(solid_, std::vector<Ball>{{{1, 1, 1}, 0.5}, {{1, 1, 1.5}, 0.75}});
  EXPECT_EQ(proof.tested, 2u);
  EXPECT_EQ(proof.failed, 1u);
  EXPECT_EQ(proof.first_failure, 1u);
  EXPECT_NEAR(proof.greatest_excess, 0.25, 1e-12);
}

TEST_F(SphereCertificate, OneBallCoversOrDoesNot) {
  EXPECT_TRUE(cover({{{1, 1, 1}, std::sqrt(3.0) + 1e-9}}).proved());
  const CoverProof proof = cover({{{1, 1, 1}, std::sqrt(3.0) - 1e-9}});
  EXPECT_FALSE(proof.proved());
  EXPECT_EQ(proof.triangles, 12u);
  EXPECT_GT(proof.uncovered + proof.undecided, 0u);
}

// Four balls around the quarters of a cube meet twice, outside of it.
TEST(SphereCertificateOfAnySize, CoversAreProvedInAnyUnit) {
  for (const double unit : {1e-17, 1.0, 1e17}) {
    const PreparedMesh mesh = prepare(make_box({unit, unit, unit}));
    std::vector<Ball> balls;
    for (const double x : {0.25, 0.75}) {
      for (const double y : {0.25, 0.75}) balls.push_back({{x * unit, y * unit, 0.5 * unit}, 0.62 * unit});
    }
    EXPECT_TRUE(prove_cover(Solid::build(test::indexed(mesh)).value(), balls).value().proved()) << unit;
    EXPECT_TRUE(reference::check_cover(test::to_reference(mesh), test::to_reference(balls)).passed()) << unit;
    balls.pop_back();
    EXPECT_FALSE(reference::check_cover(test::to_reference(mesh), test::to_reference(balls)).passed()) << unit;
  }
}

// Any three of the spheres meet in no point, or in a circle where rounding alone decides.
TEST(SphereCertificateOfTubes, BallsOnOneLineCoverACapsule) {
  const PreparedMesh mesh = prepare(make_capsule(0.3, 2, 24));
  std::vector<Ball> balls;
  for (int k = 0; k <= 40; ++k) {
    const double off = k % 3 * 2.8e-17;
    balls.push_back({{off, k % 2 * 5.6e-17 - off, -1 + 0.05 * k}, 0.31 + 0.001 * (k % 4)});
  }
  const auto both_agree = [&] {
    const bool proved = prove_cover(Solid::build(test::indexed(mesh)).value(), balls).value().proved();
    EXPECT_EQ(proved, reference::check_cover(test::to_reference(mesh), test::to_reference(balls)).passed());
    return proved;
  };
  EXPECT_TRUE(both_agree());
  balls[20].radius = 0.2;  // its neighbours cover its part of the boundary
  EXPECT_TRUE(both_agree());
  balls.erase(balls.begin() + 19, balls.begin() + 22);
  EXPECT_FALSE(both_agree());
}

TEST_F(SphereCertificate, BoundaryThatSeveralBallsShare) {
  // There is one ball for each octant; all pass through the middles of their neighbours' edges.
  std::vector<Ball> octants;
  for (int k = 0; k < 8; ++k) {
    octants.push_back({{k & 1 ? 1.5 : 0.5, k & 2 ? 1.5 : 0.5, k & 4 ? 1.5 : 0.5}, std::sqrt(0.75) + 1e-9});
  }
  EXPECT_TRUE(cover(octants).proved());
  for (std::size_t k = 0; k < octants.size(); ++k) {
    std::vector<Ball> fewer = octants;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_FALSE(cover(fewer).proved()) << k;
  }
  octants[3].radius -= 1e-6;
  EXPECT_FALSE(cover(octants).proved());
}

/// Balls along the faces only: the boundary is covered, the interior is not.
std::vector<Ball> shell(int n, double radius) {
  std::vector<Ball> balls;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k <= n; ++k) {
        if (i % n != 0 && j % n != 0 && k % n != 0) continue;
        balls.push_back({{2.0 * i / n, 2.0 * j / n, 2.0 * k / n}, radius});
      }
    }
  }
  return balls;
}

TEST_F(SphereCertificate, ACavityIsFound) {
  std::vector<Ball> balls = shell(8, 0.21);
  const CoverProof hollow = cover(balls);
  EXPECT_TRUE(hollow.surface_proved());
  EXPECT_GT(hollow.inside, 0u);
  EXPECT_FALSE(hollow.proved());
  balls.push_back({{1, 1, 1}, 1.6});  // touches the corners of nothing, holds the middle
  EXPECT_TRUE(cover(balls).proved());
}

TEST_F(SphereCertificate, ASmallCavityIsFound) {
  // Eight balls that hold the cube except for a hole around its middle.
  std::vector<Ball> balls;
  for (int k = 0; k < 8; ++k) {
    const double out = 0.60;
    balls.push_back({{k & 1 ? 1 + out : 1 - out, k & 2 ? 1 + out : 1 - out, k & 4 ? 1 + out : 1 - out},
                     std::sqrt(3.0) * out - 1e-4});
  }
  const CoverProof hollow = cover(balls);
  EXPECT_TRUE(hollow.surface_proved());
  EXPECT_GT(hollow.inside, 0u);
  for (Ball& ball : balls) ball.radius += 2e-4;
  EXPECT_TRUE(cover(balls).proved());
}

/// A solid with a cavity of its own, which may remain.
class HollowSolid : public SphereCertificate {
 protected:
  static Mesh make() {
    Mesh mesh = make_box({2, 2, 2}), hole = make_box({1.2, 1.2, 1.2});
    translate(hole, {0.4, 0.4, 0.4});
    turn_over(hole);
    append(mesh, hole);
    return mesh;
  }
  HollowSolid() : SphereCertificate(make()) {}
};

TEST_F(HollowSolid, ItsCavityMayStay) {
  const std::vector<Ball> balls = shell(8, 0.3);
  std::vector<Ball> inner = balls;
  for (const Ball& ball : balls)
    inner.push_back(
        {{1 + 0.8 * (ball.centre[0] - 1), 1 + 0.8 * (ball.centre[1] - 1), 1 + 0.8 * (ball.centre[2] - 1)}, 0.2});
  for (const Ball& ball : balls)
    inner.push_back(
        {{1 + 0.65 * (ball.centre[0] - 1), 1 + 0.65 * (ball.centre[1] - 1), 1 + 0.65 * (ball.centre[2] - 1)}, 0.15});
  const CoverProof proof = cover(inner);
  EXPECT_TRUE(proof.proved());
  EXPECT_GT(proof.vertices, 0u);
}

TEST(SphereCertificateOfOpenMeshes, OnlyTheSurfaceIsProved) {
  Mesh open = make_box({2, 2, 2});
  open.triangles.pop_back();
  const PreparedMesh mesh = prepare(open);
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  const CoverProof proof = prove_cover(solid, std::vector<Ball>{{{1, 1, 1}, 2}}).value();
  EXPECT_TRUE(proof.surface_proved());
  EXPECT_FALSE(proof.closed);
  EXPECT_FALSE(proof.proved());
}

}  // namespace
}  // namespace medial_vk
