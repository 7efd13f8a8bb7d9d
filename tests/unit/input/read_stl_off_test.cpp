// Features of real files of STL and OFF beyond the plain form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>

#include "read_text.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;
using testing::HasSubstr;

// ---- STL

TEST(ReadStl, CornersAreWeldedBitByBit) {
  Mesh box = make_box({1, 2, 3});
  EXPECT_EQ(read_text(to_binary_stl(box), "a.stl").vertices.size(), 8u);
  EXPECT_EQ(read_text(to_ascii_stl(box), "a.stl").vertices.size(), 8u);
  std::string text = to_ascii_stl(box);
  text.replace(text.find("vertex 0 0 0"), 12, "vertex -0 0 -0.0");
  EXPECT_EQ(read_text(text, "a.stl").vertices.size(), 8u);
  text.replace(text.find("vertex -0 0 -0.0"), 16, "vertex 1e-300 0 0");
  EXPECT_EQ(read_text(text, "a.stl").vertices.size(), 9u);
}

TEST(ReadStl, BinaryThatBeginsWithSolid) {
  std::string bytes = to_binary_stl(make_box({1, 2, 3}));
  bytes.replace(0, 20, "solid facet endsolid");
  EXPECT_EQ(read_text(bytes, "a.stl").triangles.size(), 12u);
  bytes.replace(0, 20, "solid x\nfacet normal");
  EXPECT_EQ(read_text(bytes, "a.stl").triangles.size(), 12u);
}

TEST(ReadStl, AsciiOddities) {
  const Mesh mesh = read_text(
      "solid a b c\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "endsolid\nsolid second\ncolor 1 0 0\nFACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 VERTEX 0 0 1 "
      "ENDLOOP "
      "ENDFACET\n",
      "a.stl");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices.size(), 4u);
}

TEST(ReadStl, Messages) {
  std::string binary = to_binary_stl(make_box({1, 2, 3}));
  EXPECT_EQ(message_of(binary.substr(0, 300), "a.stl"),
            "a.stl: header declares 12 triangles, which take 684 bytes, but the file has 300");
  EXPECT_THAT(message_of(binary.substr(0, 50), "a.stl"), HasSubstr("a.stl: 50 bytes are too few"));
  binary.replace(84 + 50 + 12 + 4, 4, bytes_of(std::numeric_limits<float>::infinity(), false));
  EXPECT_EQ(message_of(binary, "a.stl"), "a.stl: triangle 1 (byte 150) has the coordinate inf");
  const std::string start = "solid\nfacet normal 0 0 1\nouter loop\n";
  EXPECT_EQ(message_of(start + "vertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n", "a.stl"),
            "a.stl:6: facet has 2 vertices");
  EXPECT_EQ(message_of(start + "vertex 0 0 0\nvertex 1 0\n", "a.stl"), "a.stl:6: file ends inside facet 0");
  EXPECT_EQ(message_of(start + "vertex 0 zero 0\n", "a.stl"), "a.stl:4: coordinate \"zero\" is not a number");
  EXPECT_EQ(message_of(start + "corner 0 0 0\n", "a.stl"),
            "a.stl:4: \"corner\" where \"vertex\" or \"endloop\" should be");
  EXPECT_EQ(message_of("solid nothing\nendsolid nothing\n", "a.stl"), "a.stl: no faces (0 vertices)");
}

// ---- OFF

TEST(ReadOff, Variants) {
  const std::string body = "0 0 0{}\n1 0 0{}\n1 1 0{}\n0 1 0{}\n4 0 1 2 3 {}\n";
  const auto with = [&](const std::string& header, const std::string& vertex, const std::string& face) {
    std::string text = header + body;
    for (int i = 0; i < 4; ++i) text.replace(text.find("{}"), 2, vertex);
    return text.replace(text.find("{}"), 2, face);
  };
  for (const std::string& text :
       {with("OFF\n4 1 0\n", "", ""), with("OFF 4 1 0\n", "", "255 0 0"), with("OFF 4 1\n", "", ""),
        with("COFF\n# remark\n4 1 4\n", " 255 0 0 255", "3"), with("NOFF\n4 1 0\n", " 0 0 1", ""),
        with("STOFF\n4 1 0\n", " 0.5 0.5", "0.1 0.2 0.3"), with("CNOFF\n\n4 1 0 # counts\n", " 0 0 1 1 1 1 1", ""),
        with("OFF\n4 1 0\n", " # remark", "# remark"), with("4 1 0\n", "", "")}) {
    const Mesh mesh = read_text(text, "a.off");
    EXPECT_EQ(mesh.vertices.size(), 4u) << text;
    EXPECT_EQ(mesh.triangles.size(), 2u) << text;
  }
  EXPECT_EQ(read_text("OFF\n3 1 0\n0 0\n0\n1 0 0\n0 1 0\n3 0\n1 2\n", "a").triangles.size(), 1u);
}

