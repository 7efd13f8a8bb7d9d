// Files that are no animation, are broken, or use what is not supported: an error each, and no other frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "motion_files/mesh_motion.h"
#include "support/device/device.h"
#include "unit/motion_files/animations.h"

namespace medial_vk {
namespace {

using namespace test;
using nlohmann::json;
using testing::HasSubstr;

Error error_of(const std::string& bytes, const AnimationOptions& options = {}, const std::string& name = "a.gltf") {
  const Result<std::unique_ptr<MeshMotion>> motion = parse_animation(bytes, name, "", options);
  EXPECT_FALSE(motion.ok());
  return motion.ok() ? Error() : motion.error();
}

/// The message of a file that a change has broken.
std::string message_of(const std::function<void(json&)>& change, AnimationWriter writer = skinned_animation()) {
  writer.gltf();
  change(writer.document);
  const Error error = error_of(writer.document.dump());
  EXPECT_EQ(error.code, ErrorCode::kInvalidMesh);
  return error.message;
}

AnimationWriter morphing() { return morphing_animation("LINEAR", {0, 1}, {0, 0, 1, 1}); }

TEST(AnimationErrors, OtherFilesHaveNoAnimation) {
  EXPECT_THAT(error_of(to_obj(animated_tetrahedron()), {}, "a.obj").message, HasSubstr("a.obj: it has no animation"));
  EXPECT_THAT(error_of("x", {}, "a.fbx").message, HasSubstr("read from glTF and GLB, not from .fbx: convert it"));
  EXPECT_EQ(message_of([](json& file) { file.erase("animations"); }),
            "a.gltf: it has no animation (3 nodes, 1 meshes, 1 skins)");
  EXPECT_EQ(error_of("").code, ErrorCode::kInvalidMesh);
}

TEST(AnimationErrors, TheAnimationIsChosenByNameOrNumber) {
  AnimationWriter writer = skinned_animation();
  writer.add_channel(0, "translation", {0, 2}, {5, 0, 0, 6, 0, 0}, "LINEAR", 1);
  writer.add_channel(0, "scale", {0, 4}, {1, 1, 1, 2, 2, 2}, "LINEAR", 2);
  writer.document["animations"][2]["name"] = "1";
  const std::string bytes = writer.glb();
  const std::string list = "1 \"bow\", 2, 3 \"1\"";
  EXPECT_EQ(error_of(bytes).code, ErrorCode::kUsage);
  EXPECT_EQ(error_of(bytes).message, "a.gltf: it has several animations, of which one must be chosen: " + list);
  for (const char* unknown : {"jump", "0", "4", "-1", "2x", "99999999999999999999999"}) {
    const Error error = error_of(bytes, {.animation = unknown});
    EXPECT_EQ(error.code, ErrorCode::kUsage);
    EXPECT_EQ(error.message, std::string("a.gltf: it has no animation \"") + unknown + "\"; it has " + list);
  }
  for (const auto& [choice, frames] : {std::pair{"bow", 2u}, {"2", 3u}, {"3", 5u}, {"1", 5u}}) {
    const auto motion = parse_animation(bytes, "a", "", {.animation = choice, .frames_per_second = 1});
    ASSERT_TRUE(motion.ok()) << motion.error().message;
    EXPECT_EQ(motion.value()->frame_count(), frames) << choice;
  }
}

TEST(AnimationErrors, AnAnimationThatMovesNothingIsRefused) {
  const std::string still = "a.gltf: the animation \"bow\" moves no vertex";
  // No channel; a node that carries nothing; equal keys.
  EXPECT_EQ(message_of([](json& file) { file["animations"][0].erase("channels"); }), still);
  EXPECT_EQ(message_of([](json& file) { file["animations"][0]["channels"][0]["target"]["node"] = 2; }), still);
  EXPECT_EQ(message_of([](json& file) { file["animations"][0]["channels"][0]["target"].erase("node"); }), still);
  EXPECT_THAT(message_of([](json&) {}, morphing_animation("STEP", {0, 1}, {1, 2, 1, 2})), HasSubstr("moves no vertex"));
  AnimationWriter tangents = morphing_animation("CUBICSPLINE", {0, 1}, {0, 0, 1, 2, 0, 1, 0, 0, 1, 2, 0, 0});
  EXPECT_TRUE(parse_animation(tangents.glb(), "a", "").ok()) << "tangents move vertices between equal keys";
}

TEST(AnimationErrors, NumbersOutOfRangeAreUsageErrors) {
  const std::string bytes = skinned_animation().glb();
  for (const AnimationOptions& options : std::vector<AnimationOptions>{{.frames_per_second = 0},
                                                                       {.frames_per_second = -1},
                                                                       {.frames_per_second = std::nan("")},
                                                                       {.frames_per_second = 1e7},
                                                                       {.frames = kMostFrames + 1},
                                                                       {.start = 2},
                                                                       {.start = .5, .end = .25},
                                                                       {.end = std::nan("")},
                                                                       {.end = HUGE_VAL}}) {
    EXPECT_EQ(error_of(bytes, options).code, ErrorCode::kUsage);
  }
}

TEST(AnimationErrors, WhatIsNotSupportedIsNamed) {
  EXPECT_THAT(message_of([](json& file) { file["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }),
              HasSubstr("it needs the extension \"KHR_draco_mesh_compression\", which is not supported"));
  EXPECT_THAT(message_of([](json& file) { file["asset"]["version"] = "1.0"; }), HasSubstr("its version is \"1.0\""));
  EXPECT_THAT(message_of([](json& file) { file["animations"][0]["channels"][0]["target"]["path"] = "visible"; }),
              HasSubstr("an animation moves \"visible\", which is not supported"));
  EXPECT_THAT(message_of([](json& file) { file["animations"][0]["samplers"][0]["interpolation"] = "BEZIER"; }),
              HasSubstr("the interpolation \"BEZIER\""));
  const auto point_to = [](const char* property) {
    return [=](json& file) {
      file["animations"][0]["channels"][0]["target"] = {
          {"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", property}}}}}};
    };
  };
  EXPECT_THAT(message_of(point_to("/nodes/1/rotation")), HasSubstr("moves \"/nodes/1/rotation\" by an extension"));
  EXPECT_THAT(message_of(point_to("/materials/0/emissiveFactor")), HasSubstr("moves no vertex"));
}

TEST(AnimationErrors, BrokenReferencesAreNamed) {
  const auto expect = [](const char* words, const std::function<void(json&)>& change) {
    EXPECT_THAT(message_of(change), HasSubstr(words));
  };
  expect("its JSON is broken", [](json& file) { file = json::array(); });
  expect("it has no scene", [](json& file) { file.erase("scenes"); });
  expect("element 7 of \"scenes\" is not there", [](json& file) { file["scene"] = 7; });
  expect("node 9 of 3 is not there", [](json& file) { file["scenes"][0]["nodes"] = {9}; });
  expect("the scene has node 1 twice", [](json& file) { file["scenes"][0]["nodes"] = {0, 1, 2}; });
  expect("node 1 has two parents", [](json& file) { file["nodes"][2]["children"] = {1}; });
  expect("a node is below itself", [](json& file) { file["nodes"][1]["children"] = {0}; });
  expect("node 3 of 3 is not there", [](json& file) { file["nodes"][1]["children"] = {3}; });
  expect("the translation of a node has not 3 numbers", [](json& file) { file["nodes"][0]["translation"] = {1, 2}; });
  expect("the rotation of a node has no direction", [](json& file) { file["nodes"][0]["rotation"] = {0, 0, 0, 0}; });
  expect("a number is missing", [](json& file) { file["nodes"][0]["scale"] = {1, "2", 3}; });
  expect("is no whole number", [](json& file) { file["nodes"][2]["mesh"] = -1; });
  expect("element 5 of \"meshes\" is not there", [](json& file) { file["nodes"][2]["mesh"] = 5; });
  expect("element 5 of \"skins\" is not there", [](json& file) { file["nodes"][2]["skin"] = 5; });
  expect("no faces (1 meshes)", [](json& file) { file["meshes"][0]["primitives"][0]["mode"] = 1; });
  expect("the mode 9", [](json& file) { file["meshes"][0]["primitives"][0]["mode"] = 9; });
  expect("a vertex follows a joint that is not there", [](json& file) { file["skins"][0]["joints"] = {0}; });
  expect("node 8 of 3 is not there", [](json& file) { file["skins"][0]["joints"] = {0, 8}; });
  expect("a skin has fewer matrices than joints", [](json& file) { file["skins"][0]["joints"] = {0, 1, 2}; });
  expect("joints without weights",
         [](json& file) { file["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0"); });
  expect("which has a matrix", [](json& file) {
    file["nodes"][1] = {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1}}};
  });
  expect("node 8 of 3 is not there", [](json& file) { file["animations"][0]["channels"][0]["target"]["node"] = 8; });
  expect("a sampler that is not there", [](json& file) { file["animations"][0]["channels"][0]["sampler"] = 1; });
  expect("two channels of an animation move the same", [](json& file) {
    json& channels = file["animations"][0]["channels"];
    channels.push_back(json(channels[0]));
  });
}

