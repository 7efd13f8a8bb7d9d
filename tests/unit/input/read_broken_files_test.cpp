// Files that are truncated, altered or have a false size: a mesh or a message, never a crash, a hang or a huge
// allocation.
#include <gtest/gtest.h>

#include <random>

#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

struct Sample {
  const char* name;
  std::string bytes;
};

std::vector<Sample> all_formats() {
  Mesh mesh = make_box({1, 2, 3});
  rotate(mesh, {1, 1, 0}, 0.5);
  return {{"a.obj", to_obj(mesh)},
          {"a.off", to_off(mesh)},
          {"a.ply", to_ascii_ply(mesh)},
          {"a.ply", to_binary_ply(mesh, false)},
          {"a.ply", to_binary_ply(mesh, true)},
          {"a.stl", to_ascii_stl(mesh)},
          {"a.stl", to_binary_stl(mesh)}};
}

void expect_mesh_or_message(const std::string& bytes, const char* name) {
  Result<Mesh> mesh = parse_mesh(bytes, name);
  if (!mesh.ok()) {
    EXPECT_EQ(mesh.error().code, ErrorCode::kInvalidMesh) << mesh.error().message;
    EXPECT_EQ(mesh.error().message.rfind(name, 0), 0u) << mesh.error().message;
    return;
  }
  ASSERT_FALSE(mesh.value().triangles.empty());
  const Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh.value()));
  if (!prepared.ok()) {
    EXPECT_EQ(prepared.error().code, ErrorCode::kInvalidMesh) << prepared.error().message;
    return;
  }
  EXPECT_EQ(prepared.value().flags.size(), prepared.value().mesh.triangles.size());
}

TEST(ReadBrokenFiles, CutAtEveryByte) {
  for (const Sample& sample : all_formats()) {
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      expect_mesh_or_message(sample.bytes.substr(0, size), sample.name);
    }
  }
}

TEST(ReadBrokenFiles, BytesAltered) {
  std::mt19937 random(1);
  for (const Sample& sample : all_formats()) {
    for (int i = 0; i < 3000; ++i) {
      std::string bytes = sample.bytes;
      for (int changes = 1 + i % 4; changes > 0; --changes) {
        const char* const usual = "0123456789-+.eE/\\# \n\r\tfvnaninf";
        const bool any = random() % 2 == 0;
        bytes[random() % bytes.size()] = any ? static_cast<char>(random()) : usual[random() % 30];
      }
      expect_mesh_or_message(bytes, sample.name);
    }
  }
}

TEST(ReadBrokenFiles, HugeCountsAreRefusedAtOnce) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::string list = "property list uchar int vertex_indices\nend_header\n";
  for (const std::string count : {"1099511627776", "4294967295", "9223372036854775807", "100"}) {
    for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      const std::string start = "ply\nformat " + format + " 1.0\n";
      expect_mesh_or_message(start + "element vertex " + count + "\n" + xyz + "element face 1\n" + list, "a.ply");
      const Result<Mesh> faces = parse_mesh(
          start + "element vertex 3\n" + xyz + "element face " + count + "\n" + list + std::string(36, '0'), "a.ply");
      ASSERT_FALSE(faces.ok());
      EXPECT_NE(faces.error().message.find("declares " + count), std::string::npos) << faces.error().message;
    }
    for (const std::string& off : {"OFF\n" + count + " 1 0\n0 0 0\n", "OFF\n1 " + count + " 0\n0 0 0\n",
                                   "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n" + count + " 0 1 2\n"}) {
      const Result<Mesh> mesh = parse_mesh(off, "a.off");
      ASSERT_FALSE(mesh.ok());
      EXPECT_NE(mesh.error().message.find("declares "), std::string::npos) << mesh.error().message;
    }
  }
  EXPECT_FALSE(parse_mesh("OFF\n99999999999999999999999 1 0\n", "a.off").ok());
  std::string stl(84, '\0');
  stl.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_FALSE(parse_mesh(stl, "a.stl").ok());
  // A list whose length is beyond the file, in binary: 2^32 - 1 corners.
  std::string list_length = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + xyz +
                            "element face 1\nproperty list uint int vertex_indices\nend_header\n";
  list_length += std::string(12, '\0') + "\xff\xff\xff\xff" + "abcd";
  const Result<Mesh> mesh = parse_mesh(list_length, "a.ply");
  ASSERT_FALSE(mesh.ok());
  EXPECT_NE(mesh.error().message.find("a list of 4294967295 values is longer than the rest"), std::string::npos);
}

}  // namespace
}  // namespace medial_vk
