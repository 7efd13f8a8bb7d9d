// The outside of a mesh on the device: against the independent reference, and against exact bisectors of boxes, points
// and balls (docs/theory.md, "The complement").
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "reference_bridge/reference_bridge.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/arrangements.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

struct Found {
  PreparedMesh mesh;
  double margin = 0;
  CertifiedExtraction result;

  const std::vector<MedialSphere>& spheres() const { return result.extraction.spheres; }
  const VoxelGrid& grid() const { return result.extraction.grid; }
  reference::Mesh complement() const { return reference::turned_over(to_reference(mesh), margin); }
};

Found find_outside(Mesh mesh, const ExtractionOptions& options, double margin = 0) {
  Found found;
  found.mesh = test::prepare(std::move(mesh));
  const IndexedMesh outside = test::indexed(found.mesh).on_side({MeshSide::kOutside, margin}).value();
  found.margin = outside.margin();
  found.result = test::extract_on_device(test::quick_device(), outside, options);
  EXPECT_TRUE(test::passes_certificate(found.complement(), found.result.extraction, options));
  EXPECT_EQ(found.result.extraction.side, MeshSide::kOutside);
  return found;
}

double epsilon_of(const Found& found, const ExtractionOptions& options) {
  return options.epsilon * found.grid().voxel_size;
}

// As in certified_test.cpp: points clearly above the threshold and clearly in their voxel that are neither found nor
// undecided on the other side.
std::size_t count_unexplained(const Extraction& there, const Extraction& here, const ExtractionOptions& options) {
  const test::SphereByVoxel found = test::spheres_by_voxel(there);
  std::set<test::Voxel> undecided;
  for (const UndecidedVoxel& u : there.undecided) {
    undecided.insert({static_cast<int>(u.voxel[0]), static_cast<int>(u.voxel[1]), static_cast<int>(u.voxel[2])});
  }
  std::size_t missing = 0;
  for (const auto& [voxel, index] : test::spheres_by_voxel(here)) {
    if (found.contains(voxel) || undecided.contains(voxel)) continue;
    const MedialSphere& s = here.spheres[index];
    const bool salient = double{s.object_angle} >= options.object_angle + 0.05;
    if (!salient || test::depth_in_voxel(here.grid, test::to_eigen(s.centre)) <= options.epsilon) continue;
    ++missing;
  }
  return missing;
}

class OutsideOnDevice : public testing::TestWithParam<std::size_t> {};

TEST_P(OutsideOnDevice, AgreesWithTheReference) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  ExtractionOptions options;
  options.resolution = 24;
  const Found found = find_outside(test::arrangements()[GetParam()].make(), options);
  SCOPED_TRACE(test::describe(found.result));
  const Extraction reference = from_reference(reference::extract(found.complement(), to_reference(options)));
  EXPECT_FALSE(found.spheres().empty());
  EXPECT_EQ(found.grid().size, reference.grid.size);
  EXPECT_EQ(count_unexplained(found.result.extraction, reference, options), 0u) << "found by the reference only";
  EXPECT_EQ(count_unexplained(reference, found.result.extraction, options), 0u) << "found by the device only";
}

INSTANTIATE_TEST_SUITE_P(Arrangements, OutsideOnDevice, testing::Values(0, 2, 3, 5, 8), [](const auto& parts) {
  std::string name = test::arrangements()[parts.param].name;
  std::ranges::replace(name, '-', '_');
  return name;
});

// Every point outside of a convex solid has one closest point: there is nothing to find, and that is proved.
TEST(OutsideOfConvex, HasNoPoint) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  ExtractionOptions options;
  options.resolution = 32;
  Mesh box = test::make_box({1, 0.7, 0.4});
  test::rotate(box, {0.3, 0.5, 0.8}, 0.7);
  for (const Mesh& mesh : {box, test::make_sphere(1, 320)}) {
    const Found found = find_outside(mesh, options);
    EXPECT_TRUE(found.spheres().empty());
    EXPECT_TRUE(found.result.extraction.undecided.empty());
  }
}

