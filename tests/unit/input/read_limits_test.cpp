// Input that is designed to keep a program busy or to fill its memory: read in time that grows with its size, or
// refused at once.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "mesh/clean_mesh.h"
#include "mesh/mesh_topology.h"
#include "mesh/surface_parts.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

/// Fails if a scope takes longer than any machine needs for linear work on its input, a sanitizer included.
class Promptly {
 public:
  Promptly() = default;
  Promptly(const Promptly&) = delete;
  Promptly& operator=(const Promptly&) = delete;
  ~Promptly() {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_;
    EXPECT_LT(taken.count(), 300);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Mesh box() { return make_box({1, 2, 3}); }

/// `text` with `line` inserted before the first `where`.
std::string with_line(std::string text, const std::string& where, const std::string& line) {
  return text.insert(text.find(where), line);
}

// ---- Long lines: no line is stored, so there is no limit to its length.

constexpr std::size_t kLong = 100'000'000;

TEST(ReadLimits, LinesOfAHundredMegabytes) {
  const Promptly promptly;
  const std::string words(kLong, 'x');
  EXPECT_TRUE(parse_mesh(with_line(to_obj(box()), "f ", "o " + words + "\n"), "a.obj").ok());
  EXPECT_TRUE(parse_mesh(with_line(to_off(box()), "0 0 0\n", "# " + words + "\n"), "a.off").ok());
  EXPECT_TRUE(parse_mesh(with_line(to_ascii_ply(box()), "element", "comment " + words + "\n"), "a.ply").ok());
  EXPECT_TRUE(parse_mesh(with_line(to_ascii_stl(box()), "endsolid", words + "\n"), "a.stl").ok());
}

TEST(ReadLimits, OneWordOfAHundredMegabytes) {
  const Promptly promptly;
  const std::string word(kLong, '7');
  for (const std::string& start : {std::string("v 1 2 3\nf 1 1 "), std::string("v 1 2 ")}) {
    const Result<Mesh> mesh = parse_mesh(start + word, "a.obj");
    ASSERT_FALSE(mesh.ok());
    EXPECT_LT(mesh.error().message.size(), 200u);
  }
  // All of its digits count: it is between 0.1 and 0.2.
  const Result<Mesh> mesh = parse_mesh("v 0 0 0\nv 1 0 0\nv 0 0.1" + word + " 0\nf 1 2 3\n", "a.obj");
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh.value().vertices[2][1], 0.17777777777777777777777777);
  // A type, a name and a keyword of a header.
  for (const char* start : {"ply\nformat ", "ply\nelement ", "ply\nelement a 1\nproperty ", "ply\n"}) {
    const Result<Mesh> ply = parse_mesh(start + word, "a.ply");
    ASSERT_FALSE(ply.ok());
    EXPECT_LT(ply.error().message.size(), 200u);
  }
}

TEST(ReadLimits, LinesContinuedAMillionTimes) {
  const Promptly promptly;
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2";
  for (int i = 0; i < 1'000'000; ++i) text += " \\\n";
  const Result<Mesh> mesh = parse_mesh(text + " 3\n", "a.obj");
  ASSERT_TRUE(mesh.ok()) << mesh.error().message;
  EXPECT_EQ(mesh.value().triangles.size(), 1u);
}

// ---- Declared counts

TEST(ReadLimits, CountsBeyondSixtyThreeBits) {
  for (const std::string count : {"9223372036854775808", "18446744073709551616", "-1", "1e9", "0x10"}) {
    const Result<Mesh> ply = parse_mesh("ply\nformat ascii 1.0\nelement vertex " + count + "\n", "a.ply");
    ASSERT_FALSE(ply.ok());
    EXPECT_EQ(ply.error().message, "a.ply:3: \"" + count + "\" is no count of \"vertex\" elements");
    const Result<Mesh> off = parse_mesh("OFF\n" + count + " 1 0\n0 0 0\n", "a.off");
    ASSERT_FALSE(off.ok());
    EXPECT_EQ(off.error().message, "a.off:2: \"" + count + "\" where a count of vertices or faces should be");
  }
}

TEST(ReadLimits, ListsOfAnyLengthThatTheFileDoesNotHold) {
  const std::string start =
      "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty char x\nproperty char y\n"
      "property char z\nelement face 1\nproperty list uint64 uchar vertex_indices\nend_header\n";
  for (const std::uint64_t length : {1ull << 40, 1ull << 63, ~0ull, 5ull}) {
    const Result<Mesh> mesh = parse_mesh(start + std::string(3, '\0') + bytes_of(length, true) + "\0\0\0", "a.ply");
    ASSERT_FALSE(mesh.ok()) << length;
    EXPECT_NE(mesh.error().message.find("a list "), std::string::npos) << mesh.error().message;
  }
  // Elements without properties occupy no bytes: any number of them is present.
  const std::string nothing = with_line(to_ascii_ply(box()), "element", "element nothing 9223372036854775807\n");
  EXPECT_TRUE(parse_mesh(nothing, "a.ply").ok());
}

// ---- Files that are too long for any mesh

TEST(ReadLimits, FilesUpToTheLimitAreRead) {
  const std::string path = testing::TempDir() + "medial_vk_limit.obj";
  const std::string bytes = to_obj(box());
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_TRUE(read_mesh(path).ok());
  EXPECT_TRUE(read_mesh(path, bytes.size()).ok());
  EXPECT_FALSE(read_mesh(path, bytes.size() - 1).ok());
  std::filesystem::resize_file(path, kMostFileBytes + 1);  // occupies no blocks; refused before a byte is read
  const Result<Mesh> mesh = read_mesh(path);
  ASSERT_FALSE(mesh.ok());
  EXPECT_EQ(mesh.error().message, path + ": longer than 4096 MiB, the most that is read");
  std::filesystem::remove(path);
}

// ---- Tangles

/// An OBJ of one polygon: its first half on a line, its second anywhere.
std::string tangled_polygon(int corners) {
  std::mt19937 random(1);
  std::string vertices, face = "f";
  for (int i = 0; i < corners; ++i) {
    const auto any = [&] { return std::to_string(1 + random() % 100'000); };
    vertices += i < corners / 2 ? "v " + std::to_string(i) + " 0 0\n" : "v " + any() + " " + any() + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  return vertices + face + "\n";
}

// Formerly cubic in its length: 12 s for 8000 corners.
TEST(ReadLimits, ATangledPolygonBecomesAFan) {
  const Promptly promptly;
  const Result<Mesh> mesh = parse_mesh(tangled_polygon(50'000), "a.obj");
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh.value().fallback_polygons, 1u);
  EXPECT_EQ(mesh.value().triangles.size(), 49'998u);
}

/// `pages` triangles, or pairs of them back to back, around one side.
Mesh open_book(int pages, bool back_to_back) {
  Mesh mesh = box();
  const auto spine = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 5}, {0, 0, 6}});
  for (int i = 0; i < pages; ++i) {
    const double angle = 6.28 * i / pages;
    const auto tip = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back({std::cos(angle), std::sin(angle), 5.5});
    mesh.triangles.push_back({spine, spine + 1, tip});
    if (back_to_back) mesh.triangles.push_back({spine, tip, spine + 1});
  }
  return mesh;
}

// Formerly quadratic in their number.
TEST(ReadLimits, FourHundredThousandFacesAroundOneSide) {
  for (const bool back_to_back : {false, true}) {
    const Promptly promptly;
    PreparedMesh prepared;
    prepared.mesh = open_book(400'000, back_to_back);
    clean_mesh(prepared);
    EXPECT_EQ(prepared.report.duplicates_dropped, back_to_back ? 400'000u : 0u);
    const SurfaceParts parts = find_parts(prepared.mesh, MeshTopology(prepared.mesh));
    EXPECT_EQ(parts.components, 2u);
    EXPECT_EQ(parts.patches, 400'001u);
  }
}

// Formerly quadratic in their number, since every face was examined from every other: 9 s for 10,000.
TEST(ReadLimits, AHundredThousandFacesThatAreAllClose) {
  const Promptly promptly;
  const Result<PreparedMesh> prepared = prepare_mesh(open_book(100'000, false));
  ASSERT_TRUE(prepared.ok()) << prepared.error().message;
  const MeshReport& report = prepared.value().report;
  EXPECT_FALSE(report.sides_known);
  EXPECT_EQ(report.triangles, 100'012u);
  EXPECT_EQ(report.trusted_triangles, 0u);
}

}  // namespace
}  // namespace medial_vk
