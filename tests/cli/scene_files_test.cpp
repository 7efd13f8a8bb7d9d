// Scenes (glTF, 3MF, FBX, COLLADA) from outside: files, standard input, and the program in which assimp reads them,
// which may be missing, crash or write anything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "support/scenes/scene_files.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"
#include "tool_test.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;
using test::read_file;
using test::run_tool;
using test::ToolCall;
using test::ToolResult;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Coordinates are floats, as in glTF.
Mesh part() { return test::make_l_shape(2.0, 0.5, 0.75); }

std::string part_as_glb() { return test::to_gltf({{{part()}}}, {{"part", 0}}, test::GltfBuffer::kGlb).text; }

class SceneFiles : public test::ToolTest {
 protected:
  /// True if the build reads scenes; else the test is skipped.
  bool reads_scenes() {
    test::write_file(path("probe.glb"), part_as_glb());
    const ToolResult result = run_cpu({"probe.glb", "-o", "-"});
    fs::remove(path("probe.glb"));
    return result.err.find("this build reads no") == std::string::npos;
  }

  /// A call of a copy of the tool, which finds the reader of scenes only beside itself.
  ToolCall copied(const std::string& script) {
    fs::create_directory(path("bin"));
    fs::copy_file(test::tool_path(), path("bin/medial-vk"), fs::copy_options::overwrite_existing);
    if (!script.empty()) {
      test::write_file(path("bin/medial-vk-read-scene"), "#!/bin/sh\n" + script);
      ::chmod(path("bin/medial-vk-read-scene").c_str(), 0700);
    }
    test::write_file(path("part.glb"), part_as_glb());
    ToolCall call = cpu_call({"part.glb"});
    call.program = path("bin/medial-vk");
    return call;
  }
};

TEST_F(SceneFiles, ASceneGivesTheResultOfItsMesh) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  test::write_file(path("part.obj"), test::to_obj(part()));
  const ToolResult plain = run_cpu({"part.obj", "-o", "-"});
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  const test::GltfFile two_files = test::to_gltf({{{part()}}}, {{"part", 0}}, test::GltfBuffer::kBeside, "part.bin");
  test::write_file(path("part.bin"), two_files.buffer);
  const std::pair<const char*, std::string> files[] = {{"part.glb", part_as_glb()},
                                                       {"PART.GLTF", two_files.text},
                                                       {"part.3mf", test::to_3mf({{part(), ""}})},
                                                       {"part.fbx", test::to_fbx(part(), "part")}};
  for (const auto& [name, bytes] : files) {
    test::write_file(path(name), bytes);
    const ToolResult result = run_cpu({name, "-o", "-"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(result.out == plain.out) << name;
  }
}

TEST_F(SceneFiles, StandardInputIsRecognisedByItsContent) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  for (const std::string& bytes : {part_as_glb(), test::to_gltf({{{part()}}}, {{"part", 0}}).text,
                                   test::to_3mf({{part(), ""}}), test::to_fbx(part(), "part")}) {
    ToolCall streamed = cpu_call({"-"});
    streamed.standard_input = bytes;
    const ToolResult result = run_tool(streamed);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  EXPECT_THAT(folder_.names(), ElementsAre("stdin.medial.ply"));
}

TEST_F(SceneFiles, BrokenScenesAre3) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  const std::string glb = part_as_glb();
  for (const std::size_t size : {4ul, 20ul, 300ul, glb.size() - 1}) {
    test::write_file(path("part.glb"), glb.substr(0, size));
    const ToolResult result = run_cpu({"part.glb"});
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_THAT(result.err, HasSubstr("medial-vk: part.glb: assimp cannot read it as .glb: "));
  }
  EXPECT_THAT(folder_.names(), ElementsAre("part.glb"));
}

// assimp 5.2 crashes on a skin without bind matrices, which glTF permits.
TEST_F(SceneFiles, ACrashOfAssimpIsAnErrorOfTheFile) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  const std::vector<test::SceneNode> nodes = {{.name = "joint"},
                                              {.name = "skinned", .mesh = 0, .skin = 0, .has_bind_matrices = false}};
  test::write_file(path("skin.gltf"), test::to_gltf({{{part()}}}, nodes).text);
  const ToolResult result = run_cpu({"skin.gltf"});
  if (result.exit_code == 0) GTEST_SKIP() << "this assimp reads it";
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("medial-vk: skin.gltf: assimp failed on this .gltf file: it crashed ("));
  EXPECT_THAT(folder_.names(), ElementsAre("skin.gltf"));
}

TEST_F(SceneFiles, TheReaderMayFailInAnyWay) {
  const std::pair<const char*, const char*> ends[] = {
      {"kill -SEGV $$", "medial-vk: part.glb: assimp failed on this .glb file: it crashed (Segmentation fault)"},
      {"kill -XCPU $$", "it took too much time or memory"},
      {"exit 5", "it ended with exit code 5"},
      {"exit 0", "wrote something else"},
      {"cat", "wrote something else"},
      {"head -c 100000 /dev/zero; kill -ABRT $$", "it crashed (Aborted)"}};
  for (const auto& [script, message] : ends) {
    const ToolResult result = run_tool(copied(script));
    EXPECT_THAT(result.exit_code, testing::AnyOf(1, 3)) << script;
    EXPECT_THAT(result.err, HasSubstr(message)) << script;
    EXPECT_THAT(folder_.names(), Not(Contains("part.medial.ply")));
  }
}

TEST_F(SceneFiles, WhatTheReaderPrintsIsNoMessageOfTheTool) {
  const ToolResult result = run_tool(copied("echo secret >&2; exit 1"));
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, Not(HasSubstr("secret")));
}

TEST_F(SceneFiles, WithoutTheReaderOtherFormatsAreRead) {
  ToolCall call = copied("");
  const ToolResult missing = run_tool(call);
  EXPECT_EQ(missing.exit_code, 3);
  EXPECT_THAT(missing.err, HasSubstr("medial-vk: part.glb: the program medial-vk-read-scene is missing"));
  test::write_file(path("part.obj"), test::to_obj(part()));
  call.arguments[0] = "part.obj";
  EXPECT_EQ(run_tool(call).exit_code, 0);
}

TEST_F(SceneFiles, ARobotOfColladaWithAThirdSlash) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  fs::create_directories(path("arm/meshes"));
  const Mesh mesh = part();
  std::vector<std::vector<int>> faces;
  for (const Triangle& t : mesh.triangles) {
    faces.push_back({static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2])});
  }
  test::write_file(path("arm/meshes/part.dae"), test::to_collada(mesh.vertices, faces));
  test::write_file(path("arm/arm.urdf"),
                   "<robot name=\"arm\"><link name=\"a\"><collision><geometry><mesh "
                   "filename=\"package:///arm/meshes/part.dae\"/></geometry></collision></link></robot>");
  const ToolResult result = run(
      {"spheres", "arm/arm.urdf", "--count-per-link", "3", "--backend", "cpu", "--resolution", "12", "-o", "arm.csv"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read_file(path("arm.csv")), HasSubstr("\na,"));
}

}  // namespace
}  // namespace medial_vk
