// Frames from mesh files: the same faces as at rest, however polygons are cut.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "motion_files/mesh_motion.h"
#include "motion_files/same_triangles.h"
#include "support/device/device.h"
#include "support/scenes/gltf_writer.h"
#include "support/scenes/scene_files.h"
#include "support/solids/mesh_files.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::HasSubstr;

/// A closed surface without symmetries that merging could hide: a tetrahedron.
Mesh tetrahedron(double height = 1) {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, height}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

class FramesOnDisk : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(temporary_.path() / name, std::ios::binary) << bytes;
    return in_folder(name);
  }

  std::string in_folder(const std::string& name) const { return (temporary_.path() / name).generic_string(); }

  const TemporaryFolder temporary_;
};

std::unique_ptr<MeshMotion> motion_of_files(const std::string& rest, const std::vector<std::string>& frames) {
  Result<std::unique_ptr<MeshMotion>> motion = open_mesh_files(rest, frames);
  EXPECT_TRUE(motion.ok()) << motion.error().message;
  return motion.ok() ? std::move(motion).value() : nullptr;
}

TEST_F(FramesOnDisk, AreReadOneByOneInAnyFormat) {
  const std::string rest = write("rest.obj", to_obj(tetrahedron()));
  const std::vector<std::string> frames = {write("2.off", to_off(tetrahedron(2))),
                                           write("3.ply", to_binary_ply(tetrahedron(3), true))};
  const auto motion = motion_of_files(rest, frames);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->frame_count(), 2u);
  EXPECT_EQ(motion->rig(), nullptr);
  EXPECT_EQ(motion->rest().vertices, tetrahedron().vertices);
  MotionFrame frame;
  for (const std::uint64_t i : {1u, 0u, 1u}) {
    ASSERT_TRUE(motion->read_frame(i, frame).ok());
    EXPECT_EQ(frame.positions, tetrahedron(static_cast<double>(i) + 2).vertices);
    EXPECT_EQ(frame.name, frames[i]);
    EXPECT_FALSE(frame.time);
  }
}

TEST_F(FramesOnDisk, OfOtherFacesAreErrorsThatNameFileAndDifference) {
  const std::string rest = write("rest.obj", to_obj(tetrahedron()));
  Mesh more = tetrahedron(), fewer = tetrahedron(), other = tetrahedron(), turned = tetrahedron();
  more.vertices.push_back({9, 9, 9});
  fewer.triangles.pop_back();
  other.triangles[2] = {1, 3, 0};
  turned.triangles[3] = {0, 2, 3};
  const auto motion = motion_of_files(
      rest, {write("more.obj", to_obj(more)), write("fewer.obj", to_obj(fewer)), write("other.obj", to_obj(other)),
             write("turned.obj", to_obj(turned)), write("broken.obj", "v 1 2\n")});
  ASSERT_TRUE(motion);
  MotionFrame frame;
  const std::string in = in_folder("");
  const auto message = [&](std::uint64_t index) {
    const Status status = motion->read_frame(index, frame);
    EXPECT_FALSE(status.ok());
    if (status.ok()) return std::string();
    EXPECT_EQ(status.error().code, ErrorCode::kInvalidMesh);
    return status.error().message;
  };
  EXPECT_EQ(message(0), in + "more.obj: has 5 vertices where " + in + "rest.obj has 4");
  EXPECT_EQ(message(1), in + "fewer.obj: has 3 triangles where " + in + "rest.obj has 4");
  EXPECT_EQ(message(2), in + "other.obj: triangle 3 has the vertices 2 4 1 where that of " + in + "rest.obj has 2 3 4");
  EXPECT_THAT(message(3), HasSubstr("turned.obj: triangle 4 has the vertices 1 3 4"));
  EXPECT_EQ(message(4), in + "broken.obj:1: vertex has 2 coordinates of 3");
}

