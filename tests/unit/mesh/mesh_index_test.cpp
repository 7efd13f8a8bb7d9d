// What is known of a mesh before there is a device: extractions with it are those without, and it does not move.
#include "medial_vk/mesh_index.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "device/context_impl.h"
#include "device_mesh/device_mesh.h"
#include "device_mesh/mesh_links.h"
#include "medial_vk/extraction.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

class MeshIndexTest : public test::DeviceTest {};

ExtractionOptions small_job() {
  ExtractionOptions parameters;
  parameters.resolution = 24;
  return parameters;
}

auto numbers_of(const MedialSphere& s) {
  return std::tuple(s.centre, s.radius, s.spoke_a, s.spoke_b, s.object_angle, s.flux, s.voxel);
}

void expect_same(const Extraction& a, const Extraction& b) {
  ASSERT_GT(a.spheres.size(), 20u);
  ASSERT_EQ(a.spheres.size(), b.spheres.size());
  for (std::size_t i = 0; i < a.spheres.size(); ++i)
    EXPECT_TRUE(numbers_of(a.spheres[i]) == numbers_of(b.spheres[i])) << "sphere " << i;
  EXPECT_EQ(a.counters.queries, b.counters.queries);
}

TEST_F(MeshIndexTest, ExtractionsAreThoseWithout) {
  const PreparedMesh mesh = test::prepare(test::make_turned_torus());
  const MeshIndex index = MeshIndex::create(mesh.view()).value();
  const auto without = extract_medial_spheres(*context_, mesh.view(), small_job());
  ASSERT_TRUE(without.ok());
  for (int time = 0; time < 2; ++time) {
    const auto with = extract_medial_spheres(*context_, mesh.view(), index, small_job());
    ASSERT_TRUE(with.ok());
    expect_same(without.value(), with.value());
  }
}

TEST_F(MeshIndexTest, OfAnotherMeshIsRefused) {
  const PreparedMesh mesh = test::prepare(test::make_turned_torus()),
                     other = test::prepare(test::make_turned_torus(24, 12));
  const MeshIndex index = MeshIndex::create(other.view()).value();
  const auto refused = extract_medial_spheres(*context_, mesh.view(), index, small_job());
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
  MeshView without_flags = mesh.view();
  without_flags.flags = {};
  EXPECT_TRUE(MeshIndex::create(mesh.view()).value().is_of(mesh.view()));
  EXPECT_FALSE(MeshIndex::create(mesh.view()).value().is_of(without_flags));
}

TEST_F(MeshIndexTest, ModeThesisDoesWithoutOne) {
  const PreparedMesh mesh = test::prepare(test::make_turned_torus());
  ExtractionOptions parameters = small_job();
  parameters.mode = Mode::kThesis;
  const auto without = extract_medial_spheres(*context_, mesh.view(), parameters);
  const auto with = extract_medial_spheres(*context_, mesh.view(), MeshIndex::create(mesh.view()).value(), parameters);
  ASSERT_TRUE(without.ok() && with.ok());
  expect_same(without.value(), with.value());
}

TEST_F(MeshIndexTest, AMovedOneIsStillThere) {
  MeshIndex index = MeshIndex::create(test::view_of(test::make_turned_torus())).value();
  const MeshIndex moved = std::move(index);  // NOLINT(performance-move-const-arg): that is the question
  EXPECT_EQ(&index.bvh(), &moved.bvh());     // NOLINT(bugprone-use-after-move)
}

TEST_F(MeshIndexTest, StaysWhereItIsWhenADeviceMeshMoves) {
  const Mesh before = test::make_turned_torus(), after = test::bent(before);
  const MeshIndex index = MeshIndex::create(test::view_of(before)).value();
  const std::vector<std::array<Point, 3>> corners = index.bvh().corners();
  DeviceMesh device = DeviceMesh::create(Internals::of(*context_), test::view_of(before), index).value();
  ASSERT_TRUE(device.finish_uploads().ok());
  ASSERT_TRUE(device.update(Internals::of(*context_), test::view_of(after)).ok());
  EXPECT_TRUE(index.bvh().corners() == corners);
  EXPECT_NE(device.upper, index.bvh().nodes()[0].box.upper);
}

TEST(MeshIndex, ErrorsAreThoseOfTheTree) {
  Mesh mesh = test::make_turned_torus();
  mesh.vertices[5][0] = std::numeric_limits<double>::quiet_NaN();
  const Result<MeshIndex> index = MeshIndex::create(test::view_of(mesh));
  ASSERT_FALSE(index.ok());
  EXPECT_EQ(index.error().code, ErrorCode::kInvalidMesh);
}

TEST(MeshIndex, OfTooManyTrianglesIsRefusedBeforeAnythingIsBuilt) {
  Mesh mesh = test::make_box({1, 1, 1});
  mesh.triangles.resize(DeviceMesh::kMostTriangles + 1, mesh.triangles[0]);
  const Result<MeshIndex> index = MeshIndex::create(test::view_of(mesh));
  ASSERT_FALSE(index.ok());
  EXPECT_EQ(index.error().code, ErrorCode::kOutOfMemory);
  EXPECT_NE(index.error().message.find("8000001 triangles"), std::string::npos) << index.error().message;
}

TEST(MeshIndex, DoesNotDependOnTheNumberOfThreads) {
  const Mesh mesh = test::make_torus(1.0, 0.4, 200, 110, 0.5);
  ASSERT_GT(mesh.triangles.size(), 40000u);  // more than one block of every loop
  const MeshIndex one = MeshIndex::create(test::view_of(mesh), 1).value();
  const MeshIndex three = MeshIndex::create(test::view_of(mesh), 3).value();
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
