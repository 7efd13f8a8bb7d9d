// Fits of hulls, and what is said about them, by distances of the reference and by points at random.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "hull_fits/search/hull_family.h"
#include "medial_vk/hull_union.h"
#include "reference_bridge/reference_bridge.h"
#include "reference_bridge/reference_extractor.h"
#include "support/solids/solids.h"
#include "unit/hull_fits/fit_shape.h"

namespace medial_vk {
namespace {

std::vector<Mesh> parts() {
  return {test::make_box({1, 0.7, 0.45}), test::make_plate_with_hole(1, 0.15, 0.4), test::make_l_shape(1, 0.3, 0.4)};
}

/// The share of points at random, in the box of the mesh, that are in a hull, times the volume of the box; its standard
/// deviation is below half the volume divided by the square root of the number.
constexpr int kPoints = 20'000;
double volume_at_random(const IndexedMesh& mesh, const std::vector<BallHull>& hulls) {
  std::mt19937_64 random(36);
  const Point &lower = mesh.prepared().report.lower, &upper = mesh.prepared().report.upper;
  int inside = 0;
  for (int i = 0; i < kPoints; ++i) {
    Point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = std::uniform_real_distribution<double>(lower[k], upper[k])(random);
    const auto holds = [&](const BallHull& hull) { return signed_distance(hull, p) <= 0; };
    inside += std::ranges::any_of(hulls, holds) ? 1 : 0;
  }
  const Point size = upper - lower;
  return size[0] * size[1] * size[2] * inside / kPoints;
}
double deviation_at_random(const IndexedMesh& mesh) {
  const Point size = mesh.prepared().report.upper - mesh.prepared().report.lower;
  return 0.5 * size[0] * size[1] * size[2] / std::sqrt(static_cast<double>(kPoints));
}

/// The balls of all weights lie in the solid: by distances of the reference, at weights at random.
void expect_inside(const IndexedMesh& mesh, const std::vector<BallHull>& hulls) {
  const reference::Tree tree(medial_vk::to_reference(mesh));
  std::mt19937_64 random(37);
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    for (int sample = 0; sample < 60; ++sample) {
      std::array<double, 3> weight = {};
      double sum = 0;
      for (std::uint32_t k = 0; k < hulls[i].count; ++k) {
        weight[k] = sample < 3 ? (k == static_cast<std::uint32_t>(sample) % hulls[i].count ? 1 : 0)
                               : std::uniform_real_distribution<double>(0, 1)(random);
        sum += weight[k];
      }
      Eigen::Vector3d centre = {0, 0, 0};
      double radius = 0;
      for (std::uint32_t k = 0; k < hulls[i].count; ++k) {
        const Ball& ball = hulls[i].corners[k];
        centre += weight[k] / sum * Eigen::Vector3d(ball.centre[0], ball.centre[1], ball.centre[2]);
        radius += weight[k] / sum * ball.radius;
      }
      // Sums of three products of numbers up to 1 are rounded besides.
      EXPECT_LE(radius, tree.closest(centre).distance + tree.rounding() + 1e-15) << "hull " << i;
      EXPECT_GT(reference::winding_number(tree, centre, 0.01), 0.5) << "hull " << i;
    }
  }
}

void expect_kind(const HullFit& fit, HullChoice choice) {
  for (const BallHull& hull : fit.hulls) {
    switch (choice) {
      case HullChoice::kBalls:
        EXPECT_EQ(hull.count, 1u);
        break;
      case HullChoice::kCapsules:
        EXPECT_EQ(kind_of(hull), HullKind::kCapsule);
        break;
      case HullChoice::kCones:
        EXPECT_EQ(hull.count, 2u);
        break;
      default:
        EXPECT_EQ(hull.count, 3u);
    }
  }
}

/// All that a fit says about itself.
void expect_true(const IndexedMesh& mesh, const HullFit& fit) {
  EXPECT_TRUE(fit.proof.proved());
  EXPECT_EQ(fit.proof.tested, fit.hulls.size());
  EXPECT_EQ(fit.proof.greatest_lack, 0);
  const HullProof again = prove_hulls(mesh, fit.hulls).value();
  EXPECT_TRUE(again.proved());
  EXPECT_EQ(again.planes, fit.proof.planes);
  expect_inside(mesh, fit.hulls);
  EXPECT_LE(fit.covered.lower, fit.covered.upper);
  const double found = volume_at_random(mesh, fit.hulls), deviation = deviation_at_random(mesh);
  EXPECT_LE(fit.covered.lower, found + 5 * deviation);
  EXPECT_GE(fit.covered.upper, found - 5 * deviation);
  ASSERT_TRUE(fit.solid_volume);
  EXPECT_LE(fit.covered.lower, *fit.solid_volume);
  EXPECT_LE(fit.covered.upper - fit.covered.lower, 1e-3 * *fit.solid_volume * (1 + 1e-9));
  // Vertices are points of the boundary; so are the middles of triangles.
  const Mesh& surface = mesh.prepared().mesh;
  std::vector<Point> points = surface.vertices;
  for (const auto& [a, b, c] : surface.triangles) {
    points.push_back((1.0 / 3) * (surface.vertices[a] + surface.vertices[b] + surface.vertices[c]));
  }
  for (const Point& p : points) {
    double least = HUGE_VAL;
    for (const BallHull& hull : fit.hulls) least = std::min(least, signed_distance(hull, p));
    EXPECT_LE(least, fit.gap.upper);
  }
  EXPECT_LE(fit.gap.lower, fit.gap.upper);
  EXPECT_GE(fit.greatest_shrink, 0);
}

TEST(FitHulls, OfEachKindLieInsideAndAreMeasured) {
  const std::vector<Mesh> solids = parts();
  for (std::size_t i = 0; i < solids.size(); ++i) {
    FitShape shape(solids[i]);
    for (const HullChoice kind : kEachKind) {
      // All of them in a box, slabs in a plate, and capsules in an L.
      if (i > 0 && kind != (i == 1 ? HullChoice::kSlabs : HullChoice::kCapsules)) continue;
      SCOPED_TRACE(static_cast<int>(kind));
      const Result<HullFit> fit = shape.fit({.choice = kind, .count = 2});
      ASSERT_TRUE(fit.ok()) << fit.error().message;
      EXPECT_EQ(fit.value().hulls.size(), 2u);
      expect_kind(fit.value(), kind);
      expect_true(shape.mesh, fit.value());
      // The search leaves 1e-8 of the diagonal.
      EXPECT_LE(fit.value().greatest_shrink, 1e-7);
    }
  }
}

/// The sets of one search, of which fit_hulls() returns one.
TEST(FitHulls, MoreOfThemNeverCoverLess) {
  FitShape shape(test::make_l_shape(1, 0.3, 0.4));
  const Solid solid = Solid::build(shape.mesh).value();
  std::vector<Ball> medial;
  ExtractionOptions options;
  options.resolution = 16;
  const Extraction extraction = reference_extractor()(shape.mesh, options, {}, {}).value();
  for (const MedialSphere& sphere : extraction.spheres) medial.push_back({sphere.centre, sphere.radius});
  ASSERT_FALSE(medial.empty());
  const HullSearchEffort effort = {.proposals = 32, .climbed = 2, .climb = 8, .rounds = 2, .lines = 6000};
  HullFamily family(solid, medial, {2, true}, effort, {});
  Bounds last;
  double last_estimate = 0;
  for (std::size_t count = 1; count <= 12; ++count) {
    const std::vector<BallHull> set = family.set_of(count);
    EXPECT_EQ(set.size(), count);
    CoverageLines lines(shape.mesh.prepared().report.lower, shape.mesh.prepared().report.upper, effort.lines);
    for (const BallHull& hull : set) lines.add(hull);
    EXPECT_GE(lines.covered(), last_estimate * (1 - 1e-12)) << count;  // sums of some ten thousand chords
    last_estimate = lines.covered();
    const Bounds covered = measure_hull_union(set, {.width = 1e-3 * solid.volume()}).value();
    EXPECT_GE(covered.upper, last.lower) << count;
    last = covered;
  }
}

TEST(FitHulls, MoreOfThemAreLargerSets) {
  FitShape shape(test::make_box({1, 0.7, 0.45}));
  Bounds last;
  for (const std::size_t count : {1u, 2u}) {
    const HullFit fit = shape.fit({.choice = HullChoice::kCapsules, .count = count}).value();
    EXPECT_EQ(fit.hulls.size(), count);
    EXPECT_GE(fit.covered.upper, last.lower) << count;
    last = fit.covered;
  }
}

/// With a small triangular hole in the last triangle, near its first corner.
Mesh with_a_hole(Mesh mesh) {
  const auto [a, b, c] = mesh.triangles.back();
  mesh.triangles.pop_back();
  const Point &at_a = mesh.vertices[a], &at_b = mesh.vertices[b], &at_c = mesh.vertices[c];
  const Point middle = 0.9 * at_a + 0.05 * at_b + 0.05 * at_c;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const std::array<Point, 3> ring = {middle + 0.02 * (at_a - middle), middle + 0.02 * (at_b - middle),
                                     middle + 0.02 * (at_c - middle)};
  mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  const std::array<std::uint32_t, 3> corners = {a, b, c};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t next = (k + 1) % 3;
    mesh.triangles.push_back({corners[k], corners[next], first + next});
    mesh.triangles.push_back({corners[k], first + next, first + k});
  }
  return mesh;
}

