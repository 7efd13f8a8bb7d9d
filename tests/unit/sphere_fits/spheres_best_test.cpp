// The best method, as a whole and by its parts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/certify.h"
#include "medial_vk/prepare.h"
#include "reference_bridge/reference_extractor.h"
#include "sphere_fits/methods/best_method.h"
#include "sphere_fits/quality/envelope_distance.h"
#include "sphere_fits/steps/candidates.h"
#include "sphere_fits/steps/gaps.h"
#include "sphere_fits/steps/maximal_ball.h"
#include "sphere_fits/steps/slide.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"
#include "unit/sphere_fits/shape.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

Mesh turned_l_shape() {
  Mesh mesh = test::make_l_shape(2.0, 0.6, 0.8);
  test::rotate(mesh, {1, 2, 3}, 0.4);
  return mesh;
}

TEST(MaximalBall, TouchesTwoSidesOfABox) {
  const Shape box(test::make_box({4, 3, 1}));
  const Ball ball = maximal_ball(box.solid, {2, 1.5, 0.1});
  const double tolerance = 2 * box.solid.rounding();  // the radius is reduced by one rounding
  EXPECT_NEAR(ball.radius, 0.5, tolerance);
  EXPECT_NEAR(length(ball.centre - Point{2, 1.5, 0.5}), 0, tolerance);
  const Ball at_edge = maximal_ball(box.solid, {2, 0.3, 0.1});  // contact z = 0, then y = 0
  EXPECT_NEAR(at_edge.radius, 0.3, tolerance);
}

TEST(MaximalBall, HoldsTheBallAroundItsPointAndStaysInside) {
  const Shape shape(turned_l_shape());
  const reference::Tree tree(test::to_reference(shape.mesh));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int inside = 0;
  while (inside < 500) {
    const Point p = {1.5 * uniform(random), 1.5 * uniform(random), 1.5 * uniform(random)};
    if (!shape.solid.contains(p)) continue;
    ++inside;
    const Ball ball = maximal_ball(shape.solid, p);
    // The direction away from the contact has the uncertainty of the contact, seen from p.
    const double distance = shape.solid.distance(p);
    const double tolerance = 4 * shape.solid.rounding() * (1 + ball.radius / distance);
    EXPECT_LE(length(p - ball.centre) + distance, ball.radius + tolerance);
    EXPECT_LE(ball.radius, tree.closest({ball.centre[0], ball.centre[1], ball.centre[2]}).distance);
    EXPECT_TRUE(shape.solid.contains(ball.centre));
  }
}

TEST(MaximalBall, IsTheSameWhicheverTrianglesAreTriedFirst) {
  const Shape shape(turned_l_shape());
  std::vector<std::uint32_t> all(shape.solid.mesh().mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<std::uint32_t> of_last;
  for (int inside = 0; inside < 300;) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Point p = {1.5 * x, 1.5 * y, 1.5 * z};
    if (!shape.solid.contains(p)) continue;
    ++inside;
    const Ball ball = maximal_ball(shape.solid, p);
    std::vector<std::uint32_t> some = all;
    const Ball from_all = maximal_ball(shape.solid, p, some);
    const Ball from_last = maximal_ball(shape.solid, p, of_last);
    // Each may stop short of the second contact by four roundings, which its direction from the first one magnifies.
    const double tolerance = 16 * shape.solid.rounding() * (1 + ball.radius / shape.solid.distance(p));
    EXPECT_NEAR(from_all.radius, ball.radius, tolerance);
    EXPECT_NEAR(from_last.radius, ball.radius, tolerance);
    if (of_last.size() > 40) of_last.clear();
  }
}

