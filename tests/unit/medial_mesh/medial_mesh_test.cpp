// The medial mesh of points that are placed by hand, and its files.
#include "medial_vk/medial_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <sstream>

#include "output/medial_formats/encode_medial_mesh.h"

namespace medial_vk {
namespace {

using Eq = std::array<double, 3>;

/// One point in every voxel that the plane through `through` across `normal` passes, at a random position of the plane
/// in it, wherever `wanted` holds.
std::vector<MedialSphere> plane(const Eq& normal, const Eq& through, const std::function<bool(const Point&)>& wanted,
                                std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> in_voxel(0, 1);
  const double norm = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  std::vector<MedialSphere> out;
  for (std::uint32_t z = 1; z < 24; ++z) {
    for (std::uint32_t y = 1; y < 24; ++y) {
      for (std::uint32_t x = 1; x < 24; ++x) {
        for (int attempt = 0; attempt < 200; ++attempt) {
          Point p = {x + in_voxel(random), y + in_voxel(random), z + in_voxel(random)};
          double off = 0;
          for (std::size_t i = 0; i < 3; ++i) off += normal[i] / norm * (p[i] - through[i]);
          for (std::size_t i = 0; i < 3; ++i) p[i] -= off * normal[i] / norm;
          if (std::floor(p[0]) != x || std::floor(p[1]) != y || std::floor(p[2]) != z || !wanted(p)) continue;
          MedialSphere s;
          s.voxel = {x, y, z};
          s.centre = p;
          s.radius = 5;
          for (std::size_t i = 0; i < 3; ++i) s.spoke_a[i] = static_cast<float>(normal[i] / norm);
          for (std::size_t i = 0; i < 3; ++i) s.spoke_b[i] = -s.spoke_a[i];
          out.push_back(s);
          break;
        }
      }
    }
  }
  return out;
}

bool within(const Point& p, double least, double greatest) {
  const double r = std::hypot(std::hypot(p[0] - 12.5, p[1] - 12.5), p[2] - 12.5);
  return r >= least && r <= greatest;
}

struct Meshed {
  std::vector<MedialSphere> spheres;
  Sheets sheets;
  MedialMesh mesh;
};

Meshed meshed(std::vector<MedialSphere> spheres, const SheetOptions& options = {}) {
  Meshed out;
  out.sheets = find_sheets(spheres, {{0, 0, 0}, 1, {32, 32, 32}}, ExtractionOptions(), options).value();
  out.mesh = make_medial_mesh(spheres, out.sheets, {1, 0.01, 1}).value();
  out.spheres = std::move(spheres);
  return out;
}

// A flat sheet is a triangulated disc, for any direction and any positions of points in their voxels: no doubled
// layers, no holes.
TEST(MedialMesh, AFlatSheetIsADisc) {
  const Eq normals[] = {{0, 0, 1}, {1, 1, 0}, {1, 1, 1}, {0.3, 0.5, 0.8}, {0.1, 0.02, 1}, {0.9, 0.4, 0.1}};
  for (const Eq& normal : normals) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) {
      const Meshed m = meshed(plane(
          normal, {12.4, 12.3, 12.6}, [](const Point& p) { return within(p, 0, 9); }, seed));
      SCOPED_TRACE(testing::PrintToString(normal));
      EXPECT_EQ(m.sheets.sheets.size(), 1u);
      EXPECT_EQ(m.mesh.topology.betti.components, 1u);
      EXPECT_EQ(m.mesh.topology.euler_characteristic, 1);
      EXPECT_EQ(m.mesh.topology.non_manifold_edges, 0u);
      EXPECT_GT(m.mesh.topology.boundary_edges, 30u);
      EXPECT_EQ(m.sheets.seam_points, 0u);
    }
  }
}

TEST(MedialMesh, AFlatRingHasAHole) {
  std::vector<MedialSphere> ring = plane(
      {0.3, 0.5, 0.8}, {12.4, 12.3, 12.6}, [](const Point& p) { return within(p, 4, 10); }, 1);
  for (MedialSphere& s : ring) s.radius = 2;  // those of 5 cover the hole
  const Meshed m = meshed(std::move(ring));
  EXPECT_EQ(m.mesh.topology.betti, (BettiNumbers{1, 1, 0}));
  EXPECT_EQ(m.mesh.topology.betti.components, 1u);
  EXPECT_EQ(m.mesh.topology.euler_characteristic, 0);
  EXPECT_EQ(m.mesh.topology.non_manifold_edges, 0u);
}

