// Clusters of triangles: they partition the leaf order, and their bounds hold, also for a mesh that has moved.
#include "device_mesh/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "support/solids/solids.h"
#include "unit/device_mesh/xyz.h"

namespace medial_vk {
namespace {

UnitTransform unit_box_of(const Bvh& bvh) {
  const BvhBox& box = bvh.nodes()[0].box;
  const Point sides = box.upper - box.lower;
  return {box.lower, std::max({sides[0], sides[1], sides[2]})};
}

// The rounding of numbers in the unit box to float.
constexpr double kRounding = 1e-7;

void expect_holds(const gpu::Cluster& c, const std::array<Point, 3>& corners) {
  for (const Point& p : corners) {
    const Point from_centre = p - xyz(c.centre);
    const double along = dot(from_centre, xyz(c.axis));
    EXPECT_LE(std::abs(along), double{c.half_height});
    EXPECT_LE(length(from_centre - along * xyz(c.axis)), double{c.centre.w});
    for (int k = 0; k < 3; ++k) {
      EXPECT_LE(xyz(c.lower)[k], p[k]);
      EXPECT_GE(xyz(c.upper)[k], p[k]);
    }
  }
  const Point normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  EXPECT_GE(dot(normal, xyz(c.axis)), double{c.axis.w} * length(normal) * (1 - kRounding));
  EXPECT_NEAR(double{c.axis.w} * double{c.axis.w} + double{c.sin_tilt} * double{c.sin_tilt}, 1, 4 * kRounding);
}

std::array<Point, 3> unit_corners(const Bvh& bvh, const UnitTransform& to_unit, std::uint32_t position) {
  std::array<Point, 3> corners = bvh.corners()[position];
  for (Point& p : corners) p = to_unit(p);
  return corners;
}

void expect_bounds_hold(const Bvh& bvh) {
  const UnitTransform to_unit = unit_box_of(bvh);
  const std::vector<std::uint8_t> trusted(bvh.corners().size(), kTrustedNormal);
  const std::vector<gpu::Cluster> clusters = make_clusters(bvh, to_unit, trusted, 16, 8192);
  std::uint32_t position = 0;
  for (const gpu::Cluster& c : clusters) {
    EXPECT_EQ(c.first, position);
    ASSERT_GE(c.count, 1u);
    EXPECT_LE(c.count, 16u);
    double nearest = 1;  // of the centroids to the cluster's point
    for (; position < c.first + c.count; ++position) {
      const std::array<Point, 3> corners = unit_corners(bvh, to_unit, position);
      expect_holds(c, corners);
      const Point centroid = (1.0 / 3) * (corners[0] + corners[1] + corners[2]);
      nearest = std::min(nearest, length(xyz(c.point) - centroid));
    }
    EXPECT_LE(nearest, 2 * kRounding) << "the point is not on the boundary";
  }
  EXPECT_EQ(position, bvh.corners().size());
}

TEST(Clusters, PartTheLeavesAndBoundThem) {
  const Mesh mesh = test::make_turned_torus();
  expect_bounds_hold(Bvh::build(test::view_of(mesh)).value());
}

TEST(Clusters, BoundAMeshThatHasMoved) {
  const Mesh before = test::make_turned_torus(), after = test::bent(before);
  Bvh bvh = Bvh::build(test::view_of(before)).value();
  ASSERT_TRUE(bvh.refit(test::view_of(after)).ok());
  expect_bounds_hold(bvh);
}

TEST(Clusters, AnUntrustedNormalFitsNoCone) {
  const Mesh mesh = test::make_turned_torus();
  const Bvh bvh = Bvh::build(test::view_of(mesh)).value();
  std::vector<std::uint8_t> flags(mesh.triangles.size(), kTrustedNormal);
  flags[77] = 0;
  for (const gpu::Cluster& c : make_clusters(bvh, unit_box_of(bvh), flags, 16, 8192)) {
    const auto first = bvh.order().begin() + c.first;
    const bool holds_it = std::find(first, first + c.count, 77u) != first + c.count;
    EXPECT_EQ(c.axis.w == gpu::kNoCone, holds_it);
  }
  for (const gpu::Cluster& c : make_clusters(bvh, unit_box_of(bvh), {}, 16, 8192)) EXPECT_EQ(c.axis.w, gpu::kNoCone);
}

// +1 or -1 as in shaders/shared/certified/cluster.glsl: by the cylinder and the tilt.
int side_by_cylinder(const gpu::Cluster& c, const Point& p) {
  const Point v = xyz(c.centre) - p, axis = xyz(c.axis);
  const double along = dot(v, axis), most_across = length(v - along * axis) + double{c.centre.w};
  const double least_along = std::abs(along) - double{c.half_height};
  const bool is_clear = double{c.axis.w} * least_along > double{c.sin_tilt} * most_across;
  return c.axis.w != gpu::kNoCone && is_clear ? (along > 0 ? 1 : -1) : 0;
}

TEST(Clusters, AreBehindOrInFrontOnlyIfAllTheirTrianglesAre) {
  const Bvh bvh = Bvh::build(test::view_of(test::make_turned_torus())).value();
  const UnitTransform to_unit = unit_box_of(bvh);
  const std::vector<std::uint8_t> trusted(bvh.corners().size(), kTrustedNormal);
  const std::vector<gpu::Cluster> clusters = make_clusters(bvh, to_unit, trusted, 16, 8192);
  int behind = 0, in_front = 0, neither = 0;
  for (const gpu::Cluster& c : clusters) {
    for (int k = -20; k <= 20; ++k) {  // along the axis, and a little off it
      const Point p = xyz(c.point) + (0.01 * k) * xyz(c.axis) + Point{0.01, -0.02, 0.005};
      const int side = side_by_cylinder(c, p);
      ++(side > 0 ? behind : side < 0 ? in_front : neither);
      for (std::uint32_t i = c.first; side != 0 && i < c.first + c.count; ++i) {
        const std::array<Point, 3> corners = unit_corners(bvh, to_unit, i);
        const Point normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        EXPECT_GT(side * dot(normal, corners[0] - p), 0);
      }
    }
  }
  EXPECT_GT(behind, 1000);
  EXPECT_GT(in_front, 1000);
  EXPECT_GT(neither, 100);
}

TEST(Clusters, GrowUntilThereAreFewEnough) {
  const Bvh bvh = Bvh::build(test::view_of(test::make_turned_torus())).value();
  const auto number = [&](std::uint32_t most) { return make_clusters(bvh, unit_box_of(bvh), {}, 16, most).size(); };
  const std::size_t all = number(8192);
  EXPECT_GE(all, 3600u / 16);
  EXPECT_LT(number(100), all);
  EXPECT_LE(number(100), 100u);
  EXPECT_EQ(number(1), 1u);  // 3,600 triangles are one subtree of at most 4,096
}

TEST(Clusters, AreRunsOfEqualLengthWhereSubtreesAreTooMany) {
  const Mesh mesh = test::make_torus(1.0, 0.4, 100, 100);
  const Bvh bvh = Bvh::build(test::view_of(mesh)).value();
  const auto clusters = make_clusters(bvh, unit_box_of(bvh), {}, 16, 3);
  ASSERT_EQ(clusters.size(), 3u);  // 20,000 triangles: subtrees of 4,096 are more
  EXPECT_EQ(clusters[0].count, 6667u);
  EXPECT_EQ(clusters[2].first + clusters[2].count, 20000u);
  for (const gpu::Cluster& c : clusters) {
    for (std::uint32_t i = c.first; i < c.first + c.count; ++i) {
      for (const Point& p : unit_corners(bvh, unit_box_of(bvh), i)) {
        for (int k = 0; k < 3; ++k) {
          EXPECT_LE(xyz(c.lower)[k], p[k]);
          EXPECT_GE(xyz(c.upper)[k], p[k]);
        }
      }
    }
  }
}

TEST(Clusters, TheMedianRadiusIsInTheMiddle) {
  std::vector<gpu::Cluster> clusters(3);
  clusters[0].centre.w = 5;
  clusters[1].centre.w = 1;
  clusters[2].centre.w = 2;
  EXPECT_EQ(median_radius(clusters), 2);
  EXPECT_EQ(median_radius({}), 0);
}

}  // namespace
}  // namespace medial_vk
