// Scenes (glTF, 3MF, FBX, COLLADA) from outside: files, standard input, and the program in which assimp reads them,
// which may be missing, crash or write anything.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "paths.h"
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
#if defined(MEDIAL_VK_SANITIZED)
  const char* const end = "it ended with exit code 1";  // The sanitizer catches the signal.
#else
  const char* const end = "it crashed (";
#endif
  EXPECT_THAT(result.err, HasSubstr(std::string("medial-vk: skin.gltf: assimp failed on this .gltf file: ") + end));
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

// ---- --each

/// Three nodes: two of one name, one without a name of the file's own.
std::string three_parts(const Mesh& last) {
  return test::to_gltf({{{part()}}, {{test::make_box({1, 2, 3})}}, {{last}}},
                       {{.name = "an L/1", .mesh = 0}, {.name = "box", .mesh = 1}, {.name = "Box", .mesh = 2}})
      .text;
}

TEST_F(SceneFiles, EachWritesTheFilesOfEveryMesh) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  test::write_file(path("s.gltf"), three_parts(test::make_box({2, 2, 2})));
  const ToolResult result = run_cpu({"s.gltf", "--each", "--report", "r.json", "--medial-mesh", "m.ma", "--check"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(folder_.names(),
              ElementsAre("m.Box-2.ma", "m.an_L_1.ma", "m.box.ma", "r.Box-2.json", "r.an_L_1.json", "r.box.json",
                          "s.Box-2.medial.ply", "s.an_L_1.medial.ply", "s.box.medial.ply", "s.gltf"));
  EXPECT_THAT(read_file(path("r.Box-2.json")), HasSubstr("\"part\": \"Box-2\""));
  EXPECT_THAT(read_file(path("r.Box-2.json")), HasSubstr("\"output\": \"s.Box-2.medial.ply\""));
  EXPECT_THAT(result.err, HasSubstr("s.gltf: an_L_1: "));
  EXPECT_THAT(result.out, HasSubstr("an_L_1:\ncondition"));
  EXPECT_THAT(result.out, HasSubstr("Box-2:\ncondition"));
  // Each is what the mesh alone gives.
  test::write_file(path("l.obj"), test::to_obj(part()));
  const ToolResult alone = run_cpu({"l.obj", "-o", "-"});
  EXPECT_TRUE(alone.out == read_file(path("s.an_L_1.medial.ply")));
  // Without --each they are one solid, and the report has no such key.
  EXPECT_EQ(run_cpu({"s.gltf", "--report", "r.json"}).exit_code, 0);
  EXPECT_THAT(read_file(path("r.json")), Not(HasSubstr("\"part\"")));
}

TEST_F(SceneFiles, EachOfAFileWithOneMeshIsOneResult) {
  test::write_file(path("l.obj"), test::to_obj(part()));
  const ToolResult result = run_cpu({"l.obj", "--each", "-o", "out.csv"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(folder_.names(), ElementsAre("l.obj", "out.1.csv"));
}

TEST_F(SceneFiles, AnErrorInOneMeshLeavesNoFileOfAny) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  Mesh sheet = test::make_box({1, 1, 1});
  sheet.triangles.resize(1);
  test::write_file(path("s.gltf"), three_parts(sheet));
  const ToolResult result = run_cpu({"s.gltf", "--each"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("medial-vk: mesh 3 of 3, Box-2: s.gltf: "));
  EXPECT_THAT(result.err, HasSubstr("; nothing was written"));
  EXPECT_THAT(folder_.names(), ElementsAre("s.gltf"));
}

TEST_F(SceneFiles, AFileOfEachThatCannotBeWrittenIsReportedBeforeTheWork) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  test::write_file(path("s.gltf"), three_parts(test::make_box({2, 2, 2})));
  fs::create_directory(path("s.box.medial.ply"));
  const ToolResult result = run_cpu({"s.gltf", "--each"});
  EXPECT_EQ(result.exit_code, 6);
  EXPECT_THAT(result.err, HasSubstr("s.box.medial.ply"));
  EXPECT_THAT(result.err, Not(HasSubstr("triangles")));
  EXPECT_THAT(folder_.names(), ElementsAre("s.box.medial.ply", "s.gltf"));
}

TEST_F(SceneFiles, AResultOfEachNeverReplacesTheInput) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  const std::string glb = test::to_gltf({{{part()}}}, {{"part", 0}}, test::GltfBuffer::kGlb).text;
  test::write_file(path("s.part.glb"), glb);
  const ToolResult result = run_cpu({"s.part.glb", "--each", "-o", "s.glb"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--output would overwrite the input s.part.glb"));
  EXPECT_TRUE(read_file(path("s.part.glb")) == glb);
}

TEST_F(SceneFiles, SpheresOfEachMesh) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  test::write_file(path("s.gltf"), three_parts(test::make_box({2, 2, 2})));
  const std::vector<std::string> goal = {"spheres", "s.gltf", "--count", "2", "--backend", "cpu", "--resolution", "12"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), goal.begin(), goal.end());
    return run(more);
  };
  const ToolResult result = with({"--each", "--report", "r.json", "--check"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(folder_.names(), ElementsAre("r.Box-2.json", "r.an_L_1.json", "r.box.json", "s.Box-2.spheres.csv",
                                           "s.an_L_1.spheres.csv", "s.box.spheres.csv", "s.gltf"));
  EXPECT_THAT(read_file(path("r.box.json")), HasSubstr("\"mesh\": \"box\""));
  EXPECT_THAT(read_file(path("r.box.json")), HasSubstr("\"part\": \"box\""));
  EXPECT_THAT(result.out, HasSubstr("Box-2:\ncondition"));
  // Without --each it is one set for all.
  EXPECT_EQ(with({"-o", "all.csv"}).exit_code, 0);
  EXPECT_EQ(with({"--each", "-o", "-"}).exit_code, 2);
  test::write_file(path("a.urdf"), "<robot name=\"a\"/>");
  const ToolResult robot = run({"spheres", "a.urdf", "--each", "--total", "3"});
  EXPECT_EQ(robot.exit_code, 2);
  EXPECT_THAT(robot.err, HasSubstr("--each is about the meshes of a scene"));
}

TEST_F(SceneFiles, AnErrorInOneMeshLeavesNoSpheresOfAny) {
  if (!reads_scenes()) GTEST_SKIP() << "built without assimp";
  Mesh sheet = test::make_box({1, 1, 1});
  sheet.triangles.resize(1);
  test::write_file(path("s.gltf"), three_parts(sheet));
  const ToolResult result = run({"spheres", "s.gltf", "--each", "--count", "2", "--backend", "cpu"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("medial-vk: mesh 3 of 3, Box-2: s.gltf: "));
  EXPECT_THAT(folder_.names(), ElementsAre("s.gltf"));
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