// Between the faces of two boxes the medial surface is the plane in the middle.
TEST(OutsideOfBoxes, HoldsTheMiddlePlaneOfAGap) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh boxes = test::make_box({1, 1, 0.3});
  test::append(boxes, test::moved(test::make_box({1, 1, 0.3}), {0, 0, 0.5}));  // a gap of 0.2
  ExtractionOptions options;
  options.resolution = 50;
  const Found found = find_outside(std::move(boxes), options, 0.317);
  const double voxel = found.grid().voxel_size, epsilon = epsilon_of(found, options);
  ASSERT_GT(std::fabs(std::remainder(0.4 - found.grid().origin[2], voxel)), 0.05 * voxel) << "in a face of voxels";
  const auto is_between = [&](double x, double y) { return std::min({x, y, 1 - x, 1 - y}) > voxel; };
  std::set<std::array<std::uint32_t, 2>> between;
  for (const MedialSphere& s : found.spheres()) {
    const auto [x, y, z] = s.centre;
    if (!is_between(x, y) || std::fabs(z - 0.4) > 0.1) continue;
    between.insert({s.voxel[0], s.voxel[1]});
    EXPECT_NEAR(z, 0.4, epsilon);
    EXPECT_NEAR(s.radius, 0.1, epsilon);
    EXPECT_NEAR(double{s.object_angle}, std::numbers::pi / 2, 1e-3);
  }
  // Every voxel of the plane has a point.
  std::size_t expected = 0;
  for (std::uint32_t i = 0; i < found.grid().size[0]; ++i) {
    for (std::uint32_t j = 0; j < found.grid().size[1]; ++j) {
      const double x = found.grid().origin[0] + i * voxel, y = found.grid().origin[1] + j * voxel;
      if (!is_between(x, y) || !is_between(x + voxel, y + voxel)) continue;
      ++expected;
      EXPECT_TRUE(between.contains({i, j})) << "column " << i << ", " << j;
    }
  }
  EXPECT_GT(expected, 500u);
}

// Along the axes, with the usual margin and resolutions that are multiples of four. With half of the longest side on
// all sides, faces and medial planes would lie in faces of voxels; the search of the inside would then take minutes.
TEST(OutsideOfBoxes, AlongTheAxesIsSearchedWithTheUsualMargin) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh pair = test::make_box({1, 0.5, 0.25});
  test::append(pair, test::moved(test::make_box({1, 0.5, 0.25}), {0, 0, 0.5}));
  for (const std::uint32_t resolution : {40u, 80u}) {
    ExtractionOptions options;
    options.resolution = resolution;
    const Found box = find_outside(test::make_box({1, 0.5, 0.25}), options);
    EXPECT_TRUE(box.spheres().empty());
    EXPECT_TRUE(box.result.extraction.undecided.empty());
    const IndexedMesh inside = test::indexed(box.mesh).on_side({MeshSide::kInside}).value();
    const CertifiedExtraction within = test::extract_on_device(test::quick_device(), inside, options);
    EXPECT_FALSE(within.extraction.spheres.empty());
    EXPECT_TRUE(within.extraction.undecided.empty());
    EXPECT_GT(find_outside(test::make_l_shape(1, 0.25, 0.5), options).spheres().size(), 10u) << "in the notch";
    const Found boxes = find_outside(pair, options);
    EXPECT_TRUE(boxes.result.extraction.undecided.empty());
    // In a face of voxels, the plane in the middle of the gap would have points on both sides of the face.
    std::size_t points = 0;
    std::set<std::array<std::uint32_t, 2>> columns;
    for (const MedialSphere& s : boxes.spheres()) {
      if (std::fabs(s.centre[2] - 0.375) > epsilon_of(boxes, options)) continue;
      ++points;
      columns.insert({s.voxel[0], s.voxel[1]});
    }
    EXPECT_GT(columns.size(), 50u);
    EXPECT_EQ(points, columns.size());
  }
}

// Tetrahedra as small as points: the medial surface is the Voronoi diagram of the points, up to their size.
TEST(OutsideOfPoints, IsTheirVoronoiDiagram) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  constexpr std::size_t kPoints = 8;
  constexpr double kEdge = 1e-3;
  const Mesh mesh = test::make_points(kPoints, kEdge);
  std::array<Point, kPoints> sites{};
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) sites[i / 4] = sites[i / 4] + 0.25 * mesh.vertices[i];
  ExtractionOptions options;
  options.resolution = 40;
  const Found found = find_outside(mesh, options, 0.25);
  const double epsilon = epsilon_of(found, options);
  const auto two_nearest = [&](const Point& p) {
    std::array<double, kPoints> distances;
    for (std::size_t i = 0; i < kPoints; ++i) distances[i] = length(p - sites[i]);
    std::ranges::partial_sort(distances, distances.begin() + 2);
    return std::pair(distances[0], distances[1]);
  };
  ASSERT_GT(found.spheres().size(), 500u);
  for (const MedialSphere& s : found.spheres()) {
    const auto [first, second] = two_nearest(s.centre);
    // A tetrahedron reaches 0.62 of its edge from its middle.
    EXPECT_LE(second - first, 2 * (epsilon + 0.62 * kEdge));
  }
  // Points of the diagram, on the bisectors of two sites that are the nearest there.
  std::set<test::Voxel> kept;
  for (const auto& [v, index] : test::spheres_by_voxel(found.result.extraction)) kept.insert(v);
  for (const UndecidedVoxel& u : found.result.extraction.undecided) {
    kept.insert({static_cast<int>(u.voxel[0]), static_cast<int>(u.voxel[1]), static_cast<int>(u.voxel[2])});
  }
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  std::size_t tried = 0, lost = 0;
  for (int i = 0; i < 400000 && tried < 2000; ++i) {
    Point p;
    for (double& x : p) x = share(engine);
    const Point &a = sites[engine() % kPoints], &b = sites[engine() % kPoints];
    if (a == b) continue;
    const Point across = (1 / length(b - a)) * (b - a);
    p = p - dot(p - 0.5 * (a + b), across) * across;
    const auto [first, second] = two_nearest(p);
    const double angle = std::asin(0.5 * length(b - a) / length(p - a));
    const bool is_nearest = length(p - a) < first + 1e-9 && second < first + 1e-9;
    // The size of the tetrahedra moves the surface by no more than 0.62 edges over the sine of the object angle.
    const test::Voxel voxel = test::voxel_of(found.grid(), test::to_eigen(p));
    bool in_box = true;
    for (std::size_t k = 0; k < 3; ++k) in_box &= voxel[k] >= 0 && voxel[k] < static_cast<int>(found.grid().size[k]);
    const double clear = 0.62 * kEdge / std::sin(angle) + epsilon;
    if (!is_nearest || !in_box || angle < options.object_angle + 0.05) continue;
    if (test::depth_in_voxel(found.grid(), test::to_eigen(p)) * found.grid().voxel_size < 2 * clear) continue;
    ++tried;
    lost += kept.contains(voxel) ? 0 : 1;
  }
  EXPECT_EQ(tried, 2000u);
  EXPECT_EQ(lost, 0u);
}