TEST_F(FramesOnDisk, MustBeThereBeforeTheFirstIsRead) {
  const std::string rest = write("rest.obj", to_obj(tetrahedron()));
  const Result<std::unique_ptr<MeshMotion>> none = open_mesh_files(rest, {});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::kUsage);
  const Result<std::unique_ptr<MeshMotion>> missing = open_mesh_files(rest, {rest, in_folder("b.obj"), in_folder("c")});
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::kInvalidMesh);
  EXPECT_EQ(missing.error().message, in_folder("b.obj") + ": there is no such file");
  EXPECT_FALSE(open_mesh_files("-", {"-"}).ok());
}

// Quadrilaterals are cut along their shorter diagonal, which changes when a square becomes a rhombus.
TEST_F(FramesOnDisk, PolygonsThatAreCutOtherwiseAreTheSameFaces) {
  const std::string faces = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const auto sheared = [&](double x, double y) {
    std::string text;
    for (const double z : {0., 1.}) {
      for (const auto& [u, v] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}) {
        text +=
            "v " + std::to_string(u + x * v) + " " + std::to_string(v + y * u) + " " + std::to_string(z + x * u) + "\n";
      }
    }
    return text + faces;
  };
  const std::string rest = write("rest.obj", sheared(.5, 0));
  const auto motion = motion_of_files(rest, {write("a.obj", sheared(-.5, 0)), write("b.obj", sheared(0, .3))});
  ASSERT_TRUE(motion);
  const auto other = motion_of_files(in_folder("a.obj"), {rest});
  ASSERT_TRUE(other);
  ASSERT_NE(other->rest().triangles, motion->rest().triangles) << "the test needs polygons that are cut otherwise";
  MotionFrame frame;
  for (std::uint64_t i = 0; i < 2; ++i) {
    const Status status = motion->read_frame(i, frame);
    EXPECT_TRUE(status.ok()) << status.error().message;
    EXPECT_EQ(frame.positions.size(), 8u);
  }
}

Mesh mesh_with(std::size_t vertices, std::vector<Triangle> triangles) {
  return {std::vector<Point>(vertices, Point{0, 0, 0}), std::move(triangles)};
}

bool are_same(const Mesh& rest, const Mesh& frame) { return compare_faces(rest, "rest", frame, "frame").ok(); }

TEST(SameTriangles, PolygonsAreTheirBoundaryWithoutVerticesInside) {
  // A hexagon as a fan from its first corner, as one from its third, and with its middle triangle in common.
  const Mesh fan = mesh_with(6, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  EXPECT_TRUE(are_same(fan, mesh_with(6, {{2, 3, 4}, {2, 4, 5}, {2, 5, 0}, {2, 0, 1}})));
  EXPECT_TRUE(are_same(mesh_with(6, {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}, {0, 4, 5}}),
                       mesh_with(6, {{4, 5, 0}, {0, 2, 4}, {0, 1, 2}, {2, 3, 4}})));
  EXPECT_TRUE(are_same(fan, mesh_with(6, {{1, 2, 0}, {3, 0, 2}, {0, 3, 4}, {0, 4, 5}}))) << "other first corners";
  EXPECT_FALSE(are_same(fan, mesh_with(6, {{0, 1, 2}, {0, 2, 3}, {0, 4, 3}, {0, 4, 5}}))) << "a turned triangle";
  EXPECT_FALSE(are_same(fan, mesh_with(6, {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 4, 5}}))) << "another boundary";
}

TEST(SameTriangles, ClosedSurfacesInAnotherOrderAreNotPolygons) {
  const Mesh one = tetrahedron();
  Mesh other = one;
  std::rotate(other.triangles.begin(), other.triangles.begin() + 1, other.triangles.end());
  EXPECT_TRUE(are_same(one, one));
  EXPECT_FALSE(are_same(one, other));
  // Two tetrahedra over other vertices: their boundaries are empty, and so equal.
  const auto pair = [](std::uint32_t a, std::uint32_t b) {
    std::vector<Triangle> triangles;
    for (const std::uint32_t v : {a, b}) {
      for (const Triangle& t : tetrahedron().triangles) triangles.push_back({t[0] + v, t[1] + v, t[2] + v});
    }
    return mesh_with(9, triangles);
  };
  EXPECT_FALSE(are_same(pair(0, 4), pair(0, 5)));
  EXPECT_FALSE(are_same(pair(0, 4), pair(1, 5)));
}

}  // namespace
}  // namespace medial_vk
