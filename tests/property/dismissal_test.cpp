// The guarantee of the theorem of docs/theory.md: no voxel that holds a salient medial point is dismissed. Independent
// samples of many solids, each of whose voxels must be found or undecided.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "reference_bridge/reference_bridge.h"
#include "reference_bridge/reference_extractor.h"
#include "support/device/device.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/medial_sampler.h"
#include "support/solids/solid_catalogue.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using test::MedialSample;
using test::Voxel;

// docs/theory.md, "Rounding": the device dismisses for the threshold less 1e-5. Samples are exact to far less.
constexpr double kAngleSlack = 1e-5;
constexpr std::uint64_t kSeed = 20;

Voxel to_voxel(const std::array<std::uint32_t, 3>& v) {
  return {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])};
}

std::vector<MedialSample> draw(const PreparedMesh& mesh, double angle, std::size_t wanted) {
  test::SampleRequest request;
  request.angles = {angle + kAngleSlack};
  request.wanted = wanted;
  request.seed = kSeed;
  return test::draw_medial_samples(reference::Tree(to_reference(mesh)), request);
}

void expect_none_lost(const std::vector<MedialSample>& samples, const Extraction& extraction) {
  ASSERT_EQ(extraction.undecided.size(), extraction.measurements.counters.undecided)
      << "undecided voxels are not all listed";
  std::set<Voxel> kept;
  for (const MedialSphere& s : extraction.spheres) kept.insert(to_voxel(s.voxel));
  for (const UndecidedVoxel& u : extraction.undecided) kept.insert(to_voxel(u.voxel));
  std::size_t lost = 0;
  for (const MedialSample& s : samples) {
    if (kept.contains(test::voxel_of(extraction.grid, s.centre))) continue;
    if (++lost > 3) continue;
    ADD_FAILURE() << s.centre.transpose() << " is medial with radius " << s.radius << " and object angle "
                  << s.object_angle << ", but its voxel was dismissed";
  }
  EXPECT_EQ(lost, 0u) << "of " << samples.size();
}

void expect_none_lost_by_the_reference(const std::vector<MedialSample>& samples, const PreparedMesh& mesh,
                                       const ExtractionOptions& options) {
  SCOPED_TRACE("the reference");
  const auto result = extract_and_certify(test::indexed(mesh), options, reference_extractor());
  ASSERT_TRUE(result.ok()) << result.error().message;
  expect_none_lost(samples, result.value().extraction);
}

/// Thresholds differ from solid to solid: low ones leave more voxels, high ones require more of the proof. So do
/// counts, as a sample takes more or less time: on faceted round solids it must climb far, at the centre of a sphere
/// farthest.
struct DismissalCase {
  std::string solid;
  double object_angle;
  std::size_t samples;
};

std::ostream& operator<<(std::ostream& out, const DismissalCase& c) {
  return out << c.samples << " samples of " << c.solid << ", threshold " << c.object_angle;
}

class DismissalOfSolids : public testing::TestWithParam<DismissalCase> {};

TEST_P(DismissalOfSolids, LosesNoSalientSample) {
  const double object_angle = GetParam().object_angle;
  const std::size_t wanted = GetParam().samples;
  const auto& solids = test::analytic_solids();
  const auto solid =
      std::find_if(solids.begin(), solids.end(), [&](const auto& s) { return s.name == GetParam().solid; });
  ASSERT_NE(solid, solids.end());
  const PreparedMesh mesh = test::prepare(solid->make());
  const std::vector<MedialSample> samples = draw(mesh, object_angle, wanted);
  ASSERT_EQ(samples.size(), wanted);
  ExtractionOptions options;
  options.object_angle = object_angle;
  options.resolution = 40;
  expect_none_lost_by_the_reference(samples, mesh, options);
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  SCOPED_TRACE("the device");
  Context context = test::make_context();
  expect_none_lost(samples, test::extract_on_device(context, mesh, options).extraction);
}