TEST(ReadOff, Messages) {
  const std::string start = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(message_of(start + "3 0 1 3\n", "a.off"), "a.off:6: face uses vertex 3 of 3 (OFF counts from 0)");
  EXPECT_EQ(message_of(start + "3 0 1 -1\n", "a.off"), "a.off:6: face uses vertex -1 of 3 (OFF counts from 0)");
  EXPECT_THAT(message_of(start + "# and no face\n", "a.off"), HasSubstr("file ends at face 0 of 1"));
  EXPECT_THAT(message_of(start + "3 0 1", "a.off"), HasSubstr("file ends in face 0 of 1"));
  EXPECT_THAT(message_of(start + "x 0 1 2", "a.off"), HasSubstr("a.off:6: \"x\" where a number of corners should be"));
  EXPECT_THAT(message_of("OFF\n3 1 0\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n", "a.off"),
              HasSubstr("a.off:4: coordinate \"inf\""));
  EXPECT_THAT(message_of("4OFF\n3 1 0\n", "a.off"), HasSubstr("only three dimensions"));
  EXPECT_THAT(message_of("OFF\n-3 1 0\n", "a.off"), HasSubstr("a.off:2: \"-3\" where a count"));
  EXPECT_EQ(message_of("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "a.off"), "a.off: no faces (3 vertices)");
}

/// Four bytes, the most significant first.
std::string big_endian(std::uint32_t word) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(word >> shift & 255));
  return bytes;
}

std::string integers(std::initializer_list<std::uint32_t> words) {
  std::string bytes;
  for (const std::uint32_t word : words) bytes += big_endian(word);
  return bytes;
}

std::string floats(std::initializer_list<float> words) {
  std::string bytes;
  for (const float word : words) bytes += big_endian(std::bit_cast<std::uint32_t>(word));
  return bytes;
}

/// A square, with `extra` after each vertex.
std::string binary_off(const std::string& keyword, const std::string& extra) {
  return keyword + " BINARY\n" + integers({4, 1, 0}) + floats({0, 0, 0}) + extra + floats({1, 0, 0}) + extra +
         floats({1, 1, 0.5}) + extra + floats({0, 1, 0}) + extra + integers({4, 0, 1, 2, 3, 2}) + floats({0.5, 1});
}

TEST(ReadBinaryOff, Variants) {
  const std::string normal = floats({0, 0, 1}), colour = floats({1, 0, 0, 1}), texture = floats({0.5, 0.5});
  for (const std::string& bytes :
       {binary_off("OFF", ""), binary_off("NOFF", normal), binary_off("COFF", colour),
        binary_off("CNOFF", normal + colour), binary_off("STCNOFF", normal + colour + texture)}) {
    const Mesh mesh = read_text(bytes, "a.off");
    ASSERT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.vertices[2], (Point{1, 1, 0.5}));
    EXPECT_EQ(mesh.triangles.size(), 2u);
  }
}

TEST(ReadBinaryOff, TheDimensionIsANumberOfItsOwn) {
  const std::string body = binary_off("OFF", "").substr(11);
  EXPECT_EQ(read_text("nOFF BINARY\n" + integers({3}) + body, "a.off").triangles.size(), 2u);
  EXPECT_EQ(message_of("nOFF BINARY\n" + integers({4}) + body, "a.off"), "a.off: 4 dimensions: only three can be read");
}

TEST(ReadBinaryOff, Messages) {
  const std::string whole = binary_off("OFF", "");
  for (std::size_t size = 11; size < whole.size(); ++size) {  // every cut
    EXPECT_NE(message_of(whole.substr(0, size), "a.off"), "") << size;
  }
  EXPECT_EQ(message_of("OFF BINARY\n", "a.off"), "a.off: file ends before the counts of vertices and faces");
  EXPECT_THAT(message_of("4OFF BINARY\n", "a.off"), HasSubstr("only three dimensions"));
  EXPECT_THAT(message_of("OFF BINARY\n" + integers({0xffffffff, 0xffffffff, 0}), "a.off"),
              HasSubstr("more than the 0 bytes that follow can hold"));
  std::string bytes = whole;
  bytes.replace(bytes.size() - 16, 4, big_endian(4));  // the last corner
  EXPECT_EQ(message_of(bytes, "a.off"), "a.off: face 0 uses vertex 4 of 4");
  bytes = whole;
  bytes.replace(bytes.size() - 32, 4, big_endian(9));
  EXPECT_THAT(message_of(bytes, "a.off"), HasSubstr("face 0 declares 9 corners"));
  bytes = whole;
  bytes.replace(bytes.size() - 12, 4, big_endian(3));
  EXPECT_THAT(message_of(bytes, "a.off"), HasSubstr("declares a colour of 3 numbers"));
  bytes = whole;
  bytes.replace(11 + 12 + 4, 4, big_endian(0x7fc00000));
  EXPECT_EQ(message_of(bytes, "a.off"), "a.off: vertex 0 (byte 16 of the numbers) has nan");
}

}  // namespace
}  // namespace medial_vk
