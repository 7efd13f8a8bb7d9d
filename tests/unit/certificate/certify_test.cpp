// The certificate in double: balls that pass, are repaired, and are dropped.
#include "medial_vk/certify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kResolution = 40;
constexpr double kLongest = 4;

/// A slab 4 x 4 x 1 at an offset: the middle of its thickness is its main medial sheet, object angle pi/2.
class CertifyTest : public testing::TestWithParam<double> {
 protected:
  static IndexedMesh slab_at(double offset) {
    Mesh mesh = test::make_box({4, 4, 1});
    test::translate(mesh, {offset, -offset, offset});
    return test::indexed(MeshView{mesh.vertices, mesh.triangles, {}, true});
  }

  CertifyTest() : offset_(GetParam()), indexed_(slab_at(offset_)) {
    options_.resolution = kResolution;
    extraction_.grid.origin = indexed_.bvh().nodes()[0].box.lower;
    extraction_.grid.voxel_size = kLongest / kResolution;
    extraction_.grid.size = {kResolution, kResolution, kResolution / 4};
  }

  /// A sphere near (x, y, z) of the slab, with the spokes of its middle.
  MedialSphere sphere_at(double x, double y, double z) const {
    MedialSphere s;
    s.centre = {offset_ + x, -offset_ + y, offset_ + z};
    s.radius = std::min(z, 1 - z) * (1 + 1e-6);  // too large, as a float may be
    const float down = z <= 0.5 ? -1.0f : 1.0f;
    s.spoke_a = {0, 0, down};
    s.spoke_b = {0, 0, -down};
    s.object_angle = 1.5f;
    for (int k = 0; k < 3; ++k) {
      const double cell = (s.centre[k] - extraction_.grid.origin[k]) / extraction_.grid.voxel_size;
      s.voxel[k] = static_cast<std::uint32_t>(std::floor(cell));
    }
    return s;
  }
  void add(const MedialSphere& s) {
    extraction_.spheres.push_back(s);
    ++extraction_.measurements.counters.found;
  }
  CertificateReport certify(unsigned threads = 1) {
    options_.threads = threads;
    return certify_spheres(indexed_, options_, extraction_).value();
  }
  double epsilon() const { return options_.epsilon * extraction_.grid.voxel_size; }

  double offset_;
  IndexedMesh indexed_;
  ExtractionOptions options_;
  Extraction extraction_;
};

TEST_P(CertifyTest, MakesNumbersExact) {
  add(sphere_at(2.03, 1.97, 0.5 - 0.3 * epsilon()));
  EXPECT_EQ(certify().passed, 1u);
  const MedialSphere& s = extraction_.spheres.at(0);
  const double distance = s.centre[2] - offset_;
  EXPECT_LE(s.radius, distance);
  EXPECT_GE(s.radius, distance - 1e-12 * (kLongest + std::abs(offset_)));
  EXPECT_EQ(s.spoke_a, (std::array<float, 3>{0, 0, -1}));
  EXPECT_FLOAT_EQ(s.object_angle, static_cast<float>(std::numbers::pi / 2));
}

TEST_P(CertifyTest, RefusesSpheresOfTheOtherSide) {
  add(sphere_at(2.03, 1.97, 0.5 - 0.3 * epsilon()));
  extraction_.side = MeshSide::kOutside;
  const auto refused = certify_spheres(indexed_, options_, extraction_);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
  EXPECT_EQ(extraction_.spheres.size(), 1u);
  extraction_.side = MeshSide::kInside;
  EXPECT_EQ(certify().passed, 1u);
}

TEST_P(CertifyTest, LetsOneSphereOfAVoxelPass) {
  add(sphere_at(2.03, 1.97, 0.5 - 0.1 * epsilon()));
  add(sphere_at(2.03, 1.97, 0.5 - 0.3 * epsilon()));
  ASSERT_EQ(extraction_.spheres[0].voxel, extraction_.spheres[1].voxel);
  const CertificateReport report = certify();
  EXPECT_EQ(report.passed, 1u);
  EXPECT_EQ(report.rejected, 1u);
}