std::string test_name(const testing::TestParamInfo<DismissalCase>& info) {
  std::string name = info.param.solid;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

// 103,530 samples.
INSTANTIATE_TEST_SUITE_P(Solids, DismissalOfSolids,
                         testing::Values(DismissalCase{"box", 0.6, 20'000}, DismissalCase{"l-shape", 0.3, 20'000},
                                         DismissalCase{"plate-with-hole", 0.9, 20'000},
                                         DismissalCase{"cup", 0.6, 16'000}, DismissalCase{"sphere", 0.3, 30},
                                         DismissalCase{"capsule", 0.6, 2'500}, DismissalCase{"oblate", 0.3, 10'000},
                                         DismissalCase{"prolate", 0.3, 1'000}, DismissalCase{"triaxial", 0.9, 9'000},
                                         DismissalCase{"torus", 0.3, 2'000}, DismissalCase{"flat-torus", 0.6, 3'000}),
                         test_name);

// An L, a box that crosses it and one that stands apart, all with triangles missing: open edges, crossings, and sides
// by winding numbers between 0 and 1.
TEST(Dismissal, OfAMessLosesNoSalientSample) {
  Mesh mess = test::make_l_shape(1, 0.35, 0.6), other = test::make_box({0.5, 0.4, 0.9});
  test::rotate(other, {0.4, -0.3, 0.7}, 0.9);
  test::append(mess, other);
  Mesh open = test::make_box({0.4, 0.5, 0.3});
  test::translate(open, {0.6, 0.5, 0.1});
  test::append(mess, open);
  std::erase_if(mess.triangles, [i = 0](const Triangle&) mutable { return ++i % 11 == 5; });
  test::rotate(mess, {0.3, -0.5, 0.8}, 0.7);
  const PreparedMesh mesh = test::prepare(mess);
  ASSERT_FALSE(mesh.report.closed);
  ASSERT_GT(mesh.report.intersecting_faces, 0u);
  const std::vector<MedialSample> samples = draw(mesh, 0.6, 4000);
  ASSERT_GT(samples.size(), 1000u);
  ExtractionOptions options;
  options.resolution = 40;
  expect_none_lost_by_the_reference(samples, mesh, options);
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  SCOPED_TRACE("the device");
  Context context = test::make_context();
  const Extraction extraction = test::extract_on_device(context, mesh, options).extraction;
  expect_none_lost(samples, extraction);
  const std::uint64_t visited = extraction.measurements.counters.found + extraction.measurements.counters.undecided +
                                extraction.measurements.counters.proved_empty;
  EXPECT_LT(100 * extraction.measurements.counters.undecided, visited);
}

/// Numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  double operator()(double low, double high) { return low + (high - low) * 0x1p-32 * static_cast<double>(engine_()); }
  std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(engine_() % n); }

 private:
  std::mt19937 engine_;
};

std::uint32_t add_vertex(Mesh& mesh, const Point& near, double away, Random& random) {
  Point p = near;
  for (double& x : p) x += random(-away, away);
  mesh.vertices.push_back(p);
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

/// Triangles that leave edges and vertices of the mesh, inwards and outwards, either way up.
void add_fins(Mesh& mesh, std::size_t count, double size, Random& random) {
  const std::size_t own = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle from = mesh.triangles[random.below(own)];
    Triangle fin = {from[0], from[1], add_vertex(mesh, mesh.vertices[from[0]], size, random)};
    if (i % 3 == 0) fin[1] = add_vertex(mesh, mesh.vertices[from[0]], size, random);
    if (i % 2 == 0) std::swap(fin[0], fin[1]);
    mesh.triangles.push_back(fin);
  }
}

/// Sheets around a vertex inside, some of them nearly flat: all sides of them are inside.
void add_fan(Mesh& mesh, const Point& at, std::size_t count, double flatness, Random& random) {
  mesh.vertices.push_back(at);
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::size_t i = 0; i <= count; ++i) add_vertex(mesh, at, 0.15, random);
  for (std::uint32_t i = 1; i <= count + 1; ++i) {
    Point& p = mesh.vertices[middle + i];
    p[2] = at[2] + flatness * (p[2] - at[2]);
  }
  for (std::uint32_t i = 1; i <= count; ++i) mesh.triangles.push_back({middle, middle + i, middle + i + 1});
}

// Lemmas J and K: triangles that leave a vertex, and faces that are touched from outside.
TEST(Dismissal, AtFinsAndFansLosesNoSalientSample) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Context context = test::make_context();
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Mesh mess = test::make_ellipsoid({0.6, 0.55, 0.5}, 10);
    add_fins(mess, 14, 0.25, random);
    for (int i = 0; i < 4; ++i) {
      const Point at = {random(-0.3, 0.3), random(-0.3, 0.3), random(-0.3, 0.3)};
      add_fan(mess, at, 3 + random.below(3), i % 2 == 0 ? 1 : 0.1, random);
    }
    if (seed == 2) mess.triangles.erase(mess.triangles.begin() + 7);
    test::rotate(mess, {0.3, -0.5, 0.8}, 0.7);
    const PreparedMesh mesh = test::prepare(mess);
    ASSERT_FALSE(mesh.report.closed);
    ASSERT_GT(mesh.report.non_manifold_edges, 5u);
    for (const double angle : {0.4, 0.9}) {
      const std::vector<MedialSample> samples = draw(mesh, angle, 1500);
      ASSERT_EQ(samples.size(), 1500u);
      ExtractionOptions options;
      options.object_angle = angle;
      options.resolution = 40;
      const Extraction extraction = test::extract_on_device(context, mesh, options).extraction;
      expect_none_lost(samples, extraction);
      const ExtractionCounters& c = extraction.measurements.counters;
      EXPECT_LT(100 * c.undecided, c.found + c.undecided + c.proved_empty) << c.undecided;
    }
  }
}

