// Every format gives back the mesh that was written; and features of real files beyond the plain form: OBJ and PLY.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <clocale>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>

#include "read_text.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;
using testing::HasSubstr;

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
}

/// Same triangles by position, in order: for formats without shared vertices.
void expect_same_corners(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_EQ(a.vertices[a.triangles[i][k]], b.vertices[b.triangles[i][k]]);
  }
}

/// Rounds through memory, since g++ 12 at -O3 omits the rounding of the last elements of a loop over x = float(x).
double round_to_float(double x) {
  const volatile float rounded = static_cast<float>(x);
  return static_cast<double>(rounded);
}

/// Coordinates with all digits in use.
Mesh turned_torus() {
  Mesh mesh = make_torus(2, 0.7, 7, 11);
  rotate(mesh, {1, 2, 3}, 0.3);
  return mesh;
}

TEST(ReadFormats, EveryFormatKeepsEveryBit) {
  for (const double factor : {1.0, 1e-6, 1e6}) {
    for (const double offset : {0.0, 1e6}) {
      Mesh mesh = turned_torus();
      scale(mesh, factor);
      translate(mesh, {offset, -offset, 2 * offset});
      expect_same(read_text(to_obj(mesh), "a.obj"), mesh);
      expect_same(read_text(to_off(mesh), "a.off"), mesh);
      expect_same(read_text(to_ascii_ply(mesh), "a.ply"), mesh);
      expect_same(read_text(to_binary_ply(mesh, false), "a.ply"), mesh);
      expect_same(read_text(to_binary_ply(mesh, true), "a.ply"), mesh);
      expect_same_corners(read_text(to_ascii_stl(mesh), "a.stl"), mesh);
      for (Point& p : mesh.vertices) {
        for (double& x : p) x = round_to_float(x);
      }
      expect_same_corners(read_text(to_binary_stl(mesh), "a.stl"), mesh);
    }
  }
}

TEST(ReadFormats, ContentBeatsExtension) {
  const Mesh mesh = turned_torus();
  for (const char* name : {"-", "mesh", "mesh.obj", "mesh.xyz", "standard input"}) {
    expect_same(read_text(to_off(mesh), name), mesh);
    expect_same(read_text(to_ascii_ply(mesh), name), mesh);
    expect_same(read_text(to_binary_ply(mesh, true), name), mesh);
    EXPECT_EQ(read_text(to_ascii_stl(mesh), name).triangles.size(), mesh.triangles.size());
    EXPECT_EQ(read_text(to_binary_stl(mesh), name).triangles.size(), mesh.triangles.size());
    expect_same(read_text(to_obj(mesh), name), mesh);
  }
  EXPECT_THAT(message_of("hello world", "notes.txt"), HasSubstr("notes.txt: neither content nor extension"));
}

TEST(ReadFormats, ByteOrderMarkIsSkipped) {
  expect_same(read_text("\xef\xbb\xbf" + to_obj(turned_torus()), "a.obj"), turned_torus());
  expect_same(read_text("\xef\xbb\xbf" + to_off(turned_torus()), "a"), turned_torus());
}

TEST(ReadFormats, LineEndsTabsAndMissingLastOne) {
  const Mesh mesh = turned_torus();
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
    return text;
  };
  for (const std::string& text : {to_obj(mesh), to_off(mesh), to_ascii_ply(mesh)}) {
    for (const char* end : {"\r\n", "\r"}) expect_same(read_text(with(text, "\n", end), "a.obj"), mesh);
    expect_same(read_text(text.substr(0, text.size() - 1), "a.obj"), mesh);
  }
  for (const std::string& text : {to_obj(mesh), to_off(mesh)}) {
    expect_same(read_text(with(text, " ", " \t "), "a.obj"), mesh);
    expect_same(read_text(with(text, "\n", "  # remark\n\n"), "a.obj"), mesh);
  }
  const std::string stl = to_ascii_stl(mesh);
  for (const char* end : {"\r\n", "\r"}) expect_same_corners(read_text(with(stl, "\n", end), "a.stl"), mesh);
  expect_same_corners(read_text(with(stl, "   vertex", "\tVERTEX"), "a.stl"), mesh);
}