// Half of a plane that ends on another: a T of two sheets, which is one disc with a fin.
TEST(MedialMesh, AFinJoinsItsHost) {
  std::vector<MedialSphere> spheres = plane(
      {0, 0, 1}, {12.4, 12.3, 12.6}, [](const Point& p) { return within(p, 0, 9); }, 1);
  for (const MedialSphere& s : plane(
           {1, 0, 0}, {12.4, 12.3, 12.6}, [](const Point& p) { return within(p, 0, 8) && p[2] > 13; }, 2)) {
    spheres.push_back(s);
  }
  const Meshed m = meshed(std::move(spheres));
  EXPECT_EQ(m.sheets.sheets.size(), 2u);
  EXPECT_GT(m.sheets.seam_points, 20u);
  EXPECT_EQ(m.mesh.topology.betti.components, 1u);
  EXPECT_GT(m.mesh.topology.non_manifold_edges, 10u) << "the seam";
  EXPECT_NEAR(static_cast<double>(m.mesh.topology.euler_characteristic), 1, 2);
  bool seam_edge = false;
  for (std::size_t i = 0; i < m.mesh.edges.size(); ++i) {
    const auto& [a, b] = m.mesh.edges[i];
    const bool across = m.sheets.of_point[a] != m.sheets.of_point[b];
    EXPECT_TRUE(!across || (m.mesh.edge_marks[i] & kSeam));
    seam_edge = seam_edge || across;
  }
  EXPECT_TRUE(seam_edge);
}

// A row of points, as on the axis of a tube: a curve, closed or not. Their balls, grown by a voxel, bridge a gap of one
// voxel, but not of three.
TEST(MedialMesh, CurvesStayCurves) {
  std::vector<MedialSphere> ring;
  for (std::uint32_t y = 4; y <= 16; ++y) {
    for (std::uint32_t x = 4; x <= 16; ++x) {
      if (x != 4 && x != 16 && y != 4 && y != 16) continue;
      MedialSphere s;
      s.voxel = {x, y, 5};
      s.centre = {x + 0.5, y + 0.5, 5.5};
      s.radius = 0.6;
      s.spoke_a = {0, 0, 1};
      s.spoke_b = {0, 0, -1};
      ring.push_back(s);
    }
  }
  EXPECT_EQ(meshed(ring).mesh.topology.euler_characteristic, 0);
  EXPECT_EQ(meshed(ring).mesh.topology.bare_edges + 8, ring.size()) << "the four corners are triangles";
  ring.resize(ring.size() - 3);
  EXPECT_EQ(meshed(ring).mesh.topology.euler_characteristic, 1);
  EXPECT_EQ(meshed(ring).mesh.topology.betti.components, 1u);
}

TEST(MedialMesh, EveryPartIsThereOnceAndSidesOfTrianglesAreEdges) {
  const Meshed m = meshed(plane(
      {0.3, 0.5, 0.8}, {12.4, 12.3, 12.6}, [](const Point& p) { return within(p, 0, 9); }, 1));
  ASSERT_TRUE(std::is_sorted(m.mesh.edges.begin(), m.mesh.edges.end()));
  EXPECT_EQ(std::adjacent_find(m.mesh.edges.begin(), m.mesh.edges.end()), m.mesh.edges.end());
  EXPECT_EQ(std::adjacent_find(m.mesh.triangles.begin(), m.mesh.triangles.end()), m.mesh.triangles.end());
  for (const Triangle& t : m.mesh.triangles) {
    for (const MeshEdge& side : {MeshEdge{t[0], t[1]}, MeshEdge{t[0], t[2]}, MeshEdge{t[1], t[2]}}) {
      EXPECT_TRUE(std::binary_search(m.mesh.edges.begin(), m.mesh.edges.end(), side));
    }
  }
}