// Inside an open mesh there are hulls, too: only the volume of the solid is not known.
TEST(FitHulls, OfAnOpenMeshAreProved) {
  FitShape shape(with_a_hole(test::make_box({1, 0.7, 0.45})));
  ASSERT_EQ(shape.mesh.prepared().report.open_edges, 3u);
  const Result<HullFit> fit = shape.fit({.choice = HullChoice::kCapsules, .count = 3});
  ASSERT_TRUE(fit.ok()) << fit.error().message;
  EXPECT_TRUE(fit.value().proof.proved());
  EXPECT_FALSE(fit.value().solid_volume);
  EXPECT_GT(fit.value().covered.lower, 0);
  EXPECT_TRUE(prove_hulls(shape.mesh, fit.value().hulls).value().proved());
}

/// All numbers.
std::vector<double> numbers_of(const HullFit& fit) {
  std::vector<double> numbers = {fit.covered.lower, fit.covered.upper,   fit.gap.lower,
                                 fit.gap.upper,     fit.greatest_shrink, static_cast<double>(fit.proof.planes)};
  for (const BallHull& hull : fit.hulls) {
    for (const Ball& ball : hull.balls()) {
      numbers.insert(numbers.end(), ball.centre.begin(), ball.centre.end());
      numbers.push_back(ball.radius);
    }
  }
  return numbers;
}