struct CommaPunctuation : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(ReadFormats, DecimalCommaLocaleChangesNothing) {
  // Sets the locale of C, if one is installed, and that of C++ in any case.
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "nl_NL.UTF-8", "pl_PL.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) != nullptr) break;
  }
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaPunctuation));
  Mesh mesh = turned_torus();
  scale(mesh, 12345);
  expect_same(read_text(to_obj(mesh), "a.obj"), mesh);
  expect_same(read_text(to_off(mesh), "a.off"), mesh);
  expect_same(read_text(to_ascii_ply(mesh), "a.ply"), mesh);
  expect_same_corners(read_text(to_ascii_stl(mesh), "a.stl"), mesh);
  EXPECT_EQ(message_of("f 1 1 12345\nv 1.5 0 0\n", "mesh.obj"), "mesh.obj:1: face uses vertex 12345 of 1");
  std::locale::global(before);
  std::setlocale(LC_ALL, "C");
}

TEST(ReadFormats, FromDisk) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "medial_vk_read_formats_test.obj";
  std::ofstream(path) << to_obj(turned_torus());
  const Result<Mesh> mesh = read_mesh(path.string());
  std::filesystem::remove(path);
  ASSERT_TRUE(mesh.ok());
  expect_same(mesh.value(), turned_torus());
  const Result<Mesh> missing = read_mesh(path.string());
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::kInvalidMesh);
  EXPECT_THAT(missing.error().message, HasSubstr(path.string() + ": cannot open: No such file"));
  const Result<Mesh> folder = read_mesh(std::filesystem::temp_directory_path().string());
  ASSERT_FALSE(folder.ok());
  EXPECT_THAT(folder.error().message, HasSubstr("directory"));
}

// ---- OBJ

const std::string kQuadVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, SlashesAndNegativeIndices) {
  for (const char* face : {"f 1 2 3", "f 1/7 2/8 3/9", "f 1//7 2//8 3//9", "f 1/1/1 2/2/2 3/3/3", "f -4 -3 -2",
                           "f -4/-1/-1 -3/-1/-1 -2//-5", "f\t+1  2   3 "}) {
    const Mesh mesh = read_text(kQuadVertices + face, "a.obj");
    ASSERT_EQ(mesh.triangles.size(), 1u) << face;
    EXPECT_EQ(mesh.triangles[0], (Triangle{0, 1, 2})) << face;
  }
}

TEST(ReadObj, NegativeIndicesCountFromWhereTheyStand) {
  const Mesh mesh =
      read_text("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nv 6 6 6\nv 7 7 8\nf -3 -2 -1\n", "a");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{1, 2, 3}, {4, 5, 6}}));
}

TEST(ReadObj, FacesMayComeFirst) {
  EXPECT_EQ(read_text("f 1 2 3\n" + kQuadVertices, "a.obj").triangles.size(), 1u);
  EXPECT_EQ(message_of("f 1 2 5\n" + kQuadVertices, "a.obj"), "a.obj:1: face uses vertex 5 of 4");
}

TEST(ReadObj, ContinuedLines) {
  const Mesh mesh = read_text("v 0 0 \\\n0\nv 1 0 0\nv 1 \\\r\n1 0\nf 1\\\n 2 3\nf 7 1 2\n" + kQuadVertices, "a.obj");
  EXPECT_EQ(mesh.vertices[2], (Point{1, 1, 0}));
  EXPECT_EQ(mesh.triangles[0], (Triangle{0, 1, 2}));
  EXPECT_THAT(message_of("v 0 0 \\\n0\nf 1 \\\n 1 9\n", "a.obj"), HasSubstr("a.obj:4: face uses vertex 9 of 1"));
  // A remark that ends with a backslash does not swallow the next line.
  EXPECT_EQ(read_text("# C:\\\nv 4 5 6\n" + kQuadVertices + "f 1 2 3\n", "a.obj").vertices[0], (Point{4, 5, 6}));
}

