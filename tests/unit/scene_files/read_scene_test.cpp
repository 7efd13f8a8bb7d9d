// Scenes by assimp: transformations, instances, reflections, polygons, files beside the scene, limits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "assimp_scenes/read_scene.h"
#include "medial_vk/prepare.h"
#include "support/scenes/scene_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;
using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

class ReadScene : public testing::Test {
 protected:
  void SetUp() override {
    const Result<std::vector<ScenePart>> any = read_scene({.bytes = "{", .name = "a", .format = "gltf", .path = ""});
    ASSERT_FALSE(any.ok());
    if (any.error().message.find("this build reads no") != std::string::npos) GTEST_SKIP() << any.error().message;
  }
};

std::vector<ScenePart> parts_of(const std::string& bytes, const std::string& format, const std::string& path = "") {
  const Result<std::vector<ScenePart>> parts =
      read_scene({.bytes = bytes, .name = "a", .format = format, .path = path});
  EXPECT_TRUE(parts.ok()) << parts.error().message;
  return parts.ok() ? parts.value() : std::vector<ScenePart>();
}

std::string message_of(const std::string& bytes, const std::string& format, const std::string& path = "") {
  const Result<std::vector<ScenePart>> parts =
      read_scene({.bytes = bytes, .name = "a", .format = format, .path = path});
  EXPECT_FALSE(parts.ok());
  if (parts.ok()) return {};
  EXPECT_EQ(parts.error().code, ErrorCode::kInvalidMesh);
  return parts.error().message;
}

/// What the tool finds in the mesh: closed, oriented outwards as it is, without faults.
MeshReport report_of(const Mesh& mesh) {
  const Result<PreparedMesh> prepared = prepare_mesh(mesh);
  EXPECT_TRUE(prepared.ok());
  if (!prepared.ok()) return {};
  const MeshReport& report = prepared.value().report;
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.reoriented_faces, 0u);
  EXPECT_FALSE(report.inside_out);
  EXPECT_EQ(report.intersecting_faces, 0u);
  return report;
}

SceneMesh box_mesh(const Point& size = {1, 2, 3}) { return {{make_box(size)}}; }

TEST_F(ReadScene, GltfInEachOfItsForms) {
  for (const GltfBuffer where : {GltfBuffer::kInside, GltfBuffer::kGlb}) {
    const GltfFile file = to_gltf({box_mesh()}, {{"box", 0}}, where);
    const std::vector<ScenePart> parts = parts_of(file.text, where == GltfBuffer::kGlb ? "glb" : "gltf");
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].name, "box");
    EXPECT_EQ(parts[0].mesh.vertices.size(), 8u);
    EXPECT_EQ(parts[0].mesh.triangles.size(), 12u);
    const MeshReport report = report_of(parts[0].mesh);
    EXPECT_EQ(report.upper, (Point{1, 2, 3}));
    EXPECT_EQ(report.signed_volume, 6);
  }
}

TEST_F(ReadScene, TransformationsOfAllNodesAboveAreApplied) {
  const double half = std::sqrt(0.5);
  const std::vector<SceneNode> nodes = {
      {.name = "far", .translation = {10, 20, 30}},
      {.name = "turned", .parent = 0, .rotation = {0, 0, half, half}},  // a quarter turn about z
      {.name = "box", .mesh = 0, .parent = 1, .translation = {1, 0, 0}, .scale = {2, 1, 1}}};
  const std::vector<ScenePart> parts = parts_of(to_gltf({box_mesh()}, nodes).text, "gltf");
  ASSERT_EQ(parts.size(), 1u);
  // The box from 1 to 3, 0 to 2 and 0 to 3 is turned to -2 to 0, 1 to 3 and 0 to 3, and moved.
  const MeshReport report = report_of(parts[0].mesh);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(report.lower[k], (Point{8, 21, 30}[k]), 1e-5);
    EXPECT_NEAR(report.upper[k], (Point{10, 23, 33}[k]), 1e-5);
  }
  EXPECT_NEAR(report.signed_volume, 12, 1e-4);
}

