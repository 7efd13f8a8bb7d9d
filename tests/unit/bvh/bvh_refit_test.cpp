// The hierarchy after its triangles have moved.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "medial_vk/bvh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

bool same_bytes(const Bvh& a, const Bvh& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  static_assert(sizeof(BvhNode) == 56);  // no padding to compare
  return equal(a.nodes(), b.nodes()) && equal(a.order(), b.order()) && equal(a.corners(), b.corners());
}

/// The least box around the triangles below a node, all the way up; by recursion, not by the order of the nodes.
BvhBox expect_least_boxes(const Bvh& bvh, const Mesh& mesh, std::uint32_t index) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const BvhNode& node = bvh.nodes()[index];
  BvhBox box = {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  const auto add = [&](const Point& lower, const Point& upper) {
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = std::min(box.lower[k], lower[k]);
      box.upper[k] = std::max(box.upper[k], upper[k]);
    }
  };
  if (node.count == 0) {
    for (std::uint32_t child = node.first; child < node.first + 2; ++child) {
      const BvhBox below = expect_least_boxes(bvh, mesh, child);
      add(below.lower, below.upper);
    }
  }
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    for (const std::uint32_t v : mesh.triangles[bvh.order()[i]]) add(mesh.vertices[v], mesh.vertices[v]);
  }
  EXPECT_EQ(node.box.lower, box.lower);
  EXPECT_EQ(node.box.upper, box.upper);
  return box;
}

TEST(BvhRefit, ChangesNothingWhereNothingMoved) {
  const Mesh mesh = test::make_turned_torus(100, 60);
  for (const unsigned threads : {1u, 2u, 5u}) {
    const Bvh built = Bvh::build(test::view_of(mesh), {.threads = threads}).value();
    Bvh refitted = built;
    ASSERT_TRUE(refitted.refit(test::view_of(mesh), {.threads = threads}).ok());
    EXPECT_TRUE(same_bytes(built, refitted));
  }
}

TEST(BvhRefit, ComesBackToTheSameBytes) {
  const Mesh mesh = test::make_turned_torus(100, 60), moved = test::bent(mesh);
  const Bvh built = Bvh::build(test::view_of(mesh)).value();
  Bvh refitted = built;
  ASSERT_TRUE(refitted.refit(test::view_of(moved)).ok());
  EXPECT_FALSE(same_bytes(built, refitted));
  ASSERT_TRUE(refitted.refit(test::view_of(mesh)).ok());
  EXPECT_TRUE(same_bytes(built, refitted));
}

TEST(BvhRefit, FitsTheLeastBoxes) {
  const Mesh mesh = test::make_turned_torus(100, 60), moved = test::bent(mesh);
  for (const std::uint32_t leaf_size : {1u, 4u, 100u, 100'000u}) {
    const Bvh built = Bvh::build(test::view_of(mesh), {.leaf_size = leaf_size}).value();
    expect_least_boxes(built, mesh, 0);
    Bvh one = built, many = built;
    ASSERT_TRUE(one.refit(test::view_of(moved), {.threads = 1}).ok());
    ASSERT_TRUE(many.refit(test::view_of(moved), {.threads = 7}).ok());
    EXPECT_TRUE(same_bytes(one, many));
    expect_least_boxes(one, moved, 0);
  }
}

// A tree of one triangle gives the distance to that triangle, so all of them together are a slow reference.
TEST(BvhRefit, FindsTheNearestPoint) {
  Mesh mesh = test::make_torus(1.0, 0.4, 24, 16);
  Bvh bvh = Bvh::build(test::view_of(mesh)).value();
  mesh = test::bent(mesh);
  ASSERT_TRUE(bvh.refit(test::view_of(mesh)).ok());
  std::vector<Bvh> alone;
  for (const Triangle& t : mesh.triangles) {
    const Mesh single = {.vertices = mesh.vertices, .triangles = {t}};
    alone.push_back(Bvh::build(test::view_of(single)).value());
  }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-3, 3);
  for (int i = 0; i < 300; ++i) {
    const Point p = {5 + coordinate(random), coordinate(random), coordinate(random)};
    double truth = std::numeric_limits<double>::infinity();
    std::uint32_t nearest = 0;
    for (std::uint32_t t = 0; t < alone.size(); ++t) {
      const double squared = alone[t].closest(p).squared_distance;
      if (squared < truth) nearest = t;
      truth = std::min(truth, squared);
    }
    const BvhHit hit = bvh.closest(p);
    EXPECT_EQ(hit.squared_distance, truth);
    EXPECT_EQ(hit.triangle, nearest);
    EXPECT_TRUE(bvh.any_within(p, std::sqrt(truth) * (1 + 1e-12)));
    EXPECT_FALSE(bvh.any_within(p, std::sqrt(truth) * (1 - 1e-12)));
  }
}

TEST(BvhRefit, RefusesWhatDoesNotFitAndStaysAsItWas) {
  const Mesh mesh = test::make_turned_torus(100, 60);
  const Bvh built = Bvh::build(test::view_of(mesh)).value();
  Bvh bvh = built;
  Mesh fewer = mesh;
  fewer.triangles.pop_back();
  EXPECT_EQ(bvh.refit(test::view_of(fewer)).error().message,
            "the mesh has 11999 triangles, the tree was built over 12000");
  Mesh broken = test::bent(mesh);
  broken.vertices[3][1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(bvh.refit(test::view_of(broken)).error().message, "vertex 3 has a coordinate that is not finite");
  broken = test::bent(mesh);
  broken.triangles[77][2] = 6000;
  broken.triangles[9000][0] = 6001;
  EXPECT_EQ(bvh.refit(test::view_of(broken)).error().message, "face 77 uses vertex 6000 of 6000");
  EXPECT_EQ(bvh.refit(test::view_of(broken)).error().code, ErrorCode::kInvalidMesh);
  EXPECT_TRUE(same_bytes(built, bvh));
}

// Wide splits and subtrees of several threads: the sphere is large enough for all of them.
TEST(BvhBuild, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = test::make_sphere(1.0, 150'000);
  for (const std::uint32_t leaf_size : {1u, 8u}) {
    const Bvh one = Bvh::build(test::view_of(mesh), {.leaf_size = leaf_size, .threads = 1}).value();
    for (const unsigned threads : {2u, 3u, 16u}) {
      EXPECT_TRUE(
          same_bytes(one, Bvh::build(test::view_of(mesh), {.leaf_size = leaf_size, .threads = threads}).value()));
    }
  }
}

}  // namespace
}  // namespace medial_vk
