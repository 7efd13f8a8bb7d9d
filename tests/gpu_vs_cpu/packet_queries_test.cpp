// Closest points by packets, through the public calls, against the reference in double precision.
#include <cmath>

#include "tree_test.h"

namespace medial_vk {
namespace {

using PacketQueriesTest = TreeQueriesTest;

// Packets choose the triangle by another arithmetic, with an error of 15 u (|p - a| + |edge|) (triangle_frame.glsl),
// 3e-6: a triangle that is further by twice that may win. Root mean squares stay as small as those of single queries.
constexpr double kPacketTolerance = kDistanceTolerance + 6e-6;

/// Groups of `size` points on spheres around the points.
std::vector<Point> groups_around(const std::vector<Point>& centres, double radius, std::uint32_t size) {
  const std::vector<Eigen::Vector3d> directions = reference::spiral_points(static_cast<int>(size));
  std::vector<Point> points;
  for (const Point& c : centres) {
    for (const Eigen::Vector3d& d : directions) {
      points.push_back({c[0] + radius * d[0], c[1] + radius * d[1], c[2] + radius * d[2]});
    }
  }
  return points;
}

void expect_closest(const reference::Tree& tree, const std::vector<Point>& points,
                    const std::vector<ClosestPoint>& found) {
  const double longest = tree.longest_side();
  ASSERT_EQ(found.size(), points.size());
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = test::to_eigen(points[i]);
    const double truth = tree.closest(p).distance;
    ASSERT_NEAR(found[i].distance, truth, kPacketTolerance * longest) << "query " << i;
    ASSERT_NEAR((test::to_eigen(found[i].point) - p).norm(), found[i].distance, 1e-12 * longest);
    const reference::TrianglePoint on = tree.closest_on(static_cast<int>(found[i].triangle), p);
    ASSERT_NEAR(std::sqrt(on.squared_distance), truth, kPacketTolerance * longest) << "query " << i;
    squares += std::pow((found[i].distance - truth) / longest, 2);
  }
  EXPECT_LE(std::sqrt(squares / static_cast<double>(points.size())), 2e-7);
}

TEST_F(PacketQueriesTest, GroupsOfPoints) {
  for (const NamedSolid& solid : solids()) {
    const reference::Tree tree(test::to_reference(solid.mesh));
    Scene scene = scene_of(solid.mesh);
    for (const std::uint32_t size : {1u, 50u, 51u, 120u}) {
      SCOPED_TRACE(solid.name + ", groups of " + std::to_string(size));
      const std::vector<Point> points =
          groups_around(points_in_box(tree, 1500 / static_cast<int>(size) + 1, 7), 0.02 * tree.longest_side(), size);
      expect_closest(tree, points, scene.closest_points_of_groups(points, size).value());
    }
  }
}

// This many points are sorted and processed by packets.
TEST_F(PacketQueriesTest, ManyScatteredPoints) {
  for (const NamedSolid& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const reference::Tree tree(test::to_reference(solid.mesh));
    const std::vector<Point> points = points_in_box(tree, 6001, 8);
    expect_closest(tree, points, scene_of(solid.mesh).closest_points(points).value());
  }
}

}  // namespace
}  // namespace medial_vk