TEST(FitHulls, AreTheSameForAnyNumberOfThreads) {
  FitShape shape(test::make_plate_with_hole(1, 0.15, 0.4));
  for (const HullChoice kind : {HullChoice::kCones, HullChoice::kBalls}) {
    const HullFit one = shape.fit({.choice = kind, .count = 2, .threads = 1}).value();
    for (const unsigned threads : {2u, 3u}) {
      const HullFit other = shape.fit({.choice = kind, .count = 2, .threads = threads}).value();
      EXPECT_EQ(numbers_of(other), numbers_of(one)) << threads;
    }
  }
}

// A coarse extraction finds no medial point of a thin plate, but the search for balls starts from its boundary.
TEST(FitHulls, AMixIsAsGoodWhereOneKindDoesNotFit) {
  FitShape shape(test::make_box({1, 1, 1e-4}));
  const Result<HullFit> balls = shape.fit({.choice = HullChoice::kBalls, .count = 2});
  ASSERT_TRUE(balls.ok()) << balls.error().message;
  const Result<HullFit> slabs = shape.fit({.choice = HullChoice::kSlabs, .count = 2});
  ASSERT_FALSE(slabs.ok());
  EXPECT_EQ(slabs.error().code, ErrorCode::kInvalidMesh);
  const Result<HullFit> mix = shape.fit({.choice = HullChoice::kMix, .count = 2});
  ASSERT_TRUE(mix.ok()) << mix.error().message;
  EXPECT_EQ(numbers_of(mix.value()), numbers_of(balls.value()));
}