TEST_F(ReadScene, ReflectionsKeepFacesOutside) {
  for (const std::array<double, 3>& scale : {std::array<double, 3>{-1, 1, 1}, {-1, -1, 1}, {1, 1, -2}, {-1, -1, -1}}) {
    const std::vector<ScenePart> parts =
        parts_of(to_gltf({box_mesh()}, {{.name = "box", .mesh = 0, .scale = scale}}).text, "gltf");
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_GT(report_of(parts[0].mesh).signed_volume, 5);
  }
}

TEST_F(ReadScene, InstancesArePartsOfTheirOwnInTheOrderOfTheFile) {
  const std::vector<SceneNode> nodes = {{.name = "left", .mesh = 0},
                                        {.name = "child", .mesh = 1, .parent = 0, .translation = {0, 0, 9}},
                                        {.name = "right", .mesh = 0, .translation = {5, 0, 0}}};
  const std::vector<ScenePart> parts = parts_of(to_gltf({box_mesh(), box_mesh({2, 2, 2})}, nodes).text, "gltf");
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_THAT((std::vector<std::string>{parts[0].name, parts[1].name, parts[2].name}),
              ElementsAre("left", "child", "right"));
  EXPECT_EQ(report_of(parts[1].mesh).lower, (Point{0, 0, 9}));
  EXPECT_EQ(report_of(parts[2].mesh).lower, (Point{5, 0, 0}));
  const Result<Mesh> joined = join_parts(parts, "a");
  ASSERT_TRUE(joined.ok());
  const MeshReport report = report_of(joined.value());
  EXPECT_EQ(report.components, 3u);
  EXPECT_EQ(report.signed_volume, 6 + 8 + 6);
}

// Formats divide a surface by its materials: one closed surface must not become two open ones.
TEST_F(ReadScene, TheMaterialsOfAMeshAreOnePart) {
  const Mesh box = make_box({1, 2, 3});
  SceneMesh mesh = {{box, box}};
  mesh.primitives[0].triangles.resize(5);
  mesh.primitives[1].triangles.erase(mesh.primitives[1].triangles.begin(), mesh.primitives[1].triangles.begin() + 5);
  const std::vector<ScenePart> parts = parts_of(to_gltf({mesh}, {{"box", 0}}).text, "gltf");
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].mesh.vertices.size(), 8u);
  EXPECT_EQ(report_of(parts[0].mesh).signed_volume, 6);
}

TEST_F(ReadScene, LinesAndPointsAreNoFaces) {
  SceneMesh lines = box_mesh(), points = box_mesh();
  lines.mode = 1;
  points.mode = 0;
  const std::vector<SceneNode> nodes = {{"lines", 0}, {"box", 1}, {"points", 2}};
  const std::vector<ScenePart> parts = parts_of(to_gltf({lines, box_mesh(), points}, nodes).text, "gltf");
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].name, "box");
  EXPECT_EQ(parts[0].mesh.short_polygons, 0u);
  EXPECT_THAT(message_of(to_gltf({lines}, {{"lines", 0}}).text, "gltf"), HasSubstr("a: no faces (1 meshes)"));
}

// The mesh stands where its joint holds it; a transformation of its own node has no effect (glTF 2.0, 3.7.3.3).
TEST_F(ReadScene, SkinnedMeshesAreInThePoseOfTheirNodes) {
  const std::vector<SceneNode> nodes = {{.name = "joint", .translation = {7, 8, 9}},
                                        {.name = "skinned", .mesh = 0, .translation = {100, 0, 0}, .skin = 0}};
  const std::vector<ScenePart> parts = parts_of(to_gltf({box_mesh()}, nodes).text, "gltf");
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(report_of(parts[0].mesh).lower, (Point{7, 8, 9}));
}

