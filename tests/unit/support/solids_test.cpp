// The solids on which all other tests depend: watertight, oriented, of the volume that a formula gives.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;
constexpr double kPi = std::numbers::pi;

/// Every directed edge exactly once, with its opposite; every vertex used.
void expect_watertight(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  std::vector<bool> used(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      ASSERT_LT(t[k], mesh.vertices.size());
      used[t[k]] = true;
      ++uses[{t[k], t[(k + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : uses) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(uses.count({edge.second, edge.first}), 1u);
  }
  for (const bool u : used) EXPECT_TRUE(u);
}

std::int64_t euler(const Mesh& mesh) {
  return static_cast<std::int64_t>(mesh.vertices.size()) - static_cast<std::int64_t>(mesh.triangles.size()) / 2;
}

TEST(Solids, Box) {
  const Mesh mesh = make_box({1, 2, 3});
  EXPECT_EQ(mesh.triangles.size(), 12u);
  expect_watertight(mesh);
  EXPECT_NEAR(signed_volume(mesh), 6, 1e-14);
}

TEST(Solids, Sphere) {
  for (const std::uint32_t wanted : {1u, 21u, 1000u, 200000u}) {
    const Mesh mesh = make_sphere(2, wanted);
    EXPECT_GE(mesh.triangles.size(), wanted);
    EXPECT_EQ(euler(mesh), 2);
    for (const Point& p : mesh.vertices) EXPECT_NEAR(std::hypot(p[0], p[1], p[2]), 2, 1e-14);
    double smallest = 1e300, largest = 0;
    for (const Triangle& t : mesh.triangles) {
      Mesh one;
      one.vertices = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
      one.triangles = {{0, 1, 2}};
      smallest = std::min(smallest, signed_volume(one));
      largest = std::max(largest, signed_volume(one));
    }
    EXPECT_LT(largest, 2.1 * smallest);
    if (wanted <= 1000) expect_watertight(mesh);
  }
  EXPECT_NEAR(signed_volume(make_sphere(2, 200000)), 4.0 / 3 * kPi * 8, 32.0 / 3 * kPi * 1e-4);
}

TEST(Solids, Capsule) {
  const Mesh mesh = make_capsule(0.5, 2, 200);
  expect_watertight(mesh);
  EXPECT_EQ(euler(mesh), 2);
  const double exact = kPi * 0.25 * 2 + 4.0 / 3 * kPi * 0.125;
  EXPECT_NEAR(signed_volume(mesh), exact, 1e-3 * exact);
  expect_watertight(make_capsule(1, 0, 16));
  expect_watertight(make_capsule(1, 1e-3, 3));
}

TEST(Solids, Ellipsoid) {
  const Mesh mesh = make_ellipsoid({3, 2, 1}, 200);
  expect_watertight(mesh);
  EXPECT_NEAR(signed_volume(mesh), 8 * kPi, 8 * kPi * 1e-3);
}

TEST(Solids, LShape) {
  const Mesh mesh = make_l_shape(4, 1, 2);
  expect_watertight(mesh);
  EXPECT_EQ(mesh.triangles.size(), 20u);
  EXPECT_NEAR(signed_volume(mesh), (4 + 3) * 2, 1e-13);
}

TEST(Solids, Cup) {
  const std::uint32_t n = 60;
  const Mesh mesh = make_cup(2, 0.25, 3, n);
  expect_watertight(mesh);
  const double polygon = 0.5 * n * std::sin(2 * kPi / n);  // area of the regular n-gon of circumradius 1
  EXPECT_NEAR(signed_volume(mesh), polygon * (4 * 3 - 1.75 * 1.75 * 2.75), 1e-12);
}

TEST(Solids, Torus) {
  const Mesh mesh = make_torus(2, 0.5, 100, 300, 0.5);
  expect_watertight(mesh);
  EXPECT_EQ(mesh.triangles.size(), 60000u);
  EXPECT_EQ(euler(mesh), 0);
  const double exact = 2 * kPi * kPi * 2 * 0.25 * 0.5;
  EXPECT_NEAR(signed_volume(mesh), exact, 1e-3 * exact);
}

TEST(Solids, PlateWithHole) {
  const Mesh mesh = make_plate_with_hole(4, 0.5, 1);
  expect_watertight(mesh);
  EXPECT_EQ(euler(mesh), 0);
  EXPECT_NEAR(signed_volume(mesh), 15 * 0.5, 1e-13);
}

TEST(Solids, MotionsKeepVolume) {
  Mesh mesh = make_l_shape(4, 1, 2);
  rotate(mesh, {1, 2, 3}, 0.7);
  EXPECT_NEAR(signed_volume(mesh), 14, 1e-13);
  translate(mesh, {10, -20, 30});
  EXPECT_NEAR(signed_volume(mesh), 14, 1e-11);
  scale(mesh, 2);
  EXPECT_NEAR(signed_volume(mesh), 112, 1e-10);
  turn_over(mesh);
  EXPECT_NEAR(signed_volume(mesh), -112, 1e-10);
}

}  // namespace
}  // namespace medial_vk
