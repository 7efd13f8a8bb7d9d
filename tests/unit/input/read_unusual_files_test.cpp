// Sparse and unusual files of our own formats, as programs and collections have them: what concerns no face is skipped,
// wherever it is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "read_text.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

// ---- OBJ

const std::string kQuad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(UnusualObj, GroupsMaterialsSmoothingAndLevelsOfDetail) {
  const Mesh mesh = read_text(
      "mtllib a b.mtl c.mtl\ng\no part 1\ng left right middle\n" + kQuad +
          "usemtl x\ns 1\nf 1 2 3\ng right\nusemap off\nmg 1 0.1\ns off\nlod 2\nbevel on\nc_interp on\nd_interp off\n"
          "shadow_obj a.obj\ntrace_obj b.obj\nmaplib m\nusemtl\nf 1 3 4\ng\no\n",
      "a.obj");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST(UnusualObj, LinesAndPointsAreNoFaces) {
  const Mesh mesh = read_text("v 9 9 9\n" + kQuad + "p 1 2 3\nl 1 2 3 4 5\nl -1/1 -2/2 -3\nf 2 3 4\np -1\n", "a.obj");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{1, 2, 3}));
  EXPECT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.short_polygons, 0u);
  EXPECT_EQ(message_of(kQuad + "l 1 2 3 4\np 1\n", "a.obj"), "a.obj: no faces (4 vertices)");
}

const std::string kSurface =
    "vp 0.5 0.5 1\ncstype rat bspline\ndeg 3 3\nsurf 0.0 1.0 0.0 1.0 1/1/1 2/1/1 \\\n 3 4\nparm u 0 0 1 1\n"
    "parm v 0 0 1 \\\n1\ntrim 0.0 1.0 1\nhole 0 1 2\nscrv 0 1 3\nsp 1\nend\ncurv 0 1 1 2 3 4\ncurv2 1 2\nend\n"
    "con 1 0 1 1 2 0 1 2\nbmat u 1 0 \\\n0 1\nstep 1 1\nctech cparm 1\nstech curv 1 1\n";

TEST(UnusualObj, FreeFormPartsAreSkippedBesidePolygons) {
  const Mesh mesh = read_text(kQuad + kSurface + "f 1 2 3\n", "a.obj");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_EQ(message_of(kQuad + kSurface, "a.obj"),
            "a.obj: no faces: it holds free-form surfaces only; export it as polygons");
}