// Two balls of different sizes: a sheet of a hyperboloid, up to the sagitta of their facets. Spheres reach beyond the
// box in which their centres lie.
TEST(OutsideOfBalls, IsAHyperboloid) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Point a = {0, 0, 0}, b = {1.3, 0.4, 0.2};
  Mesh balls = test::make_sphere(0.5, 2000);
  test::append(balls, test::moved(test::make_sphere(0.25, 2000), b));
  // The distance of the facets from the middle is least at the middle of a facet: that of no vertex, and of no point
  // nearer than the inscribed sphere.
  double sagitta = 0;
  for (const Triangle& t : balls.triangles) {
    const std::array<Point, 3> c = {balls.vertices[t[0]], balls.vertices[t[1]], balls.vertices[t[2]]};
    const bool is_first = length(c[0] - a) < 0.6;
    const Point normal = cross(c[1] - c[0], c[2] - c[0]);
    const double depth = dot(c[0] - (is_first ? a : b), normal) / length(normal);
    sagitta = std::max(sagitta, (is_first ? 0.5 : 0.25) - depth);
  }
  ASSERT_LT(sagitta, 0.01);
  ExtractionOptions options;
  options.resolution = 50;
  const Found found = find_outside(std::move(balls), options);
  ASSERT_GT(found.spheres().size(), 300u);
  std::size_t beyond = 0;
  for (const MedialSphere& s : found.spheres()) {
    const double from_a = length(s.centre - a) - 0.5, from_b = length(s.centre - b) - 0.25;
    EXPECT_LE(std::fabs(from_a - from_b), 2 * epsilon_of(found, options) + sagitta);
    EXPECT_GE(s.radius, std::min(from_a, from_b) - 1e-6);
    const Point lower = found.grid().origin;
    beyond += s.centre[2] - s.radius < lower[2] || s.centre[1] - s.radius < lower[1] ? 1 : 0;
  }
  EXPECT_GT(beyond, 0u);
}

// A cavity belongs to the outside, although no way leads there; the outer side of a round shell has no medial point.
TEST(OutsideOfAShell, IsItsCavity) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  ExtractionOptions options;
  options.resolution = 41;
  options.object_angle = 0.3;
  const Found found = find_outside(test::make_shell(320, 320), options, 0.05);
  EXPECT_FALSE(found.spheres().empty());
  for (const MedialSphere& s : found.spheres()) EXPECT_LT(length(s.centre) + s.radius, 0.7 + 1e-9);
}

// One box for both sides gives one grid, and the larger box does not change what is inside.
TEST(BothSides, ShareAGrid) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const IndexedMesh mesh = test::indexed(test::prepare(test::arrangements()[0].make()));
  ExtractionOptions options;
  options.resolution = 40;
  const IndexedMesh sides[] = {mesh.on_side({MeshSide::kInside, 0.3}).value(),
                               mesh.on_side({MeshSide::kOutside, 0.3}).value()};
  std::array<CertifiedExtraction, 2> found;
  for (std::size_t i = 0; i < 2; ++i) found[i] = test::extract_on_device(test::quick_device(), sides[i], options);
  EXPECT_EQ(found[0].extraction.grid.origin, found[1].extraction.grid.origin);
  EXPECT_EQ(found[0].extraction.grid.voxel_size, found[1].extraction.grid.voxel_size);
  EXPECT_EQ(found[0].extraction.grid.size, found[1].extraction.grid.size);
  EXPECT_FALSE(found[0].extraction.spheres.empty());
  EXPECT_FALSE(found[1].extraction.spheres.empty());
  for (const MedialSphere& s : found[0].extraction.spheres) {
    EXPECT_TRUE(reference::is_inside(reference::Tree(to_reference(mesh.prepared())), test::to_eigen(s.centre)));
  }
}

}  // namespace
}  // namespace medial_vk