TEST(AnimationErrors, AccessorsStayWithinTheirBuffers) {
  const auto expect = [](const char* words, const std::function<void(json&)>& change) {
    EXPECT_THAT(message_of(change), HasSubstr(words));
  };
  expect("accessor 0 has the wrong type", [](json& file) { file["accessors"][0]["type"] = "VEC2"; });
  expect("an accessor ends behind its buffer view", [](json& file) { file["accessors"][0]["count"] = 5; });
  expect("too many elements", [](json& file) { file["accessors"][0]["count"] = 0xffffffffffffffffu; });
  expect("an accessor ends behind its buffer view", [](json& file) { file["accessors"][0]["byteOffset"] = 4; });
  expect("an accessor ends behind its buffer view",
         [](json& file) { file["accessors"][0]["byteOffset"] = 0xfffffffffffffff0u; });
  expect("a buffer view ends behind its buffer", [](json& file) { file["bufferViews"][0]["byteOffset"] = 1 << 20; });
  expect("a buffer view ends behind its buffer",
         [](json& file) { file["bufferViews"][0]["byteLength"] = 0xffffffffffffffffu; });
  expect("the stride of a buffer view is out of range", [](json& file) { file["bufferViews"][0]["byteStride"] = 4; });
  expect("the component type 7", [](json& file) { file["accessors"][0]["componentType"] = 7; });
  expect("bytes of the", [](json& file) { file["buffers"][0]["byteLength"] = 1 << 20; });
  expect("buffer 0 is no base64", [](json& file) { file["buffers"][0]["uri"] = "data:;base64,!"; });
  expect("buffer 0 has no bytes", [](json& file) { file["buffers"][0].erase("uri"); });
  expect("it names the file \"b.bin\", but has no folder", [](json& file) { file["buffers"][0]["uri"] = "b.bin"; });
  expect("an attribute has 3 values for 4 vertices", [](json& file) {
    file["accessors"][file["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"].get<std::size_t>()]["count"] = 3;
  });
  // A file of some thousand bytes that declares a shape of zeros for a hundred million vertices.
  expect("the most that are read of", [](json& file) {
    file["accessors"][0] = {{"componentType", 5126}, {"type", "VEC3"}, {"count", 100'000'000}};
  });
}