TEST_F(ReadScene, ColladaInMetresAndInTheAxesOfTheFile) {
  // A prism over an L: its lids are polygons of six corners that are not convex.
  const std::vector<Point> vertices = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0},
                                       {0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 2, 1}, {0, 2, 1}};
  std::vector<std::vector<int>> polygons = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (int i = 0; i < 6; ++i) polygons.push_back({i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6});
  for (const char* up : {"Y_UP", "Z_UP", "X_UP"}) {
    const std::vector<ScenePart> parts = parts_of(to_collada(vertices, polygons, "1", up), "dae");
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].mesh.vertices.size(), 12u);
    EXPECT_EQ(parts[0].mesh.fallback_polygons, 0u);
    const MeshReport report = report_of(parts[0].mesh);
    EXPECT_EQ(report.signed_volume, 3);
    EXPECT_EQ(report.upper, (Point{2, 2, 1})) << up;
  }
  const std::vector<ScenePart> inches = parts_of(to_collada(vertices, polygons, "0.0254"), "dae");
  ASSERT_EQ(inches.size(), 1u);
  EXPECT_NEAR(report_of(inches[0].mesh).upper[0], 2 * 0.0254, 1e-8);
}

TEST_F(ReadScene, FbxInItsOwnUnits) {
  const std::vector<ScenePart> parts = parts_of(to_fbx(make_box({1, 2, 3}), "Box one", {5, 6, 7}, {-1, 1, 1}), "fbx");
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].name, "Box one");
  const MeshReport report = report_of(parts[0].mesh);
  EXPECT_EQ(report.lower, (Point{4, 6, 7}));
  EXPECT_EQ(report.upper, (Point{5, 8, 10}));
}

TEST_F(ReadScene, TheItemsOf3mfAreMovedAndInItsOwnUnits) {
  const Mesh box = make_box({1, 2, 3});
  for (const char* unit : {"millimeter", "inch"}) {
    const std::vector<ScenePart> parts =
        parts_of(to_3mf({{box, ""}, {box, "1 0 0 0 1 0 0 0 1 10 20 30"}}, unit), "3mf");
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(report_of(parts[0].mesh).upper, (Point{1, 2, 3})) << unit;
    EXPECT_EQ(report_of(parts[1].mesh).lower, (Point{10, 20, 30}));
  }
}

// ---- Files beside a scene

