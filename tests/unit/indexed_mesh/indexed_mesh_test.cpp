// A mesh with its index: its contents, and its updates for vertices that move.
#include "medial_vk/indexed_mesh.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "device/context_impl.h"
#include "device_mesh/device_mesh.h"
#include "indexed_mesh/mesh_links.h"
#include "medial_vk/extraction.h"
#include "medial_vk/scene.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

class IndexedMeshTest : public test::DeviceTest {};

ExtractionOptions small_job() {
  ExtractionOptions options;
  options.resolution = 24;
  return options;
}

auto numbers_of(const MedialSphere& s) {
  return std::tuple(s.centre, s.radius, s.spoke_a, s.spoke_b, s.object_angle, s.flux, s.voxel);
}

void expect_same(const Extraction& a, const Extraction& b) {
  ASSERT_GT(a.spheres.size(), 20u);
  ASSERT_EQ(a.spheres.size(), b.spheres.size());
  for (std::size_t i = 0; i < a.spheres.size(); ++i)
    EXPECT_TRUE(numbers_of(a.spheres[i]) == numbers_of(b.spheres[i])) << "sphere " << i;
  EXPECT_EQ(a.measurements.counters.queries, b.measurements.counters.queries);
}

IndexedMesh turned_torus() { return test::indexed(test::prepare(test::make_turned_torus())); }

TEST_F(IndexedMeshTest, SameSpheresFromAMeshThatStaysOnTheDevice) {
  const IndexedMesh mesh = turned_torus();
  for (const Mode mode : {Mode::kCertified, Mode::kThesis}) {
    ExtractionOptions options = small_job();
    options.mode = mode;
    const auto once = extract_medial_spheres(mesh, options, *context_);
    ASSERT_TRUE(once.ok());
    Scene scene = Scene::create(*context_, mesh).value();
    const Extractor extractor = device_extractor(*context_);
    for (int time = 0; time < 2; ++time) {
      const auto from_scene = extract_medial_spheres(scene, options);
      const auto from_extractor = extractor(mesh, options, {}, {});
      ASSERT_TRUE(from_scene.ok() && from_extractor.ok());
      expect_same(once.value(), from_scene.value());
      expect_same(once.value(), from_extractor.value());
    }
  }
}

TEST_F(IndexedMeshTest, AnExtractorFollowsTheMesh) {
  const Extractor extractor = device_extractor(*context_);
  IndexedMesh mesh = turned_torus();
  ASSERT_TRUE(extractor(mesh, small_job(), {}, {}).ok());
  ASSERT_TRUE(mesh.move_vertices(test::bent(test::make_turned_torus()).vertices).ok());
  expect_same(extract_medial_spheres(mesh, small_job(), *context_).value(),
              extractor(mesh, small_job(), {}, {}).value());
}

TEST_F(IndexedMeshTest, AMovedFromOneIsStillThere) {
  IndexedMesh mesh = turned_torus();
  const IndexedMesh moved = std::move(mesh);  // NOLINT(performance-move-const-arg): the test is about this
  EXPECT_TRUE(mesh.is_same(moved));           // NOLINT(bugprone-use-after-move)
}

TEST_F(IndexedMeshTest, CopiesStayWhereTheyAre) {
  const IndexedMesh before = turned_torus();
  const std::vector<std::array<Point, 3>> corners = before.bvh().corners();
  IndexedMesh after = before;
  ASSERT_TRUE(after.move_vertices(test::bent(test::make_turned_torus()).vertices).ok());
  EXPECT_FALSE(after.is_same(before));
  EXPECT_TRUE(before.bvh().corners() == corners);
  EXPECT_NE(after.prepared().report.upper, before.prepared().report.upper);
  EXPECT_EQ(after.prepared().report.upper, after.bvh().nodes()[0].box.upper);
  EXPECT_EQ(after.bvh().order(), before.bvh().order());
}

TEST_F(IndexedMeshTest, RefusesVerticesThatAreNotItsOwn) {
  IndexedMesh mesh = turned_torus();
  const IndexedMesh before = mesh;
  std::vector<Point> vertices = mesh.prepared().mesh.vertices;
  vertices[5][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(mesh.move_vertices(vertices).error().message, "vertex 5 has a coordinate that is not finite");
  vertices.pop_back();
  EXPECT_EQ(mesh.move_vertices(vertices).error().code, ErrorCode::kInvalidMesh);
  const std::vector<std::uint8_t> flags(3, kTrustedNormal);
  EXPECT_EQ(mesh.move_vertices(before.prepared().mesh.vertices, {.flags = flags}).error().code,
            ErrorCode::kInvalidMesh);
  EXPECT_TRUE(mesh.is_same(before));
}

TEST(IndexedMesh, ErrorsAreThoseOfTheTree) {
  Mesh mesh = test::make_turned_torus();
  mesh.vertices[5][0] = std::numeric_limits<double>::quiet_NaN();
  const Result<IndexedMesh> index = IndexedMesh::build(test::view_of(mesh));
  ASSERT_FALSE(index.ok());
  EXPECT_EQ(index.error().code, ErrorCode::kInvalidMesh);
}

TEST_F(IndexedMeshTest, OfTooManyTrianglesIsRefusedByDevices) {
  const Status refused = DeviceMesh::check_size(DeviceMesh::kMostTriangles + 1, Internals::of(*context_).limits);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kOutOfMemory);
  EXPECT_NE(refused.error().message.find("8000001 triangles"), std::string::npos) << refused.error().message;
}

TEST(IndexedMesh, DoesNotDependOnTheNumberOfThreads) {
  const Mesh mesh = test::make_torus(1.0, 0.4, 200, 110, 0.5);
  ASSERT_GT(mesh.triangles.size(), 40000u);  // more than one block of every loop
  const IndexedMesh one = test::indexed(test::view_of(mesh), 1);
  const IndexedMesh three = test::indexed(test::view_of(mesh), 3);
  EXPECT_EQ(one.bvh().order(), three.bvh().order());
  EXPECT_TRUE(one.bvh().corners() == three.bvh().corners());
  const MeshLinks by_one = make_mesh_links(test::view_of(mesh), one.bvh().order(), 1);
  const MeshLinks by_three = make_mesh_links(test::view_of(mesh), one.bvh().order(), 3);
  EXPECT_EQ(by_one.spreads, by_three.spreads);
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  EXPECT_TRUE(same(by_one.links, by_three.links));
  EXPECT_TRUE(same(by_one.corners, by_three.corners));
}

}  // namespace
}  // namespace medial_vk