TEST(AnimationErrors, KeysAreTested) {
  const auto message = [](const std::vector<double>& times, const std::vector<double>& rotations) {
    AnimationWriter writer = skinned_animation();
    writer.document.erase("animations");
    writer.add_channel(1, "rotation", times, rotations);
    return message_of([](json&) {}, writer);
  };
  EXPECT_THAT(message({1, 0}, {0, 0, 0, 1, 0, 0, 1, 0}), HasSubstr("the times of a sampler decrease"));
  EXPECT_THAT(message({0, 1}, {0, 0, 0, 1, 0, 0, 0, 0}), HasSubstr("a key is a rotation of length 0"));
  EXPECT_THAT(message({0, 1}, {0, 0, 0, 1}), HasSubstr("a sampler has 4 values for 2 keys of 4"));
  EXPECT_THAT(message({}, {}), HasSubstr("a sampler has no keys"));
  EXPECT_THAT(message({0, HUGE_VAL}, {0, 0, 0, 1, 0, 0, 1, 0}), HasSubstr("a number of an accessor is not finite"));
  EXPECT_THAT(message_of([](json&) {}, morphing_animation("LINEAR", {0, 1}, {0, 0, 1})),
              HasSubstr("a sampler has 3 values for 2 keys of 2"));
  EXPECT_THAT(message_of([](json& file) { file["meshes"][0]["weights"] = {1}; }, morphing()),
              HasSubstr("there are 1 weights for 2 shapes"));
}