TEST(BestMethod, BallsOnlyAreProvedButNotMeasured) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(turned_l_shape()).value());
  SphereFitOptions options;
  options.count = 13;
  options.balls_only = true;
  const SphereFit inside = fit_spheres(mesh, options, reference_extractor()).value();
  EXPECT_TRUE(inside.measures.inside.proved());
  EXPECT_EQ(inside.measures.inside.tested, inside.levels.back().size());
  EXPECT_EQ(inside.measures.volume.balls, 0);
  options.contract = SphereContract::kCover;
  const SphereFit cover = fit_spheres(mesh, options, reference_extractor()).value();
  EXPECT_TRUE(cover.measures.cover.proved());
  EXPECT_GT(cover.measures.cover.triangles, 0u);
  EXPECT_LE(cover.levels.back().size(), 13u);
  options.balls_only = false;
  const SphereFit measured_cover = fit_spheres(mesh, options, reference_extractor()).value();
  EXPECT_LE(measured_cover.measures.volume.balls, measure_ball_union(cover.levels.back()).value().volume);
  options.contract = SphereContract::kInside;
  const SphereFit measured = fit_spheres(mesh, options, reference_extractor()).value();
  const auto is_same = [](const Ball& a, const Ball& b) { return a.centre == b.centre && a.radius == b.radius; };
  EXPECT_TRUE(std::ranges::equal(inside.levels.back(), measured.levels.back(), is_same));
  EXPECT_GT(measured.measures.volume.balls, 0);
  options.balls_only = options.levels = true;
  EXPECT_THAT(fit_spheres(mesh, options, reference_extractor()).error().message, HasSubstr("`balls_only`"));
}

// A cover begins with balls inside: both stages move the same share on.
TEST(BestMethod, ProgressOfACoverNeverFalls) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(turned_l_shape()).value());
  SphereFitOptions options;
  options.contract = SphereContract::kCover;
  options.count = 16;
  options.threads = 1;
  double last = 0, before_cover = 0;
  std::size_t steps = 0;  // of the cover
  const auto on_progress = [&](const char* stage, double done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1);
    if (std::string(stage) != "cover") {
      before_cover = steps == 0 ? done : before_cover;
    } else if (done > last) {
      ++steps;
    }
    last = done;
  };
  ASSERT_TRUE(fit_spheres(mesh, options, reference_extractor(), on_progress).ok());
  EXPECT_GT(before_cover, 0.1);
  EXPECT_LT(before_cover, 0.5);
  EXPECT_GT(steps, 5u);
  EXPECT_GT(last, 0.95);
}

// Distances from the walls are so small that directions away from them are inexact: balls that grow along them could
// leave the solid.
TEST(BestMethod, BallsAreInsideASliver) {
  Mesh sliver = test::make_sliver();
  test::rotate(sliver, {1, 2, 3}, 0.7);
  const IndexedMesh mesh = test::indexed(prepare_mesh(sliver).value());
  const reference::Tree tree(test::to_reference(mesh.prepared()));
  for (const std::size_t count : {1, 4, 9}) {
    SCOPED_TRACE(count);
    SphereFitOptions options;
    options.count = count;
    const Result<SphereFit> fit = fit_spheres(mesh, options, reference_extractor());
    ASSERT_TRUE(fit.ok()) << fit.error().message;
    EXPECT_TRUE(fit.value().measures.inside.proved());
    for (const Ball& ball : fit.value().levels.back()) {
      EXPECT_GT(ball.radius, 0);
      const Eigen::Vector3d centre(ball.centre.data());
      EXPECT_TRUE(reference::is_inside(tree, centre));
      EXPECT_LE(ball.radius, tree.closest(centre).distance);
    }
  }
}

