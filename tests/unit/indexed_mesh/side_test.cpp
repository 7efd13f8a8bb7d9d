// A mesh for the search on one side of its boundary, within a box (IndexedMesh::on_side()).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "medial_vk/analysis.h"
#include "medial_vk/cover_follower.h"
#include "medial_vk/curvature.h"
#include "medial_vk/follower.h"
#include "medial_vk/follower_job.h"
#include "medial_vk/least_wall.h"
#include "medial_vk/proximity.h"
#include "medial_vk/scene.h"
#include "medial_vk/thickness.h"
#include "medial_vk/vertex_curvature.h"
#include "reference_bridge/reference_extractor.h"
#include "solid/solid.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

Mesh pair_of_boxes() {
  Mesh mesh = test::make_box({2, 1, 0.5});
  test::append(mesh, test::moved(test::make_box({2, 1, 0.5}), {0, 0, 0.75}));
  return mesh;  // [0, 2] x [0, 1] x [0, 1.25]
}

// The share of the longest side by which the box reaches further at its lower corner (docs/theory.md, "The
// complement").
const double kShift = (std::sqrt(5.0) - 1) / 86;

IndexedMesh mesh_of_boxes() { return test::indexed(test::prepare(pair_of_boxes())); }

TEST(MeshSides, TheBoxReachesBeyondTheMeshByItsMargin) {
  const IndexedMesh mesh = mesh_of_boxes();
  EXPECT_EQ(mesh.side(), MeshSide::kInside);
  EXPECT_EQ(mesh.margin(), 0);
  EXPECT_EQ(mesh.region_lower(), (Point{0, 0, 0}));
  EXPECT_EQ(mesh.region_upper(), (Point{2, 1, 1.25}));
  EXPECT_EQ(mesh.longest_side(), 2);
  const IndexedMesh usual = mesh.on_side({}).value();
  EXPECT_EQ(usual.side(), MeshSide::kOutside);
  EXPECT_EQ(usual.margin(), 1) << "half of the longest side";
  EXPECT_EQ(usual.region_lower(), (Point{-1 - 2 * kShift, -1 - 2 * kShift, -1 - 2 * kShift}));
  EXPECT_EQ(usual.region_upper(), (Point{3, 2, 2.25}));
  EXPECT_EQ(usual.longest_side(), 4 + 2 * kShift);
  const IndexedMesh inside = mesh.on_side({MeshSide::kInside, 0.25}).value();
  EXPECT_EQ(inside.side(), MeshSide::kInside);
  EXPECT_EQ(inside.region_upper(), (Point{2.25, 1.25, 1.5}));
  EXPECT_EQ(inside.longest_side(), 2.5 + 2 * kShift);
  EXPECT_EQ(inside.prepared().mesh.triangles, mesh.prepared().mesh.triangles);
}

TEST(MeshSides, TheBoxFollowsVerticesThatMove) {
  IndexedMesh outside = mesh_of_boxes().on_side({}).value();
  Mesh twice = pair_of_boxes();
  test::scale(twice, 2);
  ASSERT_TRUE(outside.move_vertices(twice.vertices).ok());
  EXPECT_EQ(outside.side(), MeshSide::kOutside);
  EXPECT_EQ(outside.region_upper(), (Point{6, 4, 4.5})) << "half of the longest side, which is 4 now";
  EXPECT_EQ(outside.region_lower()[0], -2 - 4 * kShift);
  IndexedMesh fixed = mesh_of_boxes().on_side({MeshSide::kOutside, 0.25}).value();
  ASSERT_TRUE(fixed.move_vertices(twice.vertices).ok());
  EXPECT_EQ(fixed.region_upper(), (Point{4.25, 2.25, 2.75})) << "a length";
}

