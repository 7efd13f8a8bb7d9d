// The formats that assimp reads, and the bytes in which the program that reads scenes hands meshes over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "scene_files/scene_formats.h"
#include "scene_files/scene_parts.h"
#include "support/scenes/scene_files.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

TEST(SceneFormats, ByContentAndElseByExtension) {
  EXPECT_EQ(scene_format_of("glTF\2", "standard input"), "glb");
  EXPECT_EQ(scene_format_of("glTF\2", "part.stl"), "glb");
  EXPECT_EQ(scene_format_of("Kaydara FBX Binary  ", "x"), "fbx");
  EXPECT_EQ(scene_format_of("PK\3\4", "standard input"), "3mf");
  EXPECT_EQ(scene_format_of("PK\3\4", "a.zae"), "zae");
  EXPECT_EQ(scene_format_of("\xef\xbb\xbf<?xml version=\"1.0\"?>\n<COLLADA>", "-"), "dae");
  EXPECT_EQ(scene_format_of(" {\"scene\":0,\"asset\":{}}", "-"), "gltf");
  for (const char* name : {"a.GLTF", "a.glb", "a.3mf", "a.Fbx", "a.dae", "a.3ds", "a.x3d", "a.blend"}) {
    EXPECT_NE(scene_format_of("anything", name), "") << name;
  }
  EXPECT_EQ(scene_format_of("anything", "a.GLTF"), "gltf");
}

TEST(SceneFormats, TheFormatsOfTheToolAreNotAmongThem) {
  const Mesh box = make_box({1, 2, 3});
  for (const std::string& bytes :
       {to_obj(box), to_off(box), to_ascii_ply(box), to_binary_ply(box, true), to_ascii_stl(box), to_binary_stl(box)}) {
    for (const char* name : {"a.obj", "a.ply", "a.stl", "a.off", "a", "standard input", "a.xyz"}) {
      EXPECT_EQ(scene_format_of(bytes, name), "");
    }
  }
  EXPECT_EQ(scene_format_of("", "a"), "");
  EXPECT_EQ(scene_format_of("  \n", "a"), "");
  EXPECT_EQ(scene_format_of("{}", "a.json"), "");
}

std::vector<ScenePart> two_parts() {
  std::vector<ScenePart> parts = {{"first", make_box({1, 2, 3})}, {std::string("\0\xff", 2), make_box({4, 5, 6})}};
  parts[1].mesh.short_polygons = 7;
  parts[1].mesh.fallback_polygons = 8;
  return parts;
}

TEST(SceneBytes, PartsComeBackAsTheyWere) {
  const std::vector<ScenePart> parts = two_parts();
  const Result<std::vector<ScenePart>> back = decode_scene(encode_scene(parts));
  ASSERT_TRUE(back.ok()) << back.error().message;
  ASSERT_EQ(back.value().size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.value()[i].name, parts[i].name);
    EXPECT_EQ(back.value()[i].mesh.vertices, parts[i].mesh.vertices);
    EXPECT_EQ(back.value()[i].mesh.triangles, parts[i].mesh.triangles);
    EXPECT_EQ(back.value()[i].mesh.short_polygons, parts[i].mesh.short_polygons);
    EXPECT_EQ(back.value()[i].mesh.fallback_polygons, parts[i].mesh.fallback_polygons);
  }
}

TEST(SceneBytes, ErrorsComeBackWithTheirKind) {
  for (const ErrorCode code : {ErrorCode::kInvalidMesh, ErrorCode::kOutOfMemory}) {
    const Result<std::vector<ScenePart>> back = decode_scene(encode_scene(Error{code, "a: no"}));
    ASSERT_FALSE(back.ok());
    EXPECT_EQ(back.error().code, code);
    EXPECT_EQ(back.error().message, "a: no");
  }
  EXPECT_EQ(decode_scene(encode_scene(Error{ErrorCode::kNoDevice, "a"})).error().code, ErrorCode::kInternal);
}

TEST(SceneBytes, NoOtherBytesAreTrusted) {
  const std::string bytes = encode_scene(two_parts());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Result<std::vector<ScenePart>> cut = decode_scene(std::string_view(bytes).substr(0, size));
    ASSERT_FALSE(cut.ok()) << size;
    EXPECT_EQ(cut.error().code, ErrorCode::kInternal);
  }
  EXPECT_FALSE(decode_scene(bytes + "x").ok());
  const auto with = [](auto change) {
    std::vector<ScenePart> parts = two_parts();
    change(parts[1].mesh);
    return decode_scene(encode_scene(parts));
  };
  EXPECT_FALSE(with([](Mesh& mesh) { mesh.triangles[3][1] = 8; }).ok());
  EXPECT_FALSE(with([](Mesh& mesh) { mesh.vertices[2][1] = std::numeric_limits<double>::quiet_NaN(); }).ok());
  EXPECT_TRUE(with([](Mesh& mesh) { mesh.triangles[3][1] = 7; }).ok());
  // Every length in turn becomes one that no memory holds.
  for (std::size_t at = 0; at + 8 <= bytes.size(); ++at) {
    std::string lie = bytes;
    lie.replace(at, 8, std::string(7, '\xff') + "\x3f");
    if (const Result<std::vector<ScenePart>> back = decode_scene(lie); back.ok()) {
      EXPECT_EQ(back.value().size(), 2u);
    }
  }
}

TEST(SceneBytes, PartsAreJoinedInTheirOrder) {
  const Result<Mesh> joined = join_parts(two_parts(), "a");
  ASSERT_TRUE(joined.ok());
  EXPECT_EQ(joined.value().vertices.size(), 16u);
  EXPECT_EQ(joined.value().triangles.size(), 24u);
  const Triangle t = two_parts()[1].mesh.triangles[0];
  EXPECT_EQ(joined.value().triangles[12], (Triangle{t[0] + 8, t[1] + 8, t[2] + 8}));
  EXPECT_EQ(joined.value().short_polygons, 7u);
  EXPECT_EQ(joined.value().fallback_polygons, 8u);
}

}  // namespace
}  // namespace medial_vk