TEST(Slider, MovesAlongASlabTowardsWhatIsUncovered) {
  const Shape slab(test::make_box({10, 10, 1}));
  DynamicUnion balls = std::move(DynamicUnion::build(2, 20)).value();
  ASSERT_TRUE(balls.add({{5, 5, 0.5}, 0.5}).ok());
  ASSERT_TRUE(balls.add({{5.2, 5, 0.5}, 0.5}).ok());
  Slider slider(slab.solid);
  std::vector<std::uint32_t> touched;
  const Point move = slider.direction(balls.ball(1), balls.exposure(1), 0.1, touched);
  EXPECT_GT(move[0], 0.01);
  EXPECT_LE(length(move), 0.1 * (1 + 1e-12));
  EXPECT_NEAR(move[1], 0, 1e-9);
  EXPECT_NEAR(move[2], 0, 1e-9);
  // Each wide face limits the step.
  const auto is_wide = [&](double z) {
    return std::ranges::any_of(touched, [&](std::uint32_t triangle) {
      const auto& [a, b, c] = slab.solid.mesh().mesh.triangles[triangle];
      const auto& vertices = slab.solid.mesh().mesh.vertices;
      return vertices[a][2] == z && vertices[b][2] == z && vertices[c][2] == z;
    });
  };
  EXPECT_TRUE(is_wide(0));
  EXPECT_TRUE(is_wide(1));
}

/// Triangles that are remembered from another place of the ball are like any others: they limit the step no more than
/// the boundary does.
TEST(Slider, RememberedTrianglesDoNotHinder) {
  const Shape slab(test::make_box({10, 10, 1}));
  DynamicUnion balls = std::move(DynamicUnion::build(2, 20)).value();
  ASSERT_TRUE(balls.add({{5, 5, 0.5}, 0.5}).ok());
  ASSERT_TRUE(balls.add({{5.2, 5, 0.5}, 0.5}).ok());
  Slider slider(slab.solid);
  std::vector<std::uint32_t> none, all(slab.solid.mesh().mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  const Point move = slider.direction(balls.ball(1), balls.exposure(1), 0.1, none);
  const Point from_all = slider.direction(balls.ball(1), balls.exposure(1), 0.1, all);
  EXPECT_LT(length(from_all - move), 1e-9);
  EXPECT_LT(all.size(), slab.solid.mesh().mesh.triangles.size());
}

TEST(Slider, LeavesABallThatCannotGain) {
  const Shape cube(test::make_box({1, 1, 1}));
  DynamicUnion balls = std::move(DynamicUnion::build(1, 2)).value();
  ASSERT_TRUE(balls.add({{0.5, 0.5, 0.5}, 0.5}).ok());
  Slider slider(cube.solid);
  std::vector<std::uint32_t> touched;
  EXPECT_EQ(slider.direction(balls.ball(0), balls.exposure(0), 0.1, touched), (Point{0, 0, 0}));
}

TEST(Candidates, LazyChoicesAreTheGreedyOnes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Ball> all;
  for (int n = 0; n < 120; ++n) {
    all.push_back({{uniform(random), uniform(random), uniform(random)}, 0.1 + 0.2 * uniform(random)});
  }
  DynamicUnion balls = std::move(DynamicUnion::build(40, 2)).value();
  Candidates candidates;
  candidates.add(all);
  for (int n = 0; n < 40; ++n) {
    double best = 0;
    for (const Ball& ball : all) best = std::max(best, balls.gain(ball).value());
    const auto choice = candidates.take_best(balls).value();
    ASSERT_TRUE(choice.has_value());
    EXPECT_EQ(choice->gain, best);
    ASSERT_TRUE(balls.add(choice->ball).ok());
  }
}

TEST(Candidates, EndWhenNoneAddsAnything) {
  DynamicUnion balls = std::move(DynamicUnion::build(4, 2)).value();
  Candidates candidates;
  candidates.add(std::vector<Ball>{{{0, 0, 0}, 1}, {{0.1, 0, 0}, 0.5}});
  ASSERT_TRUE(balls.add(candidates.take_best(balls).value()->ball).ok());
  EXPECT_FALSE(candidates.take_best(balls).value().has_value());
}

/// A lattice selects a few of them; where it has no point in any, all are measured.
TEST(Candidates, ThatALatticeSelectsHaveExactGains) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Ball> all;
  for (int n = 0; n < 200; ++n) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    all.push_back({{x, y, z}, 0.1 + 0.1 * uniform(random)});
  }
  for (const bool beside : {false, true}) {
    SCOPED_TRACE(beside ? "the lattice is elsewhere" : "a lattice among the balls");
    DynamicUnion balls = std::move(DynamicUnion::build(40, 2)).value();
    Candidates candidates;
    candidates.add(all);
    const double from = beside ? 5 : 0;
    Coverage coverage({from - 0.2, from - 0.2, from - 0.2}, {from + 1.2, from + 1.2, from + 1.2});
    coverage.divide(1e5, {});
    std::vector<Ball> chosen;
    for (int n = 0; n < 40; ++n) {
      double best = 0;
      for (const Ball& ball : all) best = std::max(best, balls.gain(ball).value());
      candidates.find_promising(coverage);
      const auto choice = candidates.take_best(balls).value();
      ASSERT_TRUE(choice.has_value());
      EXPECT_EQ(choice->gain, balls.gain(choice->ball).value());
      if (beside) {
        EXPECT_EQ(choice->gain, best);
      }
      // The best one has a volume of some hundred points, the error of which is that of the points next to the sphere.
      EXPECT_GE(choice->gain + 4 * std::numbers::pi * 0.2 * 0.2 * std::sqrt(3.0) * std::cbrt(coverage.cell()), best);
      ASSERT_TRUE(balls.add(choice->ball).ok());
      coverage.add(choice->ball);
      chosen.push_back(choice->ball);
      if (n != 15) continue;
      coverage.divide(3e6, chosen);
      candidates.forget_estimates();
    }
  }
}