TEST(MedialMesh, DoesNotDependOnTheOrderOfPoints) {
  // On a lattice, so that ties are decided, too.
  std::vector<MedialSphere> spheres;
  for (std::uint32_t i = 0; i < 200; ++i) {
    MedialSphere s;
    s.voxel = {2 + i % 10, 3 + i / 10 % 10, 5 + i / 100};
    s.centre = {s.voxel[0] + 0.5, s.voxel[1] + 0.5, s.voxel[2] + 0.5};
    s.radius = 3;
    s.spoke_a = {0, 0, 1};
    s.spoke_b = {0, 0, -1};
    spheres.push_back(s);
  }
  const MedialMesh mesh = meshed(spheres).mesh;
  std::vector<std::uint32_t> order(spheres.size());
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937 random(5);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<MedialSphere> shuffled;
  for (const std::uint32_t i : order) shuffled.push_back(spheres[i]);
  std::vector<Triangle> triangles = meshed(shuffled).mesh.triangles;
  for (Triangle& t : triangles) {
    for (std::uint32_t& corner : t) corner = order[corner];
    std::sort(t.begin(), t.end());
  }
  std::sort(triangles.begin(), triangles.end());
  EXPECT_EQ(triangles, mesh.triangles);
  EXPECT_EQ(mesh.topology.betti, (BettiNumbers{1, 0, 0}));
}

// A point beside another, and a ball that others hide: each has one edge.
TEST(MedialMesh, PointsWithoutAPlaceInTheComplexAreHosted) {
  std::vector<MedialSphere> spheres = plane(
      {0, 0, 1}, {12.4, 12.3, 12.6}, [](const Point& p) { return within(p, 0, 6); }, 1);
  const MedialTopology before = meshed(spheres).mesh.topology;
  ASSERT_EQ(before.hosted_points, 0u);
  MedialSphere small = spheres[40];
  small.voxel[2] += 1;
  small.centre[2] = 13.1;
  small.radius = 0.5;
  spheres.push_back(small);
  const Meshed m = meshed(std::move(spheres));
  EXPECT_EQ(m.mesh.topology.hosted_points, 1u);
  EXPECT_EQ(m.mesh.topology.betti, before.betti);
  const auto last = static_cast<std::uint32_t>(m.spheres.size() - 1);
  EXPECT_EQ(std::ranges::count_if(m.mesh.edges, [&](const MeshEdge& e) { return e[0] == last || e[1] == last; }), 1);
}

TEST(MedialMesh, NoPointsAreNoMesh) {
  const MedialMesh mesh = meshed({}).mesh;
  EXPECT_TRUE(mesh.edges.empty() && mesh.triangles.empty());
  EXPECT_EQ(mesh.topology.betti, BettiNumbers());
}

TEST(MedialMesh, FilesHoldEveryNumber) {
  const Meshed m = meshed(plane(
      {0.3, 0.5, 0.8}, {12.4, 12.3, 12.6}, [](const Point& p) { return within(p, 0, 6); }, 1));
  std::istringstream ma(encode_medial_mesh_ma(m.spheres, m.mesh));
  std::size_t points = 0, edges = 0, triangles = 0;
  ma >> points >> edges >> triangles;
  ASSERT_EQ(points, m.spheres.size());
  ASSERT_EQ(edges, m.mesh.edges.size());
  ASSERT_EQ(triangles, m.mesh.triangles.size());
  std::string kind;
  for (const MedialSphere& s : m.spheres) {
    double x = 0, y = 0, z = 0, r = 0;
    ma >> kind >> x >> y >> z >> r;
    ASSERT_EQ(kind, "v");
    EXPECT_EQ((Point{x, y, z}), s.centre);
    EXPECT_EQ(r, s.radius);
  }
  const std::string text = encode_medial_mesh("mesh.PLY", MedialHeader(), m.spheres, m.sheets, m.mesh, true);
  EXPECT_THAT(text, testing::StartsWith("ply\nformat ascii 1.0\n"));
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(text.substr(text.find("end_header\n") + 11), '\n')),
            points + edges + triangles);
}

}  // namespace
}  // namespace medial_vk
