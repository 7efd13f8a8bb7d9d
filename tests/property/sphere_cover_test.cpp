// Covers of many solids by few balls: proved twice, deterministic, and no larger than necessary. (bench/run_spheres
// covers models by hundreds, and fails if one is not proved.)
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "base/point_ops.h"
#include "cpu_reference/sphere_certificate.h"
#include "reference_bridge/reference_extractor.h"
#include "sphere_fits/cover/cover_family.h"
#include "sphere_fits/methods/dilation.h"
#include "sphere_fits/quality/envelope_distance.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/reference_balls.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

/// Medial balls, first the largest that do not hold each other's centres.
std::vector<Ball> spread_balls(const PreparedMesh& mesh, std::size_t count) {
  ExtractionOptions options;
  options.resolution = 14;
  options.extra_levels = 1;
  const CertifiedExtraction found = extract_and_certify(test::indexed(mesh), options, reference_extractor()).value();
  std::vector<Ball> all, chosen;
  for (const MedialSphere& sphere : found.extraction.spheres) all.push_back({sphere.centre, sphere.radius});
  while (chosen.size() < count && !all.empty()) {
    std::size_t best = 0;
    double most = -1e300;
    for (std::size_t i = 0; i < all.size(); ++i) {
      double away = 2 * all[i].radius;
      for (const Ball& ball : chosen) away = std::min(away, length(ball.centre - all[i].centre) - 0.7 * ball.radius);
      if (away > most) {
        most = away;
        best = i;
      }
    }
    chosen.push_back(all[best]);
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return chosen;
}

struct NamedMesh {
  const char* name;
  Mesh mesh;
};

std::vector<NamedMesh> solids() {
  std::vector<NamedMesh> all = {{"box", make_box({2, 1, 0.3})},
                                {"torus", make_turned_torus(20, 10)},
                                {"l", make_l_shape(2, 0.6, 0.5)},
                                {"cup", make_cup(1, 0.15, 1.5, 24)},
                                {"plate", make_plate_with_hole(2, 0.2, 0.8)}};
  Mesh two = make_sphere(1, 150), other = make_capsule(0.3, 2, 12);
  translate(other, {3, 0, 0});
  append(two, other);
  all.push_back({"two parts", two});
  Mesh hollow = make_sphere(1, 200), hole = make_sphere(0.7, 100);
  turn_over(hole);
  append(hollow, hole);
  all.push_back({"hollow", hollow});
  Mesh crossing = make_box({2, 1, 1}), bar = make_box({1, 1, 3});
  translate(bar, {0.5, 0.3, -1});
  append(crossing, bar);
  all.push_back({"crossing", crossing});
  for (NamedMesh& each : all) {
    rotate(each.mesh, {1, 2, 0.5}, 0.7);
    translate(each.mesh, {3, -5, 2});
  }
  return all;
}

TEST(SphereCover, CoversEverySolidWithAnyNumber) {
  for (const NamedMesh& each : solids()) {
    const PreparedMesh mesh = prepare(each.mesh);
    const Solid solid = Solid::build(test::indexed(mesh)).value();
    double before = 1e300;
    for (const std::size_t count : {1u, 4u}) {
      SCOPED_TRACE(std::string(each.name) + " with " + std::to_string(count));
      const SphereSet inside = {spread_balls(mesh, count)};
      ASSERT_FALSE(inside.balls.empty());
      EXPECT_TRUE(prove_inside(solid, inside.balls).proved());
      const SphereSet cover = cover_solid(solid, inside).value();
      EXPECT_LE(cover.balls.size(), count);
      EXPECT_TRUE(prove_cover(solid, cover.balls).value().proved());
      const reference::Certificate checked =
          reference::check_cover(test::to_reference(mesh), test::to_reference(cover.balls));
      EXPECT_TRUE(checked.passed());
      const double volume = measure_ball_union(cover.balls).value().volume;
      if (solid.has_volume()) {
        EXPECT_GT(volume, solid.volume());
      }
      EXPECT_LT(volume, 1.02 * before);
      before = volume;
      if (count == 1) {
        // The smallest ball around everything: no other covers it.
        const Envelope envelope = std::move(Envelope::build(cover.balls).value());
        EXPECT_LT(measure_distances(solid, envelope).value().boundary_to_balls.upper, 1e-2 * solid.diagonal());
      }
    }
  }
}

TEST(SphereCover, MoreBallsAreNeverWorse) {
  const PreparedMesh mesh = prepare(make_l_shape(2, 0.6, 0.5));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  std::map<std::size_t, std::vector<Ball>> starts;
  double before = 1e300;
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 11u, 15u, 16u}) {
    // Each cover starts from its own balls, in the least number that it needs.
    const std::size_t top = cover_top(count);
    if (starts.count(top) == 0) starts[top] = spread_balls(mesh, top);
    const SphereSet cover = std::move(cover_by_counts(solid, starts, {count}).value().front());
    EXPECT_LE(cover.balls.size(), count);
    EXPECT_TRUE(prove_cover(solid, cover.balls).value().proved());
    const double volume = measure_ball_union(cover.balls).value().volume;
    EXPECT_LE(volume, before * (1 + 1e-12)) << count;
    before = volume;
  }
}