TEST(GapFinder, FindsTheCornersOfABoxAndTheVertices) {
  const Shape box(test::make_box({1, 1, 1}));
  DynamicUnion balls = std::move(DynamicUnion::build(4, 2)).value();
  GapFinder gaps(box.solid, balls);
  ASSERT_TRUE(balls.add({{0.5, 0.5, 0.5}, 0.5}).ok());
  EXPECT_NEAR(gaps.widest_on_boundary().size, 0.5 * std::sqrt(3.0) - 0.5, 1e-14);
  EXPECT_EQ(gaps.deepest_vertex().size, 0);
  for (const Ball& ball : {Ball{{0.5, 0.4, 0.4}, 0.4}, Ball{{0.4, 0.5, 0.6}, 0.4}}) {
    ASSERT_TRUE(balls.add(ball).ok());
    for (const std::uint32_t slot : balls.changed()) gaps.forget(slot);
  }
  const GapFinder::Gap deepest = gaps.deepest_vertex();
  double expected = 0;
  for (std::uint32_t slot = 0; slot < 3; ++slot) {
    const std::vector<Point> vertices = balls.vertices(slot).value();
    for (const Point& v : vertices) expected = std::max(expected, box.solid.distance(v));
  }
  EXPECT_EQ(deepest.size, expected);
}

TEST(BestMethod, StaysInsideByTheReferencesDistances) {
  const Shape shape(turned_l_shape());
  const reference::Tree tree(test::to_reference(shape.mesh));
  const SphereSet set = shape.fit({.count = 60, .resolution = 16}).value();
  EXPECT_EQ(set.balls.size(), 60u);
  for (const Ball& ball : set.balls) {
    EXPECT_LE(ball.radius, tree.closest({ball.centre[0], ball.centre[1], ball.centre[2]}).distance);
    EXPECT_TRUE(shape.solid.contains(ball.centre));
  }
}

TEST(BestMethod, MoreBallsNeverLeaveMoreUncovered) {
  const Shape shape(turned_l_shape());
  double last = 1;
  for (std::size_t count = 1; count <= 40; ++count) {
    const double error = shape.error_of(shape.fit({.count = count, .resolution = 16}).value().balls);
    // Both volumes are sums of 40 terms with 100 roundings each.
    EXPECT_LE(error, last + 1e-12) << count << " balls";
    last = error;
  }
}

