// The solids of a robot: primitives as meshes on the right side, files that are found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/point_ops.h"
#include "medial_vk/prepare.h"
#include "robots/parts.h"
#include "support/scenes/scene_files.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Geometry primitive(GeometryKind kind, const Point& size) {
  Geometry geometry;
  geometry.kind = kind;
  geometry.size = size;
  return geometry;
}

/// Distance to the axis segment of a cylinder or capsule minus its radius; of a cylinder beside its lids only.
double outside_by(const Geometry& geometry, const Point& p) {
  const double half = geometry.size[1] / 2;
  const double over = geometry.kind == GeometryKind::kCapsule ? std::max(std::fabs(p[2]) - half, 0.0) : 0.0;
  return std::sqrt(p[0] * p[0] + p[1] * p[1] + over * over) - geometry.size[0];
}

class Curved : public testing::TestWithParam<Geometry> {};

TEST_P(Curved, MeshesAreWithinOrAround) {
  const Geometry geometry = GetParam();
  for (const FacetSide side : {FacetSide::kInscribed, FacetSide::kCircumscribed}) {
    Result<PreparedMesh> prepared = prepare_mesh(make_primitive(geometry, side));
    ASSERT_TRUE(prepared.ok());
    const MeshReport& report = prepared.value().report;
    EXPECT_TRUE(report.closed);
    EXPECT_EQ(report.reoriented_faces, 0u);
    EXPECT_EQ(report.intersecting_faces, 0u);
    EXPECT_EQ(report.degenerates_dropped, 0u);
    const bool inside = side == FacetSide::kInscribed;
    EXPECT_EQ(inside, report.signed_volume < primitive_volume(geometry));
    EXPECT_NEAR(report.signed_volume / primitive_volume(geometry), 1, 0.004);
    const double deepest = facet_share(geometry.kind) * geometry.size[0];
    for (const Triangle& t : prepared.value().mesh.triangles) {
      const std::vector<Point>& v = prepared.value().mesh.vertices;
      const Point middle = 1.0 / 3 * (v[t[0]] + v[t[1]] + v[t[2]]);
      const bool is_lid =
          geometry.kind == GeometryKind::kCylinder && v[t[0]][2] == v[t[1]][2] && v[t[1]][2] == v[t[2]][2];
      for (const Point& p : {v[t[0]], v[t[1]], v[t[2]], middle, 0.5 * (v[t[0]] + v[t[1]]), 0.5 * (v[t[1]] + v[t[2]])}) {
        if (inside) {
          EXPECT_LE(outside_by(geometry, p), 0);
        }
        if (is_lid) continue;
        if (inside) {
          EXPECT_GE(outside_by(geometry, p), -1.001 * deepest);
        } else {
          EXPECT_GE(outside_by(geometry, p), -1e-15);
          EXPECT_LE(outside_by(geometry, p), 1.01 * deepest);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Primitives, Curved,
                         testing::Values(primitive(GeometryKind::kCylinder, {0.3, 1, 0}),
                                         primitive(GeometryKind::kCylinder, {7, 0.01, 0}),
                                         primitive(GeometryKind::kCapsule, {0.3, 1, 0}),
                                         primitive(GeometryKind::kCapsule, {0.01, 20, 0})));

TEST(Parts, BoxesAreExact) {
  const Geometry box = primitive(GeometryKind::kBox, {1, 2, 3});
  Result<PreparedMesh> prepared = prepare_mesh(make_primitive(box, FacetSide::kInscribed));
  ASSERT_TRUE(prepared.ok());
  EXPECT_EQ(prepared.value().report.lower, (Point{-0.5, -1, -1.5}));
  EXPECT_EQ(prepared.value().report.upper, (Point{0.5, 1, 1.5}));
  EXPECT_EQ(prepared.value().report.signed_volume, 6);
  EXPECT_EQ(prepared.value().report.reoriented_faces, 0u);
  EXPECT_EQ(facet_share(GeometryKind::kBox), 0);
}

class RobotFiles : public testing::Test {
 protected:
  RobotFiles() {
    folder_ = fs::temp_directory_path() / ("medial-vk-robot-" + std::to_string(::getpid()));
    fs::create_directories(folder_ / "arm/urdf");
    fs::create_directories(folder_ / "arm/meshes");
    write("arm/meshes/box.obj", test::to_obj(test::make_box({1, 2, 3})));
  }
  ~RobotFiles() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string found(const std::string& uri, const std::vector<std::string>& packages = {}) const {
    const Result<MeshPlaces> places = mesh_places(path("arm/urdf/arm.urdf"), packages);
    if (!places) return places.error().message;
    const Result<std::string> file = find_mesh(uri, places.value());
    return file ? fs::weakly_canonical(file.value()).string() : file.error().message;
  }

  Result<RobotParts> load(const Geometry& geometry) const { return load(std::vector{geometry}); }

  Result<RobotParts> load(const std::vector<Geometry>& geometries) const {
    Robot robot;
    robot.links.push_back({"link", geometries, {}});
    const Result<MeshPlaces> places = mesh_places(path("arm/urdf/arm.urdf"), {});
    return load_parts(robot, false, FacetSide::kInscribed, places.value(), "arm.urdf");
  }

  fs::path folder_;
};

TEST_F(RobotFiles, MeshesAreFoundWhereverTheyMayBe) {
  const std::string box = fs::weakly_canonical(path("arm/meshes/box.obj")).string();
  EXPECT_EQ(found("../meshes/box.obj"), box);
  EXPECT_EQ(found("file://" + box), box);
  EXPECT_EQ(found(box), box);
  EXPECT_EQ(found("package://arm/meshes/box.obj"), box);
  EXPECT_EQ(found("package://other/meshes/box.obj", {"other=" + path("arm")}), box);
  EXPECT_EQ(found("package:///arm/meshes/box.obj"), box);  // as some robots have it, and other readers accept
  EXPECT_THAT(found("package://other/meshes/box.obj"), HasSubstr("--package other=FOLDER"));
  ::setenv("ROS_PACKAGE_PATH", (path("none") + ":" + path("")).c_str(), 1);
  EXPECT_EQ(found("package://arm/meshes/box.obj"), box);
  ::unsetenv("ROS_PACKAGE_PATH");
}

TEST_F(RobotFiles, WhatIsNotFoundIsNamed) {
  EXPECT_THAT(found("../meshes/none.obj"), HasSubstr("none.obj\" is not there"));
  EXPECT_THAT(found("package://arm"), HasSubstr("\"package://arm\" is a folder"));
  EXPECT_THAT(found("package://"), HasSubstr("names no package"));
  EXPECT_THAT(found("package:///"), HasSubstr("names no package"));
  EXPECT_THAT(found("package:////arm/meshes/box.obj"), HasSubstr("names no package"));
  EXPECT_THAT(found("package://../x.obj"), HasSubstr("names no package"));
  EXPECT_THAT(found("http://host/x.obj"), HasSubstr("neither package:// nor file:///"));
  EXPECT_THAT(found("x.obj", {"nosign"}), HasSubstr("NAME=FOLDER"));
}

TEST_F(RobotFiles, ScalesAreApplied) {
  Geometry geometry;
  geometry.mesh = "../meshes/box.obj";
  geometry.scale = {2, -1, 0.5};
  const Result<RobotParts> parts = load(geometry);
  ASSERT_TRUE(parts.ok()) << parts.error().message;
  const Part& part = parts.value().parts.front();
  EXPECT_EQ(part.name, "../meshes/box.obj");
  EXPECT_EQ(fs::weakly_canonical(parts.value().origins.front().file), fs::weakly_canonical(path("arm/meshes/box.obj")));
  EXPECT_EQ(part.mesh->prepared().report.lower, (Point{0, -2, 0}));
  EXPECT_EQ(part.mesh->prepared().report.upper, (Point{2, 0, 1.5}));
  EXPECT_NEAR(part.mesh->prepared().report.signed_volume, 6, 1e-12);
  EXPECT_FALSE(part.mesh->prepared().report.inside_out);
}

TEST_F(RobotFiles, AMeshIsPreparedOnceForEachScale) {
  Geometry geometry, doubled;
  geometry.mesh = doubled.mesh = "../meshes/box.obj";
  doubled.scale = {2, 2, 2};
  const Result<RobotParts> parts = load(std::vector{geometry, doubled, geometry});
  ASSERT_TRUE(parts.ok()) << parts.error().message;
  const std::vector<Part>& all = parts.value().parts;
  EXPECT_EQ(&all[0].mesh->prepared(), &all[2].mesh->prepared());
  EXPECT_EQ(all[0].mesh->prepared().report.upper, (Point{1, 2, 3}));
  EXPECT_EQ(all[1].mesh->prepared().report.upper, (Point{2, 4, 6}));
}

// Meshes are read side by side; a file that does not exist is noticed before.
TEST_F(RobotFiles, TheFirstFaultIsReported) {
  write("arm/meshes/bad.obj", "v 1 2\n");
  write("arm/meshes/worse.obj", "v 1\n");
  std::vector<Geometry> geometries(5);
  geometries[0].mesh = geometries[1].mesh = "../meshes/box.obj";
  geometries[2].mesh = "../meshes/bad.obj";
  geometries[3].mesh = "../meshes/worse.obj";
  geometries[4].mesh = "../meshes/none.obj";
  EXPECT_THAT(load(geometries).error().message, HasSubstr("bad.obj:1"));
  std::swap(geometries[0], geometries[4]);
  EXPECT_THAT(load(geometries).error().message, HasSubstr("none.obj"));
}

TEST_F(RobotFiles, ColladaIsReadInMetresAndInItsOwnAxes) {
  const std::vector<Point> corners = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0},
                                      {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}};
  const std::vector<std::vector<int>> sides = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                               {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  write("arm/meshes/box.dae", test::to_collada(corners, sides, "0.5", "Z_UP"));
  Geometry geometry;
  geometry.mesh = "package:///arm/meshes/box.dae";
  const Result<RobotParts> parts = load(geometry);
  if (!parts.ok() && parts.error().message.find("this build reads no") != std::string::npos) {
    GTEST_SKIP() << parts.error().message;
  }
  ASSERT_TRUE(parts.ok()) << parts.error().message;
  const Part& part = parts.value().parts.front();
  EXPECT_EQ(part.name, "arm/meshes/box.dae");
  EXPECT_EQ(part.mesh->prepared().report.upper, (Point{0.5, 1, 1.5}));
}

TEST_F(RobotFiles, FaultsNameLinkAndFile) {
  Geometry geometry;
  geometry.line = 7;
  geometry.mesh = "../meshes/none.obj";
  EXPECT_THAT(load(geometry).error().message, HasSubstr("arm.urdf:7: link \"link\": the mesh"));
  write("arm/meshes/part.dae", "<COLLADA/>");
  geometry.mesh = "../meshes/part.dae";
  EXPECT_THAT(load(geometry).error().message, HasSubstr("part.dae: "));
  write("arm/meshes/bad.obj", "v 1 2\n");
  geometry.mesh = "../meshes/bad.obj";
  EXPECT_THAT(load(geometry).error().message, HasSubstr("bad.obj:1"));
  geometry.mesh = "../meshes/box.obj";
  geometry.scale = {1e300, 1e300, 1e300};
  EXPECT_FALSE(load(geometry).ok());
  const Result<MeshPlaces> places = mesh_places("a.urdf", {});
  Robot robot;
  robot.links.push_back({"link", {}, {}});
  EXPECT_THAT(load_parts(robot, false, FacetSide::kInscribed, places.value(), "a.urdf").error().message,
              HasSubstr("no link has a <collision>; try --visual"));
}

}  // namespace
}  // namespace medial_vk