TEST(UnusualObj, TheOlderNameOfAFace) {
  EXPECT_THAT(read_text(kQuad + "fo 1/1 2/2 3/3\nf 1 3 4\n", "a.obj").triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_EQ(message_of(kQuad + "fo 1 2 9\n", "a.obj"), "a.obj:5: face uses vertex 9 of 4");
}

// No command of a file is run, and no other file is read.
TEST(UnusualObj, CallsAndCommandsAreSkipped) {
  const Mesh mesh = read_text("call other.obj 1 2\ncsh -touch /tmp/medial-vk-never\n" + kQuad + "f 1 2 3\n", "a.obj");
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(UnusualObj, ContentIsRecognisedByAnyOfItsFirstWords) {
  for (const char* start : {"fo 1 2 3\n", "vp 0 0\n", "l 1 2\n", "p 1\n", "cstype bezier\n", "mg 1 2\n", "lod 1\n"}) {
    EXPECT_GE(read_text(start + kQuad + "f 1 2 3\n", "standard input").triangles.size(), 1u) << start;
  }
}

TEST(UnusualObj, VerticesBetweenFacesAndFacesOfManyFormsInOneFile) {
  const Mesh mesh = read_text(
      "v 0 0 0 # first\nv 1 0 0\nv 1 1 0\nvt 0 0\nvn 0 0 1\nf 1//1 2//1 3//1\nv 0 1 0\nf 1/1 3/1 -1/1\nf 1 2\nf 1\n",
      "a.obj");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_EQ(mesh.short_polygons, 2u);
}

// ---- STL

/// A binary STL whose header begins so, without zeros if `padding` is a blank.
std::string binary_with(const std::string& start, char padding = '\0') {
  std::string bytes = to_binary_stl(make_box({1, 2, 3}));
  std::string header = start;
  header.resize(80, padding);
  return bytes.replace(0, 80, header);
}

TEST(UnusualStl, BinaryWhoseHeaderSaysSolid) {
  for (const char padding : {'\0', ' '}) {
    for (const char* start :
         {"solid", "solid part\nfacet normal 0 0 1\n", "SOLID \"a\" facet", "solid\nendsolid\n", "  solid ascii"}) {
      const std::string bytes = binary_with(start, padding);
      EXPECT_EQ(read_text(bytes, "a.stl").triangles.size(), 12u) << start;
      EXPECT_EQ(read_text(bytes, "standard input").triangles.size(), 12u) << start;
      // Some programs append data of their own, which the number of triangles does not count.
      EXPECT_EQ(read_text(bytes + "COLOR and more", "a.stl").triangles.size(), 12u) << start;
    }
  }
}

TEST(UnusualStl, TruncatedBinaryWhoseHeaderSaysSolidIsNotTakenForText) {
  EXPECT_THAT(message_of(binary_with("solid part").substr(0, 300), "a.stl"), HasSubstr("header declares 12 triangles"));
}

TEST(UnusualStl, TextInCapitalsWithOtherLinesAndSeveralSolids) {
  const std::string facet =
      "FACET NORMAL 0 0 1\n OUTER LOOP\n VERTEX 0 0 0\n VERTEX 1 0 0\n VERTEX 0 1 0\n ENDLOOP\nENDFACET\n";
  for (const std::string& text :
       {"SOLID a\n" + facet + "ENDSOLID a\n", "\n\n  Solid\n; exported by hand\n" + facet,
        "solid a\r\ncolor 1 0 0\r\n" + facet, "solid a\nendsolid a\nsolid b\n" + facet + "endsolid\n\n"}) {
    EXPECT_EQ(read_text(text, "a.stl").triangles.size(), 1u) << text;
    EXPECT_EQ(read_text(text, "standard input").triangles.size(), 1u) << text;
  }
  // A title of any length before the first facet.
  EXPECT_EQ(read_text("solid " + std::string(5000, 'x') + "\n" + facet, "a.stl").triangles.size(), 1u);
}

TEST(UnusualStl, FacetsOfMoreThanThreeCorners) {
  const Mesh mesh = read_text(
      "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid\n",
      "a.stl");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices.size(), 4u);
}

// ---- OFF

TEST(UnusualOff, KeywordsInSmallLettersAndDimensionsByNumber) {
  const std::string body = "4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  for (const char* keyword : {"off\n", "OFF\n", "coff\n", "nOFF\n3\n", "nOFF 3\n", "CnOFF 3\n", ""}) {
    EXPECT_EQ(read_text(keyword + body, "a.off").triangles.size(), 2u) << keyword;
  }
  EXPECT_THAT(message_of("nOFF 4\n" + body, "a.off"), HasSubstr("a.off:1: \"nOFF\": only three dimensions"));
  EXPECT_THAT(message_of("4nOFF 3\n" + body, "a.off"), HasSubstr("only three dimensions"));
}

TEST(UnusualOff, CommentsBlankLinesAndSparseFaces) {
  const Mesh mesh = read_text(
      "# a remark first\nOFF # and here\n\n# counts\n\n5 5 0\n\n0 0 0\n# between\n1 0 0 0.5 0.5 0.5 1\n\n1 1 0\n0 1 0\n"
      "7 7 7\n0\n1 0\n2 0 1\n4 0 1 2 3 0.5 0.5 0.5\n3\n0 1\n2 # over three lines\n",
      "a.off");
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.short_polygons, 3u);
}

// ---- PLY

TEST(UnusualPly, ElementsOfAnyKindBeforeVerticesAndFaces) {
  const Mesh mesh = read_text(
      "ply\ncomment first\nformat ascii 1.0\nobj_info scan 7\nelement camera 1\nproperty float view\n"
      "property list uchar float matrix\nelement nothing 3\nelement vertex 3\nproperty list uchar int neighbours\n"
      "property double x\nproperty double y\nproperty double z\nelement edge 2\nproperty int vertex1\n"
      "property int vertex2\nproperty list uint8 uint8 colours\nelement face 1\nproperty list uchar float texcoord\n"
      "property list uchar uint vertex_indices\nproperty int flags\nelement tail 1\nproperty int x\nend_header\n"
      "1.5 4 0 0 0 1\n2 1 2 0 0 0\n0 1 0 0\n1 7 0 1 0\n0 1 0\n1 2 3 255 255 255\n6 0 0 1 0 0 1\n3 0 1 2 9\nnot read",
      "a.ply");
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_EQ(mesh.vertices[2], (Point{0, 1, 0}));
}

}  // namespace
}  // namespace medial_vk