TEST(BestMethod, OneBallIsTheLargest) {
  const Shape box(test::make_box({1.5, 1.2, 1}));
  const SphereSet set = box.fit({.count = 1, .resolution = 12}).value();
  ASSERT_EQ(set.balls.size(), 1u);
  EXPECT_NEAR(set.balls[0].radius, 0.5, 1e-12);
}

// The medial surface of a ball is a point, that of a nearly round polyhedron little more: easily missed.
TEST(BestMethod, NeedsNoMedialPoints) {
  const Shape ball(test::make_sphere(1, 320));
  const Result<SphereSet> found = ball.fit({.count = 3, .resolution = 8});
  ASSERT_TRUE(found.ok()) << found.error().message;
  ASSERT_EQ(found.value().balls.size(), 3u);
  const double deepest = ball.solid.distance({0, 0, 0});
  // A ball at a facet's middle, e from an edge with the bend b, meets the next facet at the radius e / tan(b / 2),
  // which is 1 in the limit of small facets: a ball of half the size cannot be the largest.
  EXPECT_GE(found.value().balls.front().radius, 0.5 * deepest);
  for (const Ball& b : found.value().balls) EXPECT_LE(b.radius, ball.solid.distance(b.centre) + ball.solid.rounding());
}

TEST(BestMethod, BeatsItsOwnCandidatesByFar) {
  // Of 30 fixed candidates the greedy choice is the best that is known in general; sliding must find more.
  const Shape shape(turned_l_shape());
  ExtractionOptions options;
  options.resolution = 16;
  options.object_angle = 0.3;
  const auto found = extract_and_certify(shape.solid.indexed(), options, reference_extractor()).value();
  std::vector<Ball> medial;
  for (const MedialSphere& s : found.extraction.spheres) medial.push_back({s.centre, s.radius});
  Candidates candidates;
  candidates.add(medial);
  DynamicUnion greedy = std::move(DynamicUnion::build(30, 4)).value();
  for (int n = 0; n < 30; ++n) ASSERT_TRUE(greedy.add(candidates.take_best(greedy).value()->ball).ok());
  const double error = shape.error_of(shape.fit({.count = 30, .resolution = 16}).value().balls);
  EXPECT_LT(error, 0.97 * (1 - greedy.volume() / shape.solid.volume()));
}

TEST(BestMethod, MeetsGoalsOrSaysWhatWasLeft) {
  const Shape shape(turned_l_shape());
  const SphereSet by_error = shape.fit({.error = 0.15, .resolution = 16}).value();
  EXPECT_LE(shape.error_of(by_error.balls), 0.15);
  const SphereSet fewer = shape.fit({.count = by_error.balls.size() - 1, .resolution = 16}).value();
  EXPECT_GT(shape.error_of(fewer.balls), 0.15);
  const SphereSet by_gap = shape.fit({.max_gap = 0.2, .resolution = 16}).value();
  EXPECT_LE(measure_greatest_gap(shape.solid, by_gap.balls, {.tolerance = 1e-4}).value().upper, 0.2);
  const Result<SphereSet> too_few = shape.fit({.count = 3, .error = 0.01, .resolution = 16});
  ASSERT_FALSE(too_few.ok());
  EXPECT_EQ(too_few.error().code, ErrorCode::kUsage);
  EXPECT_THAT(too_few.error().message, HasSubstr("3 balls leave"));
}

TEST(BestMethod, GapsAreFilledWhenCandidatesAreUsedUp) {
  const Shape cube(test::make_box({1, 1, 1}));
  EXPECT_EQ(cube.fit({.count = 8, .resolution = 1}).value().balls.size(), 8u);
}

TEST(BestMethod, StopsOnRequest) {
  const Shape shape(turned_l_shape());
  SphereFitOptions request{.count = 50, .resolution = 16};
  const Result<SphereSet> set =
      best_spheres(shape.solid, request, reference_extractor(), [](const char*, double done) { return done < 0.3; });
  ASSERT_FALSE(set.ok());
  EXPECT_EQ(set.error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
