// The outside of arrangements of several parts: no voxel with a salient medial point of the complement is dismissed, by
// independent samples (docs/theory.md, "The complement"). bench_recall does the same with 100,000 of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "reference_bridge/reference_bridge.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/medial_sampler.h"
#include "support/solids/arrangements.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using test::MedialSample;

// docs/theory.md, "Rounding", as in dismissal_test.cpp.
constexpr double kSlackOfAngle = 1e-5;
constexpr std::size_t kSamplesOfEach = 500;

/// Of the mesh as it is given, whose outside the reference makes itself.
std::vector<MedialSample> samples_outside(const PreparedMesh& mesh, double margin, double angle, std::size_t wanted) {
  test::SampleRequest request;
  request.angles = {angle + kSlackOfAngle};
  request.wanted = wanted;
  request.seed = 33;
  request.most_tries = 1000;  // outside, most points lie on no way to a medial sphere
  return test::draw_medial_samples(reference::Tree(reference::turned_over(to_reference(mesh), margin)), request);
}

std::size_t count_lost(const std::vector<MedialSample>& samples, const Extraction& extraction) {
  std::set<std::array<std::uint32_t, 3>> kept;
  for (const MedialSphere& sphere : extraction.spheres) kept.insert(sphere.voxel);
  for (const UndecidedVoxel& voxel : extraction.undecided) kept.insert(voxel.voxel);
  return static_cast<std::size_t>(std::ranges::count_if(samples, [&](const MedialSample& s) {
    const test::Voxel v = test::voxel_of(extraction.grid, s.centre);
    return !kept.contains(
        {static_cast<std::uint32_t>(v[0]), static_cast<std::uint32_t>(v[1]), static_cast<std::uint32_t>(v[2])});
  }));
}

/// Around [0, 1] x [0, 0.9], 0.3 high, each of four by three squares, so that some triangles have no open edge.
Mesh low_walls() {
  constexpr std::uint32_t kAcross = 4, kUp = 3, kAround = 4 * kAcross;
  const std::array<Point, 5> corners = {{{0, 0, 0}, {1, 0, 0}, {1, 0.9, 0}, {0, 0.9, 0}, {0, 0, 0}}};
  Mesh mesh;
  for (std::uint32_t row = 0; row <= kUp; ++row) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const Point &a = corners[i / kAcross], &b = corners[i / kAcross + 1];
      const double share = static_cast<double>(i % kAcross) / kAcross;
      mesh.vertices.push_back({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), 0.1 * row});
    }
  }
  for (std::uint32_t row = 0; row < kUp; ++row) {
    for (std::uint32_t i = 0; i < kAround; ++i) {
      const std::uint32_t a = kAround * row + i, b = kAround * row + (i + 1) % kAround;
      mesh.triangles.push_back({a, b, b + kAround});
      mesh.triangles.push_back({a, b + kAround, a + kAround});
    }
  }
  return mesh;
}

class OutsideOf : public testing::TestWithParam<std::size_t> {};

TEST_P(OutsideOf, LosesNoSalientSample) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const PreparedMesh mesh = test::prepare(test::arrangements()[GetParam()].make());
  ASSERT_TRUE(mesh.report.closed && mesh.report.intersections_known);
  ASSERT_EQ(mesh.report.intersecting_faces + mesh.report.cut_faces, 0u);
  const IndexedMesh outside = test::indexed(mesh).on_side({}).value();
  ExtractionOptions options;
  options.resolution = 48;
  const std::vector<MedialSample> samples =
      samples_outside(mesh, outside.margin(), options.object_angle, kSamplesOfEach);
  ASSERT_GE(samples.size(), kSamplesOfEach);
  const CertifiedExtraction found = test::extract_on_device(test::quick_device(), outside, options);
  SCOPED_TRACE(test::describe(found));
  EXPECT_EQ(count_lost(samples, found.extraction), 0u);
  EXPECT_LE(found.extraction.undecided.size(), found.extraction.spheres.size() / 100);
  EXPECT_TRUE(test::passes_certificate(reference::turned_over(to_reference(mesh), outside.margin()), found.extraction,
                                       options));
}

INSTANTIATE_TEST_SUITE_P(Arrangements, OutsideOf, testing::Range<std::size_t>(0, 10), [](const auto& parts) {
  std::string name = test::arrangements()[parts.param].name;
  std::ranges::replace(name, '-', '_');
  return name;
});

// Walls without floor and roof, so low that the outside reaches between them: it lies behind all of them.
TEST(OutsideOfAnOpenMesh, ReachesBetweenLowWalls) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh walls = low_walls();
  test::rotate(walls, {0.3, -0.5, 0.8}, 0.7);
  const PreparedMesh mesh = test::prepare(walls);
  ASSERT_GT(mesh.report.trusted_triangles, 0u);
  const IndexedMesh outside = test::indexed(mesh).on_side({}).value();
  ExtractionOptions options;
  options.resolution = 40;
  const std::vector<MedialSample> samples = samples_outside(mesh, outside.margin(), options.object_angle, 300);
  ASSERT_GT(samples.size(), 200u);
  const CertifiedExtraction found = test::extract_on_device(test::quick_device(), outside, options);
  SCOPED_TRACE(test::describe(found));
  EXPECT_EQ(count_lost(samples, found.extraction), 0u);
}

// Outside is where the winding number is at most 1/2, and no normal is trusted.
TEST(OutsideOfAnOpenMesh, LosesNoSalientSample) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh open = test::make_box({1, 0.6, 0.4});
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);
  test::append(open, test::moved(test::make_box({0.5, 0.3, 0.4}), {0.2, 0.1, 0.6}));
  test::rotate(open, {0.3, -0.5, 0.8}, 0.7);
  const PreparedMesh mesh = test::prepare(open);
  ASSERT_FALSE(mesh.report.closed);
  const IndexedMesh outside = test::indexed(mesh).on_side({}).value();
  ExtractionOptions options;
  options.resolution = 40;
  const std::vector<MedialSample> samples = samples_outside(mesh, outside.margin(), options.object_angle, 500);
  ASSERT_GT(samples.size(), 400u);
  const CertifiedExtraction found = test::extract_on_device(test::quick_device(), outside, options);
  SCOPED_TRACE(test::describe(found));
  EXPECT_FALSE(found.extraction.spheres.empty());
  EXPECT_EQ(count_lost(samples, found.extraction), 0u);
  EXPECT_TRUE(test::passes_certificate(reference::turned_over(to_reference(mesh), outside.margin()), found.extraction,
                                       options));
}

}  // namespace
}  // namespace medial_vk