TEST(ReadObj, ColoursWeightsAndOtherLines) {
  const Mesh mesh = read_text(
      "mtllib a.mtl\no x\nv 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 1 1 0 1 0 0 1\nvn 0 0 1\nvt 0 0\ng\ns off\n"
      "l 1 2\np 1\ncurv 0 1 1 2\nusemtl m\nf 1 2 3\n",
      "a.obj");
  EXPECT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(ReadObj, NumbersInAllForms) {
  const Mesh mesh = read_text("v +1.5 -.5 2.\nv 1e3 1E-3 -1.25e+2\nv 1e-400 -1e-999999999999 0.1\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(mesh.vertices[0], (Point{1.5, -0.5, 2}));
  EXPECT_EQ(mesh.vertices[1], (Point{1e3, 1e-3, -125}));
  EXPECT_EQ(mesh.vertices[2], (Point{0, 0, 0.1}));
}

TEST(ReadObj, Messages) {
  EXPECT_EQ(message_of(kQuadVertices + "f 1 2 99\n", "mesh.obj"), "mesh.obj:5: face uses vertex 99 of 4");
  EXPECT_EQ(message_of(kQuadVertices + "f 1 2 -5\n", "mesh.obj"), "mesh.obj:5: face uses vertex -5 of 4");
  EXPECT_EQ(message_of(kQuadVertices + "f 0 1 2\n", "mesh.obj"), "mesh.obj:5: face uses vertex 0; OBJ counts from 1");
  EXPECT_EQ(message_of(kQuadVertices + "f 1 x 2\n", "mesh.obj"), "mesh.obj:5: face corner \"x\" is not an index");
  EXPECT_EQ(message_of(kQuadVertices + "f 1 2.5 2\n", "mesh.obj"), "mesh.obj:5: face corner \"2.5\" is not an index");
  EXPECT_EQ(message_of(kQuadVertices + "f 1 2 99999999999999999999\n", "mesh.obj"),
            "mesh.obj:5: face corner \"99999999999999999999\" is not an index");
  EXPECT_EQ(message_of("v 0 0\n", "mesh.obj"), "mesh.obj:1: vertex has 2 coordinates of 3");
  EXPECT_EQ(message_of("v 0 nan 0\n", "mesh.obj"), "mesh.obj:1: coordinate \"nan\" is not finite");
  EXPECT_EQ(message_of("v 0 -inf 0\n", "mesh.obj"), "mesh.obj:1: coordinate \"-inf\" is not finite");
  EXPECT_EQ(message_of("\nv 0 1e999 0\n", "mesh.obj"),
            "mesh.obj:2: coordinate \"1e999\" is beyond the range of a double");
  EXPECT_EQ(message_of("v 0 1,5 0\n", "mesh.obj"), "mesh.obj:1: coordinate \"1,5\" is not a number");
  EXPECT_EQ(message_of(kQuadVertices, "mesh.obj"), "mesh.obj: no faces (4 vertices)");
  EXPECT_EQ(message_of(kQuadVertices + "f 1 2\nf\n", "mesh.obj"),
            "mesh.obj: no triangles: all 2 faces have fewer than three corners");
  EXPECT_EQ(message_of("", "mesh.obj"), "mesh.obj: file is empty");
  EXPECT_EQ(message_of("\n\n# nothing\n", "mesh.obj"), "mesh.obj: no faces (0 vertices)");
}

// ---- PLY

TEST(ReadPly, ExtraElementsAndPropertiesOfAllTypes) {
  for (const bool big : {false, true}) {
    std::string bytes = big ? "ply\nformat binary_big_endian 1.0\n" : "ply\nformat binary_little_endian 1.0\n";
    bytes +=
        "obj_info x\nelement camera 1\nproperty float f\nproperty list ushort double d\nelement empty 1000000\n"
        "element vertex 3\nproperty uchar red\nproperty short x\nproperty list uint8 int16 extra\nproperty float y\n"
        "property uint z\nelement face 1\nproperty uchar flags\nproperty list int ushort vertex_index\n"
        "property list uchar float uv\nelement edge 5\nproperty int a\nend_header\n";
    bytes += bytes_of(1.0f, big) + bytes_of(std::uint16_t{2}, big) + bytes_of(1.0, big) + bytes_of(2.0, big);
    for (int i = 0; i < 3; ++i) {
      bytes += bytes_of(std::uint8_t{200}, big) + bytes_of(static_cast<std::int16_t>(-i), big);
      bytes +=
          bytes_of(std::uint8_t{1}, big) + bytes_of(std::int16_t{7}, big) + bytes_of(0.5f * static_cast<float>(i), big);
      bytes += bytes_of(std::uint32_t{4000000000u}, big);
    }
    bytes += bytes_of(std::uint8_t{1}, big) + bytes_of(std::int32_t{3}, big);
    for (const int v : {2, 1, 0}) bytes += bytes_of(static_cast<std::uint16_t>(v), big);
    bytes += bytes_of(std::uint8_t{0}, big);
    bytes.append(20, 'e');
    const Mesh mesh = read_text(bytes, "a.ply");
    EXPECT_EQ(mesh.vertices, (std::vector<Point>{{0, 0, 4e9}, {-1, 0.5, 4e9}, {-2, 1, 4e9}}));
    EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{2, 1, 0}}));
  }
}

