// PLY with triangle strips, as the models of Stanford have them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "read_text.h"
#include "support/solids/mesh_files.h"

namespace medial_vk {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kVertices =
    "element vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
    "element tristrips ";
const std::string kList = "property list int int vertex_indices\nend_header\n";
const std::string kCorners = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";

std::string text_of(const std::string& strips, int lists = 1) {
  return "ply\nformat ascii 1.0\n" + kVertices + std::to_string(lists) + "\n" + kList + kCorners + strips;
}

TEST(ReadPlyStrips, OrientationAlternates) {
  const Mesh mesh = read_text(text_of("5 0 1 2 3 4\n"), "a.ply");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{2, 3, 4}));
  EXPECT_EQ(mesh.vertices[4], (Point{0, 2, 0}));
}

TEST(ReadPlyStrips, MinusOneEndsAStripAndTheNextBeginsAnew) {
  for (const char* strips : {"8 0 1 2 3 -1 2 3 4\n", "10 -1 0 1 2 3 -1 2 3 4 -1\n", "9 0 1 2 3 -1 -1 2 3 4\n"}) {
    const Mesh mesh = read_text(text_of(strips), "a.ply");
    EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{2, 3, 4})) << strips;
    EXPECT_EQ(mesh.short_polygons, 0u);
  }
  const Mesh lists = read_text(text_of("3 0 1 2\n0\n3 2 3 4\n", 3), "a.ply");
  EXPECT_THAT(lists.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 3, 4}));
}

// A repeated vertex joins two strips or turns one over; it counts for the orientation of those that follow.
TEST(ReadPlyStrips, RepeatedVerticesMakeNoTriangleButCount) {
  const Mesh turned = read_text(text_of("5 0 1 2 2 3\n"), "a.ply");
  EXPECT_THAT(turned.triangles, ElementsAre(Triangle{0, 1, 2}));
  const Mesh joined = read_text(text_of("8 0 1 2 2 2 3 4 1\n"), "a.ply");
  EXPECT_THAT(joined.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{2, 3, 4}, Triangle{4, 3, 1}));
}

TEST(ReadPlyStrips, StripsTooShortForATriangleAreCounted) {
  const Mesh mesh = read_text(text_of("8 0 -1 0 1 -1 0 1 2\n"), "a.ply");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.short_polygons, 2u);
  EXPECT_EQ(message_of(text_of("3 0 -1 1\n"), "a.ply"),
            "a.ply: no triangles: all 2 faces have fewer than three corners");
  EXPECT_EQ(message_of(text_of("2 -1 -1\n"), "a.ply"), "a.ply: no faces (5 vertices)");
}

TEST(ReadPlyStrips, BinaryOfBothOrdersAndAllTypes) {
  for (const bool big : {false, true}) {
    for (const bool floats : {false, true}) {
      std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n" + kVertices +
                          "1\nproperty uchar flags\nproperty list uchar " + (floats ? "float" : "short") +
                          " vertex_index\nend_header\n";
      for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f, 0.f, 2.f, 0.f}) {
        bytes += bytes_of(x, big);
      }
      bytes += std::string("\1\10");
      for (const int index : {0, 1, 2, 3, -1, 2, 3, 4}) {
        bytes += floats ? bytes_of(static_cast<float>(index), big) : bytes_of(static_cast<std::int16_t>(index), big);
      }
      EXPECT_THAT(read_text(bytes, "a").triangles,
                  ElementsAre(Triangle{0, 1, 2}, Triangle{2, 1, 3}, Triangle{2, 3, 4}));
      EXPECT_THAT(message_of(bytes.substr(0, bytes.size() - 1), "a.ply"), HasSubstr("longer than the rest"));
    }
  }
}

TEST(ReadPlyStrips, FacesAndStripsInOneFile) {
  const std::string start =
      "ply\nformat ascii 1.0\nelement face {}\nproperty list uchar int vertex_indices\n" + kVertices;
  const auto with = [&](const char* faces, const std::string& rest) {
    std::string text = start;
    return text.replace(text.find("{}"), 2, faces) + rest;
  };
  EXPECT_EQ(read_text(with("1", "1\n" + kList + "3 0 1 3\n" + kCorners + "3 2 3 4\n"), "a.ply").triangles.size(), 2u);
  // An element that is declared and empty, without a list.
  EXPECT_EQ(read_text(with("1", "0\nend_header\n3 0 1 3\n" + kCorners), "a.ply").triangles.size(), 1u);
  const std::string no_list = "ply\nformat ascii 1.0\nelement face 0\n" + kVertices + "1\n" + kList + kCorners;
  EXPECT_EQ(read_text(no_list + "3 2 3 4\n", "a.ply").triangles.size(), 1u);
}

TEST(ReadPlyStrips, Messages) {
  EXPECT_EQ(message_of(text_of("3 0 1 5\n"), "a.ply"), "a.ply:15: strip list 0 uses vertex 5 of 5");
  EXPECT_EQ(message_of(text_of("3 0 1 -2\n"), "a.ply"), "a.ply:15: strip list 0 uses vertex -2 of 5");
  EXPECT_EQ(message_of(text_of("3 0 1 0.5\n"), "a.ply"), "a.ply:15: strip list 0 uses vertex 0.5 of 5");
  EXPECT_THAT(message_of(text_of("1000000 0 1 2\n"), "a.ply"),
              HasSubstr("a.ply:15: a list of 1000000 values is longer than the rest of the file"));
  EXPECT_THAT(message_of(text_of("3 0 1 2\n", 1000), "a.ply"),
              HasSubstr("header declares 1000 elements \"tristrips\""));
  EXPECT_EQ(
      message_of("ply\nformat ascii 1.0\n" + kVertices + "1\nproperty int a\nend_header\n" + kCorners + "1\n", "a.ply"),
      "a.ply: element \"tristrips\" has no list \"vertex_indices\" or \"vertex_index\"");
  // -1 ends strips only.
  const std::string face = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n" +
                           kVertices.substr(0, kVertices.find("element trist")) + "end_header\n";
  EXPECT_EQ(message_of(face + "3 0 1 -1\n" + kCorners, "a.ply"), "a.ply:10: face 0 uses vertex -1 of 5");
}

}  // namespace
}  // namespace medial_vk