// With margins and faces at simple shares of the longest side, no face is in one of voxels, at the usual resolutions.
TEST(MeshSides, NoFaceOfABoxLiesInAFaceOfVoxels) {
  const Mesh box = test::make_box({1, 0.5, 0.25});
  for (const double margin : {0.0, 0.05, 0.1, 0.2, 0.25, 0.3, 0.5, 1.0, 2.0}) {
    const IndexedMesh outside = test::indexed(test::prepare(box)).on_side({MeshSide::kOutside, margin}).value();
    for (std::uint32_t resolution = 4; resolution <= 512; resolution += 4) {
      const double voxel = outside.longest_side() / resolution;
      for (const double face : {0.0, 0.25, 0.5, 1.0}) {
        const double place = (face - outside.region_lower()[0]) / voxel;
        EXPECT_GT(std::fabs(std::remainder(place, 1)), 1e-5) << margin << ' ' << resolution << ' ' << face;
      }
    }
  }
}

// An update with the flags of the mesh trusts no normal beside an open one.
TEST(MeshSides, FlagsOfAMoveTrustNoNormalOutsideOfAnOpenMesh) {
  Mesh open = pair_of_boxes();
  open.triangles.pop_back();
  const IndexedMesh mesh = test::indexed(test::prepare(std::move(open)));
  IndexedMesh outside = mesh.on_side({}).value(), inside = mesh;
  const std::vector<std::uint8_t> flags(mesh.prepared().flags.size(), kTrustedNormal | kUncrossed);
  ASSERT_TRUE(outside.move_vertices(mesh.view().vertices, {.flags = flags}).ok());
  ASSERT_TRUE(inside.move_vertices(mesh.view().vertices, {.flags = flags}).ok());
  for (const std::uint8_t now : outside.prepared().flags) EXPECT_EQ(now, kUncrossed);
  EXPECT_EQ(inside.prepared().flags, flags);
}

TEST(MeshSides, BadMarginsAreErrors) {
  const IndexedMesh mesh = mesh_of_boxes();
  for (const double margin :
       {-0.1, 20.1, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const auto made = mesh.on_side({MeshSide::kOutside, margin});
    ASSERT_FALSE(made.ok()) << margin;
    EXPECT_EQ(made.error().code, ErrorCode::kUsage);
    EXPECT_THAT(made.error().message, HasSubstr("`margin`"));
  }
  EXPECT_TRUE(mesh.on_side({MeshSide::kOutside, 20}).ok());
  EXPECT_EQ(mesh.on_side({}).value().on_side({}).error().code, ErrorCode::kUsage);
}

TEST(MeshSides, TrianglesAreTurnedOverAndNormalsStayTrusted) {
  const IndexedMesh mesh = mesh_of_boxes(), outside = mesh.on_side({}).value();
  const std::vector<Triangle>&before = mesh.prepared().mesh.triangles, &after = outside.prepared().mesh.triangles;
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i], (Triangle{before[i][0], before[i][2], before[i][1]}));
  }
  EXPECT_EQ(outside.prepared().flags, mesh.prepared().flags);
  EXPECT_EQ(outside.prepared().report.signed_volume, mesh.prepared().report.signed_volume);
}

// A flat sheet has the outside on both sides.
TEST(MeshSides, OutsideOfAnOpenMeshNoNormalIsTrusted) {
  Mesh open = pair_of_boxes();
  open.triangles.pop_back();
  const IndexedMesh mesh = test::indexed(test::prepare(std::move(open)));
  ASSERT_GT(mesh.prepared().report.trusted_triangles, 0u);
  const IndexedMesh outside = mesh.on_side({}).value();
  for (const std::uint8_t flags : outside.prepared().flags) EXPECT_EQ(flags & kTrustedNormal, 0);
  std::size_t uncrossed = 0;
  for (const std::uint8_t flags : outside.prepared().flags) uncrossed += (flags & kUncrossed) != 0 ? 1 : 0;
  EXPECT_GE(uncrossed, mesh.prepared().report.trusted_triangles);
}