TEST(AnimationErrors, InstancesAreCounted) {
  AnimationWriter writer = skinned_animation();
  for (int i = 0; i < 99; ++i) {
    writer.document["scenes"][0]["nodes"].push_back(writer.document["nodes"].size());
    writer.document["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
  }
  // Each has 12 corners, 4 vertices and 16 weights.
  EXPECT_TRUE(parse_animation(writer.glb(), "a", "", {.most_values = 3200}).ok());
  EXPECT_THAT(error_of(writer.glb(), {.most_values = 3199}).message,
              HasSubstr("too many corners, vertices or weights"));
}

TEST(AnimationErrors, CutAndAlteredFilesAreErrorsOrAnimations) {
  const std::string glb = skinned_animation().glb();
  for (std::size_t size = 0; size < glb.size(); size += 13) error_of(glb.substr(0, size));
  std::uint64_t read = 0;
  for (std::size_t at = 12; at < glb.size(); at += 3) {
    for (const char value : {'\0', '\xff', '9', '}'}) {
      std::string altered = glb;
      altered[at] = value;
      const auto motion = parse_animation(altered, "a.glb", "", {.frames = 3});
      if (!motion.ok()) continue;
      ++read;
      MotionFrame frame;
      for (std::uint64_t i = 0; i < 3; ++i) {
        if (motion.value()->read_frame(i, frame).ok()) {
          EXPECT_EQ(frame.positions.size(), motion.value()->rest().vertices.size());
        }
      }
    }
  }
  EXPECT_GT(read, 0u);
}

TEST(AnimationErrors, DeepJsonIsReadWithoutRecursion) {
  const std::string deep = std::string(100'000, '[');
  EXPECT_THAT(error_of("{\"asset\":{\"version\":\"2.0\"},\"x\":" + deep).message, HasSubstr("its JSON is broken"));
  const std::string closed = "{\"asset\":{\"version\":\"2.0\"},\"x\":" + deep + std::string(100'000, ']') + "}";
  EXPECT_THAT(error_of(closed).message, HasSubstr("it has no animation"));
}

TEST(AnimationErrors, DeepJsonIsNotKeptForACopy) {
  // The brackets of a string do not count, nor does a quotation mark within it end it.
  const auto file_of = [](std::size_t levels) {
    const std::string extras = std::string(levels, '[') + R"("\"[[{\\")" + std::string(levels, ']');
    std::string text = skinned_animation().gltf();
    return text.insert(1, "\"extras\":" + extras + ",");
  };
  const AnimationOptions kept = {.keep_source = true};
  const std::size_t most = kMostSourceLevels - 1;  // within the object of the document
  EXPECT_TRUE(parse_animation(file_of(most), "a.gltf", "", kept).ok());
  const Error error = error_of(file_of(most + 1), kept);
  EXPECT_EQ(error.code, ErrorCode::kInvalidMesh);
  EXPECT_EQ(error.message, "a.gltf: its JSON is nested 513 levels deep; scenes are copied up to 512");
  EXPECT_THAT(error_of(file_of(300'000), kept).message, HasSubstr("nested 300001 levels deep"));
  EXPECT_TRUE(parse_animation(file_of(300'000), "a.gltf", "").ok());
}

TEST(AnimationErrors, BuffersBesideTheFileAreReadFromItsFolderOnly) {
  const test::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  std::filesystem::create_directories(folder / "in");
  AnimationWriter writer = skinned_animation();
  const auto write = [&](const std::string& uri) {
    writer.document["buffers"] = {{{"byteLength", writer.buffer.size()}, {"uri", uri}}};
    std::ofstream(folder / "in/a.gltf") << writer.document.dump();
    return open_animation((folder / "in/a.gltf").generic_string());
  };
  std::ofstream(folder / "in/my buffer.bin", std::ios::binary) << writer.buffer;
  std::ofstream(folder / "b.bin", std::ios::binary) << writer.buffer;
  EXPECT_TRUE(write("my%20buffer.bin").ok());
  for (const auto& [uri, words] : {std::pair{"../b.bin", "\"b.bin\", which is outside of its folder"},
                                   {"c.bin", "\"c.bin\", which is not there"}}) {
    const auto motion = write(uri);
    ASSERT_FALSE(motion.ok());
    EXPECT_THAT(motion.error().message, HasSubstr(std::string("a.gltf: it names the file ") + words));
  }
}

}  // namespace
}  // namespace medial_vk