static_assert(cover_top(16) == 16 && cover_top(17) == 64 && cover_top(64) == 64);
static_assert(cover_top(65) == 96 && cover_top(97) == 128 && cover_top(129) == 192 && cover_top(193) == 256);
static_assert(cover_top(500) == 512 && cover_top(513) == 768 && cover_top(20000) == 24576);

TEST(SphereCover, MoreBallsAreNeverWorseBetweenPowersOfTwo) {
  const PreparedMesh mesh = prepare(make_l_shape(2, 0.6, 0.5));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  std::map<std::size_t, std::vector<Ball>> starts;
  for (const std::size_t top : {1u, 4u, 16u, 64u, 96u, 128u}) starts[top] = spread_balls(mesh, top);
  double before = 1e300;
  for (const std::size_t count : {60u, 64u, 65u, 90u, 96u, 97u, 128u}) {
    const SphereSet cover = std::move(cover_by_counts(solid, starts, {count}).value().front());
    EXPECT_LE(cover.balls.size(), count);
    const double volume = measure_ball_union(cover.balls).value().volume;
    EXPECT_LE(volume, before * (1 + 1e-12)) << count;
    before = volume;
  }
}

/// Every cover by fewer balls is smaller here, so none of those in the family is kept but the smallest ball around all.
TEST(SphereCover, OfABallIsOneBall) {
  const PreparedMesh mesh = prepare(make_sphere(1, 320));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  const Ball around = ball_around(solid);
  for (const std::size_t count : {1u, 2u, 3u, 4u, 7u}) {
    std::map<std::size_t, std::vector<Ball>> starts;
    for (std::size_t top = 1; top <= cover_top(count); top = cover_top(top + 1)) {
      for (std::size_t k = 0; k < top; ++k) starts[top].push_back({{0.01 * static_cast<double>(k), 0, 0}, 0.5});
    }
    const SphereSet cover = std::move(cover_by_counts(solid, starts, {count}).value().front());
    EXPECT_TRUE(prove_cover(solid, cover.balls).value().proved());
    const double one = 4 * std::numbers::pi / 3 * around.radius * around.radius * around.radius;
    EXPECT_LE(measure_ball_union(cover.balls).value().volume, one * (1 + 1e-12)) << count;
  }
}

TEST(SphereCover, LevelsAreTheAnswersForTheirNumbers) {
  const PreparedMesh mesh = prepare(make_box({2, 1, 0.3}));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  std::map<std::size_t, std::vector<Ball>> starts;
  for (const std::size_t top : {1u, 4u, 16u}) starts[top] = spread_balls(mesh, top);
  const std::vector<SphereSet> levels = std::move(cover_by_counts(solid, starts, {3, 6}).value());
  starts.erase(16);
  const SphereSet three = std::move(cover_by_counts(solid, starts, {3}, 1).value().front());
  ASSERT_EQ(levels.front().balls.size(), three.balls.size());
  for (std::size_t i = 0; i < three.balls.size(); ++i) {
    EXPECT_EQ(levels.front().balls[i].centre, three.balls[i].centre);
    EXPECT_EQ(levels.front().balls[i].radius, three.balls[i].radius);
  }
}

