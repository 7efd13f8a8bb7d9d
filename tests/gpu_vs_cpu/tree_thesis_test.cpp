// The published method on the device against the reference in double precision: the same voxels level by level, points
// in the same voxels, every ball certified.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "cpu_reference/extract.h"
#include "medial_vk/bvh.h"
#include "medial_vk/certify.h"
#include "medial_vk/extraction.h"
#include "support/device/device_test.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kResolution = 20;

class TreeThesisTest : public test::DeviceTest {};

struct Solid {
  std::string name;
  Mesh mesh;
  std::vector<std::uint8_t> flags;

  MeshView view() const { return {mesh.vertices, mesh.triangles, flags, true}; }
};

std::vector<Solid> solids() {
  std::vector<Solid> all = {{"box", test::make_box({1, 2, 3}), {}},
                            {"spheroid", test::make_ellipsoid({1, 1, 0.5}, 40), {}},
                            {"cup", test::make_cup(1, 0.25, 1.5, 40), {}},
                            {"L", test::make_l_shape(2, 0.5, 1), {}},
                            {"plate", test::make_plate_with_hole(2, 0.1, 0.7), {}}};
  for (Solid& solid : all) {
    test::rotate(solid.mesh, {1, 2, 3}, 0.7);
    solid.flags.assign(solid.mesh.triangles.size(), kTrustedNormal);
  }
  return all;
}

ExtractionOptions thesis_options() {
  ExtractionOptions options;
  options.mode = Mode::kThesis;
  options.resolution = kResolution;
  return options;
}

reference::Result extract_with_reference(const Mesh& mesh, const ExtractionOptions& options) {
  reference::Options p;
  p.certified = false;
  p.resolution = static_cast<int>(options.resolution);
  p.radius = options.radius;
  p.narrow_features = options.thesis.narrow_features;
  return reference::extract(test::to_reference(mesh), p);
}

using Voxel = std::array<int, 3>;

/// Voxels in which only one of the two has a point.
int voxels_apart(const Extraction& device, const reference::Result& truth) {
  std::map<Voxel, int> seen;
  for (const MedialSphere& s : device.spheres) {
    seen[{static_cast<int>(s.voxel[0]), static_cast<int>(s.voxel[1]), static_cast<int>(s.voxel[2])}] += 1;
  }
  for (const reference::Sphere& s : truth.spheres) seen[{s.voxel[0], s.voxel[1], s.voxel[2]}] += 2;
  return static_cast<int>(std::count_if(seen.begin(), seen.end(), [](const auto& voxel) { return voxel.second != 3; }));
}

/// Float and double decide differently if a number is within rounding of its threshold: for a few of a thousand cells.
void expect_close(std::uint64_t device, std::uint64_t truth) {
  const auto larger = static_cast<double>(std::max(device, truth));
  EXPECT_LE(std::abs(static_cast<double>(device) - static_cast<double>(truth)), 1 + larger / 200);
}

void expect_same_levels(const Extraction& device, const reference::Result& truth) {
  ASSERT_EQ(device.measurements.counters.levels.size(), truth.levels.size());
  for (std::size_t level = 0; level < truth.levels.size(); ++level) {
    expect_close(device.measurements.counters.levels[level].visited, truth.levels[level].visited);
    expect_close(device.measurements.counters.levels[level].kept, truth.levels[level].kept);
  }
}

CertificateReport certify(const Solid& solid, const ExtractionOptions& options, Extraction& extraction) {
  return certify_spheres(test::indexed(solid.view()), options, extraction).value();
}

TEST_F(TreeThesisTest, FindsWhatTheReferenceFinds) {
  for (const Solid& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const ExtractionOptions options = thesis_options();
    auto device = test::extract_spheres(*context_, solid.view(), options);
    ASSERT_TRUE(device.ok()) << device.error().message;
    Extraction& found = device.value();
    const reference::Result truth = extract_with_reference(solid.mesh, options);
    ASSERT_GT(truth.spheres.size(), 100u);
    expect_same_levels(found, truth);
    // A point within epsilon of a face of its voxel may be found on the other side of it: 3 pairs of faces, 2 epsilon.
    EXPECT_LE(voxels_apart(found, truth), static_cast<int>(truth.spheres.size()) / 50 + 1);
    const CertificateReport report = certify(solid, options, found);
    EXPECT_LE(report.rejected, found.spheres.size() / 200);
  }
}

TEST_F(TreeThesisTest, WithoutNarrowFeatures) {
  const Solid solid = solids()[0];
  ExtractionOptions options = thesis_options();
  options.thesis.narrow_features = false;
  const auto found = test::extract_spheres(*context_, solid.view(), options).value();
  const reference::Result truth = extract_with_reference(solid.mesh, options);
  expect_same_levels(found, truth);
  EXPECT_LE(voxels_apart(found, truth), static_cast<int>(truth.spheres.size()) / 50 + 1);
  // 2.4.3: no sphere smaller than (1 - sqrt(3)/2) voxels is found.
  for (const MedialSphere& s : found.spheres) EXPECT_GT(s.radius, 0.13 * found.grid.voxel_size);
}