// The device takes the upper face for the nearest; the lower one is nearer by a rounding.
TEST_P(CertifyTest, SwapsTheSpokesOfATie) {
  MedialSphere s = sphere_at(2.03, 1.97, 0.5 - 1e-4 * epsilon());
  std::swap(s.spoke_a, s.spoke_b);
  add(s);
  EXPECT_EQ(certify().passed, 1u);
  EXPECT_EQ(extraction_.spheres.at(0).spoke_a, (std::array<float, 3>{0, 0, -1}));
  EXPECT_EQ(extraction_.spheres.at(0).spoke_b, (std::array<float, 3>{0, 0, 1}));
}

TEST_P(CertifyTest, RepairsSpokeB) {
  MedialSphere s = sphere_at(2.03, 1.97, 0.5 - 0.3 * epsilon());
  s.spoke_b = {1, 0, 0};  // half a unit from the boundary
  add(s);
  EXPECT_EQ(certify().passed, 1u);
  EXPECT_EQ(extraction_.spheres.at(0).spoke_b, (std::array<float, 3>{0, 0, 1}));
}

TEST_P(CertifyTest, DropsWhatFailsAndKeepsTheOrder) {
  add(sphere_at(1.03, 1.97, 0.5 - 0.2 * epsilon()));
  add(sphere_at(1.53, 1.97, 0.5 - 3 * epsilon()));  // grown by epsilon it still fits
  MedialSphere elsewhere = sphere_at(2.03, 1.97, 0.5 - 0.2 * epsilon());
  elsewhere.voxel[1] += 1;
  add(elsewhere);
  add(sphere_at(2.53, 1.97, 0.0));  // on the boundary
  add(sphere_at(3.03, 1.97, 0.5 - 0.2 * epsilon()));
  extraction_.measurements.counters.undecided = 10;
  const CertificateReport report = certify();
  EXPECT_EQ(report.passed, 2u);
  EXPECT_EQ(report.rejected, 3u);
  ASSERT_EQ(extraction_.spheres.size(), 2u);
  EXPECT_LT(extraction_.spheres[0].voxel[0], extraction_.spheres[1].voxel[0]);
  EXPECT_EQ(extraction_.measurements.counters.found, 2u);
  EXPECT_EQ(extraction_.measurements.counters.undecided, 13u);
}

// On the sheet that leaves an edge of the slab at 45 degrees the object angle is pi/4.
TEST_P(CertifyTest, RequiresAngleOrRadius) {
  const double depth = 0.3 - 0.1 * epsilon();
  MedialSphere s = sphere_at(0.3, 1.97, depth);
  s.spoke_b = {-1, 0, 0};
  add(s);
  options_.object_angle = 0.7;
  Extraction original = extraction_;
  EXPECT_EQ(certify().passed, 1u);
  EXPECT_NEAR(extraction_.spheres.at(0).object_angle, std::numbers::pi / 4, 1e-6);
  extraction_ = original;
  options_.object_angle = 0.8;
  EXPECT_EQ(certify().rejected, 1u);
  extraction_ = original;
  options_.radius = 0.25 / kLongest;
  EXPECT_EQ(certify().passed, 1u);
  extraction_ = original;
  options_.radius = 0.35 / kLongest;
  EXPECT_EQ(certify().rejected, 1u);
}

TEST_P(CertifyTest, DoesNotDependOnTheNumberOfThreads) {
  for (int i = 0; i < 50; ++i) add(sphere_at(0.62 + 0.05 * i, 1.97, 0.5 - (i % 7 == 0 ? 3 : 0.1) * epsilon()));
  const Extraction original = extraction_;
  certify(1);
  const Extraction one = extraction_;
  EXPECT_LT(one.spheres.size(), 50u);
  for (const unsigned threads : {2u, 3u, 7u, 100u}) {
    extraction_ = original;
    certify(threads);
    ASSERT_EQ(extraction_.spheres.size(), one.spheres.size());
    for (std::size_t i = 0; i < one.spheres.size(); ++i) {
      EXPECT_EQ(extraction_.spheres[i].centre, one.spheres[i].centre);
      EXPECT_EQ(extraction_.spheres[i].radius, one.spheres[i].radius);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AtTheOriginAndFarAway, CertifyTest, testing::Values(0.0, 1e5));

}  // namespace
}  // namespace medial_vk