TEST(SphereCover, EveryBallAndItsSizeAreNeeded) {
  const PreparedMesh mesh = prepare(make_l_shape(2, 0.6, 0.5));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  const SphereSet cover = cover_solid(solid, {spread_balls(mesh, 16)}).value();
  for (std::size_t i = 0; i < cover.balls.size(); ++i) {
    std::vector<Ball> less = cover.balls;
    less[i].radius -= 1e-3 * solid.diagonal();
    EXPECT_FALSE(prove_cover(solid, less).value().proved()) << i;
    less.erase(less.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(prove_cover(solid, less).value().proved()) << i;
    EXPECT_FALSE(reference::check_cover(test::to_reference(mesh), test::to_reference(less)).passed()) << i;
  }
}

TEST(SphereCover, IsTheSameOnOneThread) {
  const PreparedMesh mesh = prepare(make_turned_torus(20, 10));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  const SphereSet inside = {spread_balls(mesh, 3)};
  const SphereSet all = cover_solid(solid, inside).value(), one = cover_solid(solid, inside, 1).value();
  ASSERT_EQ(all.balls.size(), one.balls.size());
  for (std::size_t i = 0; i < all.balls.size(); ++i) {
    EXPECT_EQ(all.balls[i].centre, one.balls[i].centre);
    EXPECT_EQ(all.balls[i].radius, one.balls[i].radius);
  }
}

TEST(SphereCover, AnyBallsWillDoAndNoneWillNot) {
  const PreparedMesh mesh = prepare(make_box({2, 1, 0.3}));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  const SphereSet far = {{{{50, 0, 0}, 0.1}, {{0, 0, 0}, 0}}};
  EXPECT_TRUE(prove_cover(solid, cover_solid(solid, far).value().balls).value().proved());
  EXPECT_EQ(cover_solid(solid, {}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(cover_solid(solid, {{{{0, 0, std::nan("")}, 1}}}).error().code, ErrorCode::kUsage);
  const auto stop = [](const char*, double) { return false; };
  EXPECT_EQ(cover_solid(solid, far, 0, stop).error().code, ErrorCode::kInterrupted);
  const std::map<std::size_t, std::vector<Ball>> starts = {{1, {far.balls[0]}}, {4, far.balls}};
  EXPECT_EQ(cover_by_counts(solid, starts, {4}, 0, stop).error().code, ErrorCode::kInterrupted);
  // Fewer balls than requested, one of them without a task.
  EXPECT_TRUE(prove_cover(solid, cover_by_counts(solid, starts, {4}).value().front().balls).value().proved());
}

TEST(SphereCover, OfAnOpenMeshTheSurface) {
  Mesh open = make_turned_torus(20, 10);
  open.triangles.resize(open.triangles.size() - 10);
  const PreparedMesh mesh = prepare(open);
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  const SphereSet cover = cover_solid(solid, {spread_balls(mesh, 4)}).value();
  const CoverProof proof = prove_cover(solid, cover.balls).value();
  EXPECT_TRUE(proof.surface_proved());
  EXPECT_EQ(proof.inside, 0u);
  EXPECT_FALSE(proof.proved());
}

TEST(Dilation, ReachesTheBoundaryAtVerticesAndOnLoneCircles) {
  // Two balls on the axis of a capsule: one circle, no vertex. It grows to the wall.
  const PreparedMesh mesh = prepare(make_capsule(1, 2, 64));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  const SphereSet inside = {{{{0, 0, -0.5}, 0.99}, {{0, 0, 0.5}, 0.99}}};
  const SphereSet grown = dilate_to_boundary(solid, inside).value();
  ASSERT_EQ(grown.balls.size(), 2u);
  for (const Ball& ball : grown.balls) EXPECT_NEAR(ball.radius, std::hypot(1, 0.5), 0.01);
  // Balls of a box: each vertex of the envelope's nearest boundary point is held by those that make the vertex.
  const PreparedMesh box = prepare(make_box({2, 1, 1}));
  const Solid block = Solid::build(test::indexed(box)).value();
  const SphereSet balls = {spread_balls(box, 12)};
  const SphereSet more = dilate_to_boundary(block, balls).value();
  BallUnionOptions options;
  options.complex = true;
  const BallUnion before = measure_ball_union(balls.balls, options).value();
  ASSERT_FALSE(before.vertices.empty());
  for (const EnvelopeVertex& vertex : before.vertices) {
    const Point target = block.closest(vertex.at).point;
    for (const std::uint32_t i : vertex.balls) {
      EXPECT_LE(length(target - more.balls[i].centre), more.balls[i].radius * (1 + 1e-12));
    }
  }
  // No ball reaches farther beyond the boundary than it grew.
  const Envelope envelope = std::move(Envelope::build(more.balls).value());
  double most = 0;
  for (std::size_t i = 0; i < balls.balls.size(); ++i) {
    EXPECT_GE(more.balls[i].radius, balls.balls[i].radius);
    most = std::max(most, more.balls[i].radius - balls.balls[i].radius);
  }
  EXPECT_LE(measure_distances(block, envelope).value().balls_to_solid.lower, most + 1e-9);
}

}  // namespace
}  // namespace medial_vk