TEST(MeshSides, CallsThatRequireABoundedSolidRefuseTheOutside) {
  const IndexedMesh outside = mesh_of_boxes().on_side({}).value();
  EXPECT_EQ(Solid::build(outside).error().code, ErrorCode::kUsage);
  const Point points[] = {{0, 0, 0}};
  EXPECT_EQ(measure_thickness(outside, points).error().code, ErrorCode::kUsage);
  EXPECT_EQ(measure_least_wall(outside).error().code, ErrorCode::kUsage);
  // These accept the ball, in the lower box, with the inside.
  const Ball ball[] = {{{1, 0.5, 0.25}, 0.2}};
  const IndexedMesh inside = mesh_of_boxes().on_side({MeshSide::kInside, 1}).value();
  EXPECT_TRUE(Follower::create(inside, ball).ok());
  EXPECT_EQ(Follower::create(outside, ball).error().code, ErrorCode::kUsage);
  EXPECT_TRUE(CoverFollower::create(inside, ball).ok());
  EXPECT_EQ(CoverFollower::create(outside, ball).error().code, ErrorCode::kUsage);
  EXPECT_TRUE(Solid::build(inside).ok());
  const BoundaryCurvature curvature = measure_curvature(ball).value();
  EXPECT_TRUE(curvature_at_vertices(inside, ball, curvature).ok());
  EXPECT_EQ(curvature_at_vertices(outside, ball, curvature).error().code, ErrorCode::kUsage);
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  EXPECT_EQ(FollowerJob::create(test::quick_device(), outside, ball).error().code, ErrorCode::kUsage);
}

TEST(MeshSides, ModeThesisSearchesTheInsideOnly) {
  ExtractionOptions options;
  options.mode = Mode::kThesis;
  options.resolution = 8;
  const IndexedMesh outside = mesh_of_boxes().on_side({}).value();
  EXPECT_EQ(reference_extractor()(outside, options, {}, {}).error().code, ErrorCode::kUsage);
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const auto found = extract_medial_spheres(outside, options, test::quick_device());
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::kUsage);
  EXPECT_THAT(found.error().message, HasSubstr("thesis"));
}

TEST(MeshSides, ASceneTakesUpdatesOfItsOwnSideAlone) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const IndexedMesh mesh = mesh_of_boxes(), outside = mesh.on_side({}).value();
  Scene scene = Scene::create(test::quick_device(), outside).value();
  EXPECT_EQ(scene.update(mesh).error().code, ErrorCode::kUsage);
  EXPECT_TRUE(scene.update(outside).ok());
  const Point query[] = {{1, 0.5, 2}};  // in the box of the search, not in that of the mesh
  const auto closest = scene.closest_points(query);
  ASSERT_TRUE(closest.ok());
  EXPECT_NEAR(closest.value()[0].distance, 0.75, 1e-5);
}

// Far away, between the boxes, and in one of them.
TEST(MeshSides, ASceneOfTheOutsideHasItsWindingNumbers) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const IndexedMesh mesh = mesh_of_boxes();
  const std::vector<Point> points = {{1, 0.5, 2}, {1, 0.5, 0.6}, {1, 0.5, 0.25}};
  Scene of_inside = Scene::create(test::quick_device(), mesh).value();
  Scene of_outside = Scene::create(test::quick_device(), mesh.on_side({}).value()).value();
  const auto inside = of_inside.winding_numbers(points, 0.01), outside = of_outside.winding_numbers(points, 0.01);
  ASSERT_TRUE(inside.ok() && outside.ok());
  const double expected[] = {0, 0, 1};
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(inside.value()[i], expected[i], 0.01);
    EXPECT_NEAR(outside.value()[i], 1 - expected[i], 0.01);
  }
}

TEST(MeshSides, AnAnalysisOfTheOutsideHasSheetsAndSignificance) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  AnalysisOptions options;
  options.extraction.resolution = 32;
  options.sheets = SheetOptions();
  options.volumes = true;
  options.medial_mesh = true;
  const auto made = analyse(mesh_of_boxes().on_side({}).value(), options, test::quick_device());
  ASSERT_TRUE(made.ok()) << made.error().message;
  ASSERT_FALSE(made.value().spheres.empty());
  const std::vector<double>& of_sheet = made.value().significance->of_sheet;
  EXPECT_NEAR(std::accumulate(of_sheet.begin(), of_sheet.end(), 0.0), 1, 1e-9);
  EXPECT_TRUE(made.value().medial_mesh.has_value());
  EXPECT_FALSE(made.value().euler_characteristic.has_value()) << "that of a bounded solid";
}

}  // namespace
}  // namespace medial_vk