TEST(ReadPly, AsciiWithExtrasAndFacesFirst) {
  const Mesh mesh = read_text(
      "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\nproperty uchar red\n"
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float quality\nend_header\n"
      "4 0 1 2 3 255\n3 0 1 2 0\n0 0 0 nan\n1 0 0 1\n1 1 0 1\n0 1 0.1 1",
      "a.ply");
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.vertices[3], (Point{0, 1, 0.1}));  // not rounded to float
}

TEST(ReadPly, BinaryBodyMayBeginWithLineEnds) {
  Mesh mesh = make_box({1, 1, 1});
  const double odd = std::bit_cast<double>(std::uint64_t{0x3ff00d0a0d0a0d0aull});  // bytes 0a 0d 0a 0d ...
  for (Point& p : mesh.vertices) p[0] = p[0] + odd;
  mesh.vertices[0][0] = odd;
  for (const bool big : {false, true}) {
    std::string bytes = to_binary_ply(mesh, big);
    expect_same(read_text(bytes, "a.ply"), mesh);
    std::size_t end = bytes.find("end_header\n") + 11;
    std::string header = bytes.substr(0, end), with_cr;
    for (const char c : header) with_cr += c == '\n' ? std::string("\r\n") : std::string(1, c);
    expect_same(read_text(with_cr + bytes.substr(end), "a.ply"), mesh);
  }
}

TEST(ReadPly, Messages) {
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string start = "ply\nformat ascii 1.0\n", end = "end_header\n";
  const std::string all = start + vertices + faces + end;
  EXPECT_EQ(message_of(all + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "a.ply"), "a.ply:13: face 0 uses vertex 3 of 3");
  EXPECT_EQ(message_of(all + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "a.ply"), "a.ply:13: face 0 uses vertex -1 of 3");
  EXPECT_EQ(message_of(all + "0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", "a.ply"), "a.ply:11: \"x\" is not a number");
  EXPECT_EQ(message_of(all + "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "a.ply"),
            "a.ply:11: vertex 1: z is not finite or beyond the range of a double");
  EXPECT_THAT(message_of(all + "0 0 0\n1 0 0\n0 1 0\n3 0 1", "a.ply"),
              HasSubstr("a.ply:13: a list of 3 values is longer than the rest"));
  EXPECT_EQ(message_of(all + "0 0 0\n1 0 0\n0 111111111111\n", "a.ply"), "a.ply:13: file ends too early");
  EXPECT_EQ(message_of(start + vertices + end + "0 0 0\n1 0 0\n0 1 0\n", "a.ply"),
            "a.ply: no faces: header declares no element \"face\" and no element \"tristrips\"");
  EXPECT_THAT(message_of(start + faces + end + "3 0 1 2\n", "a.ply"), HasSubstr("no element \"vertex\""));
  EXPECT_THAT(message_of(start + vertices + faces, "a.ply"), HasSubstr("a.ply:9: file ends inside the header"));
  EXPECT_THAT(message_of("ply\nformat weird 1.0\nend_header\n", "a.ply"), HasSubstr("a.ply:2: format \"weird\""));
  EXPECT_THAT(message_of("ply\nelement vertex 1\nend_header\n", "a.ply"), HasSubstr("no \"format\" line"));
  EXPECT_THAT(message_of(start + "property float x\nend_header\n", "a.ply"), HasSubstr("before the first element"));
  EXPECT_THAT(message_of(start + "element vertex 1\nproperty blob x\n", "a.ply"), HasSubstr("\"blob\" is no type"));
  const Mesh box = make_box({1, 1, 1});
  std::string binary = to_binary_ply(box, false);
  const std::size_t body = binary.find("end_header\n") + 11;
  std::string nan = binary;
  nan.replace(body + 24 + 8, 8, bytes_of(std::numeric_limits<double>::quiet_NaN(), false));
  EXPECT_EQ(message_of(nan, "a.ply"), "a.ply: vertex 1: y is not finite or beyond the range of a double (byte " +
                                          std::to_string(body + 32) + ")");
  std::string index = binary;
  index.replace(body + 8 * 24 + 13 + 1, 4, bytes_of(std::int32_t{8}, false));
  EXPECT_EQ(message_of(index, "a.ply"),
            "a.ply: face 1 uses vertex 8 of 8 (byte " + std::to_string(body + 8 * 24 + 14) + ")");
}

}  // namespace
}  // namespace medial_vk