// The sampler itself, where the result is known: in a box the distance to the boundary is the least distance to a face,
// a point is medial where two of them tie, and object angles are pi/4 or pi/2.
TEST(MedialSampler, SamplesOfABoxTieBetweenTwoFaces) {
  const Eigen::Array3d size(1, 0.7, 0.5);
  const PreparedMesh box = test::prepare(test::make_box({size[0], size[1], size[2]}));
  const std::vector<MedialSample> samples = draw(box, 0.3, 5000);
  ASSERT_EQ(samples.size(), 5000u);
  constexpr double kTolerance = 1e-12;  // of lengths; the angle between feet on both sides of a triangle's edge follows
  for (const MedialSample& s : samples) {
    const Eigen::Array3d p = s.centre.array(), least = p.min(size - p);
    EXPECT_NEAR(least.minCoeff(), s.radius, kTolerance);
    const bool opposite = ((size - 2 * p).abs() <= 2 * kTolerance && least <= s.radius + kTolerance).any();
    const auto ties = (least <= s.radius + kTolerance).count();
    EXPECT_TRUE(opposite || ties >= 2) << p.transpose();
    EXPECT_NEAR(s.object_angle, opposite ? std::numbers::pi / 2 : std::numbers::pi / 4,
                2 * std::sqrt(kTolerance / s.radius))
        << p.transpose();
  }
}

// The faces of a geodesic sphere that are nearest to its centre lie opposite one another: the centre is the highest
// point of the medial surface, and its object angle is pi/2. Samples stop at any corner on their way there. Balls lower
// by t at most are within t / 0.79 of it: 0.79 is the least, over all directions, of the largest product with one of
// those normals.
TEST(MedialSampler, SamplesOfASphereClimbPastCornersToItsCentre) {
  const PreparedMesh sphere = test::prepare(test::make_sphere(1, 320));
  const reference::Tree tree(to_reference(sphere));
  test::SampleRequest request = {.angles = {0.3, 0.6, 0.9}, .wanted = 100, .past_corners = true};
  const std::vector<MedialSample> samples = test::draw_medial_samples(tree, request);
  const double highest = tree.closest({0, 0, 0}).distance, tolerance = 128 * tree.rounding();
  std::size_t at_centre = 0, below = 0;
  for (const MedialSample& s : samples) {
    EXPECT_NEAR(tree.closest(s.centre).distance, s.radius, tolerance);
    EXPECT_LE(s.radius, highest + tolerance);
    const bool there = s.radius > highest - tolerance;
    (there ? at_centre : below) += 1;
    if (!there) continue;
    EXPECT_LT(s.centre.norm(), 2 * tolerance);
    EXPECT_NEAR(s.object_angle, std::numbers::pi / 2, 2 * std::sqrt(tolerance / s.radius));
  }
  EXPECT_GE(at_centre, 100u);
  EXPECT_GT(below, 0u);
}

// No property of a sample depends on the number of threads.
TEST(MedialSampler, SamplesDoNotDependOnThreads) {
  const PreparedMesh torus = test::prepare(test::make_torus(1, 0.35, 16, 32));
  const reference::Tree tree(to_reference(torus));
  test::SampleRequest request = {.angles = {0.3, 0.6}, .wanted = 100, .most_tries = 100, .seed = 3, .threads = 1};
  const std::vector<MedialSample> one = test::draw_medial_samples(tree, request);
  request.threads = 3;
  const std::vector<MedialSample> three = test::draw_medial_samples(tree, request);
  ASSERT_EQ(one.size(), three.size());
  ASSERT_FALSE(one.empty());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].centre, three[i].centre);
    EXPECT_EQ(one[i].object_angle, three[i].object_angle);
  }
}

}  // namespace
}  // namespace medial_vk