TEST_F(TreeThesisTest, RadiusThreshold) {
  const Solid solid = solids()[3];
  ExtractionOptions options = thesis_options();
  const std::size_t by_angle = test::extract_spheres(*context_, solid.view(), options).value().spheres.size();
  options.radius = 0.11;
  auto found = test::extract_spheres(*context_, solid.view(), options).value();
  EXPECT_GE(found.spheres.size(), by_angle);
  EXPECT_LE(certify(solid, options, found).rejected, found.spheres.size() / 200);
}

TEST_F(TreeThesisTest, PointsAreSortedAndTheSameEveryTime) {
  const Solid solid = solids()[1];
  const auto first = test::extract_spheres(*context_, solid.view(), thesis_options()).value();
  const auto second = test::extract_spheres(*context_, solid.view(), thesis_options()).value();
  ASSERT_EQ(first.spheres.size(), second.spheres.size());
  std::array<std::uint32_t, 3> last = {};
  for (std::size_t i = 0; i < first.spheres.size(); ++i) {
    EXPECT_EQ(first.spheres[i].centre, second.spheres[i].centre);
    EXPECT_EQ(first.spheres[i].spoke_b, second.spheres[i].spoke_b);
    const std::array<std::uint32_t, 3> v = first.spheres[i].voxel;
    if (i > 0) {
      EXPECT_TRUE(std::lexicographical_compare(last.rbegin(), last.rend(), v.rbegin(), v.rend()));
    }
    last = v;
  }
}

// A small budget cuts the grid into many chunks; the points are the same.
TEST_F(TreeThesisTest, ChunksDoNotChangeTheResult) {
  const Solid solid = solids()[2];
  ExtractionOptions options = thesis_options();
  const auto whole = test::extract_spheres(*context_, solid.view(), options).value();
  // Devices with memory of their own need more, for copies.
  Result<Extraction> divided = Error{ErrorCode::kOutOfMemory, ""};
  const std::uint64_t most = context_->device().type == "cpu" ? 8u << 20 : 64u << 20;
  for (options.memory_budget = 8u << 20; !divided.ok() && options.memory_budget <= most; options.memory_budget *= 2) {
    divided = test::extract_spheres(*context_, solid.view(), options);
    ASSERT_TRUE(divided.ok() || divided.error().code == ErrorCode::kOutOfMemory) << divided.error().message;
  }
  ASSERT_TRUE(divided.ok()) << divided.error().message;
  const Extraction& parts = divided.value();
  ASSERT_EQ(whole.spheres.size(), parts.spheres.size());
  for (std::size_t i = 0; i < whole.spheres.size(); ++i) EXPECT_EQ(whole.spheres[i].centre, parts.spheres[i].centre);
  EXPECT_EQ(whole.measurements.counters.queries, parts.measurements.counters.queries);
  ASSERT_EQ(whole.measurements.counters.levels.size(), parts.measurements.counters.levels.size());
  for (std::size_t level = 0; level < whole.measurements.counters.levels.size(); ++level) {
    const ExtractionCounters::Level &one = whole.measurements.counters.levels[level],
                                    &many = parts.measurements.counters.levels[level];
    EXPECT_EQ(one.node_tests, many.node_tests) << "level " << level;
    EXPECT_EQ(one.triangle_tests, many.triangle_tests) << "level " << level;
    // Every visited cell queries its nearest triangle, with a walk of its own.
    EXPECT_GE(one.node_tests, 2 * one.visited) << "level " << level;
    EXPECT_GE(one.triangle_tests, one.visited) << "level " << level;
  }
  options.memory_budget = 1u << 10;
  EXPECT_EQ(test::extract_spheres(*context_, solid.view(), options).error().code, ErrorCode::kOutOfMemory);
}

TEST_F(TreeThesisTest, CanBeInterrupted) {
  const Solid solid = solids()[0];
  std::stop_source stop;
  const auto stopped = test::extract_spheres(
      *context_, solid.view(), thesis_options(), [&](double) { stop.request_stop(); }, stop.get_token());
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
}

TEST_F(TreeThesisTest, CoarseGridsHaveFewerLevels) {
  const Solid solid = solids()[0];
  ExtractionOptions options = thesis_options();
  for (const std::uint32_t resolution : {1u, 2u, 3u, 5u, 9u}) {
    options.resolution = resolution;
    auto found = test::extract_spheres(*context_, solid.view(), options);
    ASSERT_TRUE(found.ok()) << found.error().message;
    expect_same_levels(found.value(), extract_with_reference(solid.mesh, options));
    EXPECT_EQ(certify(solid, options, found.value()).rejected, 0u);
  }
}

// One face is missing: the side of no whole cell can be proved, but points lie where the winding number means inside.
TEST_F(TreeThesisTest, OpenMesh) {
  Solid solid = solids()[0];
  solid.mesh.triangles.pop_back();
  solid.flags.assign(solid.mesh.triangles.size(), 0);
  MeshView view = solid.view();
  view.closed = false;
  const auto found = test::extract_spheres(*context_, view, thesis_options());
  ASSERT_TRUE(found.ok()) << found.error().message;
  EXPECT_GT(found.value().spheres.size(), 100u);
}

}  // namespace
}  // namespace medial_vk
