// Slices of meshes: rings, orientation, planes through vertices, edges and faces, and open meshes.
#include "shape_files/slice_mesh.h"

#include <algorithm>

#include "unit/shape_files/read_for_tests.h"

namespace medial_vk {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Triangles, counter-clockwise from outside. Corners are 4 x + 2 y + z.
Mesh box_mesh(const Point& lower, const Point& upper) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i) {
    mesh.vertices.push_back({i & 4 ? upper[0] : lower[0], i & 2 ? upper[1] : lower[1], i & 1 ? upper[2] : lower[2]});
  }
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return mesh;
}

void append(Mesh& mesh, const Mesh& other, bool inside_out = false) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (Triangle t : other.triangles) {
    for (std::uint32_t& v : t) v += first;
    if (inside_out) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
}

/// Each triangle with corners of its own, as STL has them.
Mesh exploded(const Mesh& mesh) {
  Mesh result;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (const std::uint32_t v : t) result.vertices.push_back(mesh.vertices[v]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

MeshSlice slice_of(const Mesh& mesh, const std::string& plane) {
  const Result<SlicePlane> parsed = parse_slice_plane(plane);
  EXPECT_TRUE(parsed.ok()) << plane;
  Result<MeshSlice> slice = slice_mesh(mesh, parsed.value());
  EXPECT_TRUE(slice.ok()) << slice.error().message;
  return slice.ok() ? std::move(slice).value() : MeshSlice();
}

/// Positive for rings with their inside on the left.
double signed_area(const PlaneRing& ring) {
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PlanePoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
    area += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return area;
}

/// The sum over all rings.
double signed_area(const MeshSlice& slice) {
  double area = 0;
  for (const PlaneRing& ring : slice.rings) area += signed_area(ring);
  return area;
}

const Mesh kBox = box_mesh({1, 10, 100}, {3, 14, 108});

TEST(SliceMesh, AcrossEachAxis) {
  EXPECT_DOUBLE_EQ(signed_area(slice_of(kBox, "x=2")), 32);
  EXPECT_DOUBLE_EQ(signed_area(slice_of(kBox, "y=13.5")), 16);
  EXPECT_DOUBLE_EQ(signed_area(slice_of(kBox, "z=107")), 8);
  const auto box_of = [](const std::string& plane) {
    PlanePoint lower = {1e9, 1e9}, upper = {-1e9, -1e9};
    for (const PlaneRing& ring : slice_of(kBox, plane).rings) {
      for (const PlanePoint& p : ring) {
        lower = {std::min(lower[0], p[0]), std::min(lower[1], p[1])};
        upper = {std::max(upper[0], p[0]), std::max(upper[1], p[1])};
      }
    }
    return std::array<double, 4>{lower[0], lower[1], upper[0], upper[1]};
  };
  EXPECT_THAT(box_of("x=2"), ElementsAre(10, 100, 14, 108));  // (y, z)
  EXPECT_THAT(box_of("y=11"), ElementsAre(100, 1, 108, 3));   // (z, x)
  EXPECT_THAT(box_of("z=101"), ElementsAre(1, 10, 3, 14));    // (x, y)
}

TEST(SliceMesh, SharesAreOfTheBox) {
  EXPECT_EQ(slice_of(kBox, "z=25%").height, 102);
  EXPECT_EQ(slice_of(kBox, "x=50%").height, 2);
}

TEST(SliceMesh, CornersNeedNotBeShared) {
  const MeshSlice slice = slice_of(exploded(kBox), "z=104");
  ASSERT_EQ(slice.rings.size(), 1u);
  EXPECT_DOUBLE_EQ(signed_area(slice), 8);
  EXPECT_EQ(slice.closed_lines, 0u);
}

TEST(SliceMesh, HollowsAreHoles) {
  Mesh mesh = box_mesh({0, 0, 0}, {10, 10, 10});
  append(mesh, box_mesh({2, 2, 2}, {4, 4, 8}), true);
  const MeshSlice slice = slice_of(mesh, "z=5");
  ASSERT_EQ(slice.rings.size(), 2u);
  EXPECT_DOUBLE_EQ(signed_area(slice), 96);
  const Result<PreparedShape> shape = prepare_shape(slice.rings, FillRule::kNonZero);
  ASSERT_TRUE(shape.ok());
  EXPECT_DOUBLE_EQ(shape.value().report.area, 96);
}

/// A vertex on the plane is above it: a plane in the lower face meets nothing, one in the upper face has its outline.
TEST(SliceMesh, APlaneWithinAFaceIsThatJustBelow) {
  EXPECT_DOUBLE_EQ(signed_area(slice_of(kBox, "z=108")), 8);
  EXPECT_DOUBLE_EQ(signed_area(slice_of(kBox, "z=100%")), 8);
  const Result<MeshSlice> lower = slice_mesh(kBox, {2, 100, false});
  ASSERT_FALSE(lower.ok());
  EXPECT_EQ(lower.error().code, ErrorCode::kInvalidMesh);
  EXPECT_EQ(lower.error().message, "the plane z=100 does not meet the mesh, which is between 100 and 108");
  // Of steps, the lower part has the plane just below its face: without the upper part, which is smaller.
  Mesh steps = box_mesh({0, 0, 0}, {10, 10, 5});
  append(steps, box_mesh({0, 0, 5}, {4, 4, 9}));
  EXPECT_DOUBLE_EQ(signed_area(slice_of(steps, "z=5")), 100);
  EXPECT_DOUBLE_EQ(signed_area(slice_of(steps, "z=5.000001")), 16);
}

Mesh octahedron() {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

/// The plane z=0 holds four edges; x=0 four vertices; z=1 a vertex alone.
TEST(SliceMesh, PlanesThroughVerticesAndEdges) {
  const MeshSlice slice = slice_of(octahedron(), "z=0");
  ASSERT_EQ(slice.rings.size(), 1u);
  EXPECT_EQ(slice.rings[0].size(), 4u);
  EXPECT_DOUBLE_EQ(signed_area(slice), 2);
  for (const char* plane : {"x=0", "y=0", "z=50%"}) EXPECT_DOUBLE_EQ(signed_area(slice_of(octahedron(), plane)), 2);
  EXPECT_THAT(slice_of(octahedron(), "z=1").rings, IsEmpty());
  EXPECT_NEAR(signed_area(slice_of(octahedron(), "z=-0.5")), 0.5, 1e-15);
}

/// Near every height of vertices, slices have the area of the solid there, and no open line.
TEST(SliceMesh, ManyHeightsOfATurnedBox) {
  Mesh mesh = box_mesh({-1, -2, -3}, {1, 2, 3});
  for (Point& p : mesh.vertices) {
    const auto [x, y, z] = p;
    p = {0.36 * x + 0.48 * y - 0.8 * z, -0.8 * x + 0.6 * y, 0.48 * x + 0.64 * y + 0.6 * z};  // a rotation
  }
  double volume = 0, top = 0;
  for (const Point& p : mesh.vertices) top = std::max(top, p[2]);
  constexpr int kSlices = 4000;
  for (int i = 0; i < kSlices; ++i) {
    const double height = top * (2 * (i + 0.5) / kSlices - 1);
    const Result<MeshSlice> slice = slice_mesh(mesh, {2, height, false});
    ASSERT_TRUE(slice.ok());
    EXPECT_EQ(slice.value().closed_lines, 0u);
    EXPECT_EQ(slice.value().rings.size(), 1u);
    volume += signed_area(slice.value()) * 2 * top / kSlices;
  }
  // The area is a polynomial of degree two between eight heights: the rule of midpoints is exact to h^2 |A''| / 24.
  EXPECT_NEAR(volume, 48, 1e-3);
  for (const Point& p : mesh.vertices) {
    if (p[2] < 0.999 * -top) continue;  // the lowest vertex, at which there is no slice
    const Result<MeshSlice> slice = slice_mesh(mesh, {2, p[2], false});
    ASSERT_TRUE(slice.ok());
    EXPECT_EQ(slice.value().closed_lines, 0u);
  }
}

TEST(SliceMesh, OpenLinesAreClosedAndSaid) {
  Mesh mesh = box_mesh({0, 0, 0}, {2, 4, 8});
  std::erase_if(mesh.triangles, [](const Triangle& t) { return t == Triangle{4, 6, 7} || t == Triangle{4, 7, 5}; });
  const MeshSlice slice = slice_of(mesh, "z=3");
  ASSERT_EQ(slice.rings.size(), 1u);
  EXPECT_EQ(slice.closed_lines, 1u);
  EXPECT_DOUBLE_EQ(signed_area(slice), 8);
  EXPECT_THAT(slice.assumptions, ElementsAre("1 open line of the slice is closed by a straight segment."));
}

TEST(SliceMesh, FacesThatAreTurnedOverBreakLines) {
  Mesh mesh = box_mesh({0, 0, 0}, {2, 4, 8});
  for (Triangle& t : mesh.triangles) {
    if (t == Triangle{4, 6, 7} || t == Triangle{4, 7, 5}) std::swap(t[1], t[2]);
  }
  EXPECT_EQ(slice_of(mesh, "z=3").closed_lines, 2u);
}

/// Two boxes with a common edge, which four faces share: two rings, or one that touches itself.
TEST(SliceMesh, EdgesOfFourFaces) {
  Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  append(mesh, box_mesh({1, 1, 0}, {2, 2, 1}));
  const MeshSlice slice = slice_of(mesh, "z=0.5");
  EXPECT_EQ(slice.closed_lines, 0u);
  EXPECT_DOUBLE_EQ(signed_area(slice), 2);
}

TEST(SliceMesh, InvalidMeshesAreErrors) {
  const auto fault = [](const Mesh& mesh) {
    const Result<MeshSlice> slice = slice_mesh(mesh, {2, 0.5, false});
    EXPECT_FALSE(slice.ok());
    return slice.ok() ? std::string() : slice.error().message;
  };
  EXPECT_EQ(fault({}), "the mesh has no faces");
  Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.triangles[3][1] = 8;
  EXPECT_EQ(fault(mesh), "face 3 uses vertex 8 of 8");
  mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.vertices[2][0] = std::nan("");
  EXPECT_EQ(fault(mesh), "vertex 2 has a coordinate that is not finite or beyond 1e150");
}

TEST(SlicePlane, Texts) {
  const auto plane = [](const std::string& text) { return parse_slice_plane(text).value(); };
  EXPECT_EQ(plane("z=0.3").axis, 2u);
  EXPECT_EQ(plane("z=0.3").height, 0.3);
  EXPECT_EQ(plane("x=-2e3").height, -2000);
  EXPECT_EQ(plane("x=-2e3").axis, 0u);
  EXPECT_TRUE(plane("y=50%").is_share);
  EXPECT_FALSE(plane("y=50").is_share);
  for (const char* text : {"", "z", "z=", "w=1", "z=%", "z=a", "z=-1%", "z=101%", "z=1 ", "z=1e151", "z=nan", "0.3"}) {
    const Result<SlicePlane> result = parse_slice_plane(text);
    ASSERT_FALSE(result.ok()) << text;
    EXPECT_EQ(result.error().code, ErrorCode::kUsage);
    EXPECT_THAT(result.error().message, HasSubstr("planes are as z=0.3 or x=50%")) << text;
  }
}

}  // namespace
}  // namespace medial_vk