TEST(FitHulls, ReportStagesAndStopInEach) {
  FitShape shape(test::make_box({1, 0.7, 0.45}));
  const std::vector<std::string> stages = {"medial points", "hulls", "measures"};
  for (const HullChoice kind : {HullChoice::kCapsules, HullChoice::kBalls, HullChoice::kMix}) {
    std::set<std::string> seen;
    ASSERT_TRUE(shape
                    .fit({.choice = kind, .count = 1},
                         [&](const char* stage, double done) {
                           seen.insert(stage);
                           EXPECT_GE(done, 0) << stage;
                           EXPECT_LE(done, 1) << stage;
                         })
                    .ok());
    EXPECT_THAT(seen, testing::UnorderedElementsAreArray(stages));
    for (const std::string& last : stages) {
      std::stop_source stop;
      const auto stop_there = [&](const char* stage, double) {
        if (stage == last) stop.request_stop();
      };
      const Result<HullFit> fit = shape.fit({.choice = kind, .count = 1}, stop_there, stop.get_token());
      ASSERT_FALSE(fit.ok()) << last;
      EXPECT_EQ(fit.error().code, ErrorCode::kInterrupted) << last << ": " << fit.error().message;
    }
  }
}

TEST(FitHulls, NeedMedialPoints) {
  FitShape shape(test::make_box({1, 0.7, 0.45}));
  const Extractor none = [](const IndexedMesh&, const ExtractionOptions&, const ProgressCallback&,
                            const std::stop_token&) -> Result<Extraction> { return Extraction{}; };
  const Extractor broken = [](const IndexedMesh&, const ExtractionOptions&, const ProgressCallback&,
                              const std::stop_token&) -> Result<Extraction> {
    return Error{ErrorCode::kInternal, "device lost"};
  };
  for (const HullChoice kind : {HullChoice::kCapsules, HullChoice::kCones, HullChoice::kSlabs}) {
    const Result<HullFit> fit = fit_hulls(shape.mesh, {.choice = kind, .count = 2}, none);
    ASSERT_FALSE(fit.ok());
    EXPECT_EQ(fit.error().code, ErrorCode::kInvalidMesh) << static_cast<int>(kind) << ": " << fit.error().message;
  }
  // The search for balls finds some from points of the boundary alone.
  const HullFit balls = fit_hulls(shape.mesh, {.choice = HullChoice::kBalls, .count = 2}, none).value();
  const HullFit mix = fit_hulls(shape.mesh, {.choice = HullChoice::kMix, .count = 2}, none).value();
  EXPECT_EQ(numbers_of(mix), numbers_of(balls));
  for (const HullChoice kind : {HullChoice::kBalls, HullChoice::kSlabs, HullChoice::kMix}) {
    const Result<HullFit> lost = fit_hulls(shape.mesh, {.choice = kind, .count = 2}, broken);
    ASSERT_FALSE(lost.ok());
    EXPECT_EQ(lost.error().code, ErrorCode::kInternal);
    EXPECT_EQ(lost.error().message, "device lost");
  }
}

}  // namespace
}  // namespace medial_vk