class ScenesOnDisk : public ReadScene {
 protected:
  ScenesOnDisk() : folder_(fs::temp_directory_path() / ("medial-vk-scene-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_ / "in/below");
    fs::create_directories(folder_ / "inner");
  }
  ~ScenesOnDisk() override { fs::remove_all(folder_); }

  /// A scene in the folder `in` whose buffer is at `place`, from the folder of the test, and which calls it `uri`.
  std::string scene_with(const std::string& uri, const std::string& place) {
    const GltfFile file = to_gltf({box_mesh()}, {{"box", 0}}, GltfBuffer::kBeside, uri);
    if (!place.empty()) std::ofstream(folder_ / place, std::ios::binary) << file.buffer;
    return file.text;
  }
  std::string path() const { return (folder_ / "in/scene.gltf").string(); }

  fs::path folder_;
};

TEST_F(ScenesOnDisk, ABufferBesideOrBelowTheSceneIsRead) {
  EXPECT_EQ(parts_of(scene_with("scene.bin", "in/scene.bin"), "gltf", path()).size(), 1u);
  EXPECT_EQ(parts_of(scene_with("below/b.bin", "in/below/b.bin"), "gltf", path()).size(), 1u);
  EXPECT_EQ(parts_of(scene_with("below/../b.bin", "in/b.bin"), "gltf", path()).size(), 1u);
  EXPECT_EQ(parts_of(scene_with("a%20b.bin", "in/a b.bin"), "gltf", path()).size(), 1u);
}

TEST_F(ScenesOnDisk, FilesOutsideOfTheFolderAreNotRead) {
  const std::string outside =
      "a: assimp cannot read it as .gltf: it names the file \"b.bin\", which is outside of its folder";
  EXPECT_EQ(message_of(scene_with("../b.bin", "b.bin"), "gltf", path()), outside);
  // A folder whose name begins with that of the scene's folder.
  EXPECT_EQ(message_of(scene_with("../inner/b.bin", "inner/b.bin"), "gltf", path()), outside);
  const std::string absolute = (folder_ / "b.bin").string();
  EXPECT_THAT(message_of(scene_with(absolute, "b.bin"), "gltf", path()), HasSubstr("it names the file \"b.bin\""));
  EXPECT_THAT(message_of(scene_with("file://" + absolute, "b.bin"), "gltf", path()), HasSubstr("it names the file"));
  scene_with("x", "b.bin");
  fs::create_symlink(folder_ / "b.bin", folder_ / "in/b.bin");
  EXPECT_EQ(message_of(scene_with("b.bin", ""), "gltf", path()), outside);
  EXPECT_THAT(message_of(scene_with("none.bin", ""), "gltf", path()), HasSubstr("\"none.bin\", which is not there"));
  EXPECT_THAT(message_of(scene_with("below", ""), "gltf", path()), HasSubstr("\"below\", which is not there"));
  // A scene from standard input has no folder.
  EXPECT_THAT(message_of(scene_with("scene.bin", "in/scene.bin"), "gltf", ""), HasSubstr("has no folder"));
}

// ---- Limits and broken files

TEST_F(ReadScene, InstancesAreCountedBeforeTheyAreMade) {
  std::vector<SceneNode> nodes;
  for (int i = 0; i < 100; ++i) nodes.push_back({"box", 0});
  const std::string bytes = to_gltf({box_mesh()}, nodes).text;
  EXPECT_EQ(parts_of(bytes, "gltf").size(), 100u);
  const Result<std::vector<ScenePart>> parts =
      read_scene({.bytes = bytes, .name = "a", .format = "gltf", .path = "", .most_corners = 3599});
  ASSERT_FALSE(parts.ok());
  EXPECT_EQ(parts.error().message,
            "a: the faces of all meshes and their instances have more than 3599 corners, the most that are read");
}

TEST_F(ReadScene, ArchivesThatDeclareMoreThanTheLimitAreNotExpanded) {
  std::string bytes = to_3mf({{make_box({1, 2, 3}), ""}});
  EXPECT_EQ(parts_of(bytes, "3mf").size(), 1u);
  // The expanded length in the directory at the end, 24 bytes after the start of each entry: nearly 4 GiB each.
  int entries = 0;
  for (std::size_t at = bytes.find("PK\1\2"); at != std::string::npos; at = bytes.find("PK\1\2", at + 1), ++entries) {
    bytes.replace(at + 24, 4, "\xf0\xff\xff\xff");
  }
  ASSERT_EQ(entries, 3);
  EXPECT_EQ(message_of(bytes, "3mf"), "a: expands to more than 4096 MiB, the most that is read");
}

TEST_F(ReadScene, BrokenFilesAreErrors) {
  EXPECT_EQ(message_of("", "gltf"), "a: file is empty");
  for (const char* format : {"gltf", "glb", "3mf", "fbx", "dae", "blend", "none"}) {
    EXPECT_THAT(message_of("nothing of the kind", format),
                HasSubstr(std::string("a: assimp cannot read it as .") + format));
  }
  const std::string glb = to_gltf({box_mesh()}, {{"box", 0}}, GltfBuffer::kGlb).text;
  for (std::size_t size = 1; size < glb.size(); size += 97) EXPECT_NE(message_of(glb.substr(0, size), "glb"), "");
  std::string nan = glb;
  nan.replace(glb.rfind(std::string("BIN\0", 4)) + 4, 4, "\xff\xff\xff\x7f");
  EXPECT_EQ(message_of(nan, "glb"), "a: a coordinate of the mesh \"box\" is not finite");
}

}  // namespace
}  // namespace medial_vk
