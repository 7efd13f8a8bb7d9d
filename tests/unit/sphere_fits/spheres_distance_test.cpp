// Distances between solids and balls: those that a formula gives, and bounds against samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "base/point_ops.h"
#include "sphere_fits/cover/smallest_ball.h"
#include "sphere_fits/quality/envelope_distance.h"
#include "sphere_fits/quality/surface_samples.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/ball_families.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

struct Case {
  PreparedMesh mesh;
  std::unique_ptr<Solid> solid;

  explicit Case(Mesh input) : mesh(prepare(std::move(input))) {
    solid = std::make_unique<Solid>(Solid::build(test::indexed(mesh)).value());
  }
};

Envelope envelope_of(const std::vector<Ball>& balls) { return std::move(Envelope::build(balls).value()); }

void expect_bounds(const Bounds& bounds, double truth, double tolerance) {
  EXPECT_LE(bounds.lower, truth + 1e-9);
  EXPECT_GE(bounds.upper, truth - 1e-9);
  EXPECT_LE(bounds.upper - bounds.lower, tolerance);
}

/// A ball of some radius in the middle of a cube of side 2.
void expect_in_cube(double radius, double solid_to_balls, double balls_to_solid, double boundary_to_envelope,
                    double envelope_to_boundary) {
  const Case cube(make_box({2, 2, 2}));
  EnvelopeOptions options;
  options.tolerance = 2.5e-4;
  const double tolerance = 2.51e-4 * cube.solid->diagonal();
  const EnvelopeDistances d = measure_distances(*cube.solid, envelope_of({{{1, 1, 1}, radius}}), options).value();
  expect_bounds(d.solid_to_balls, solid_to_balls, tolerance);
  expect_bounds(d.boundary_to_balls, solid_to_balls, tolerance);
  expect_bounds(d.balls_to_solid, balls_to_solid, tolerance);
  expect_bounds(d.boundary_to_envelope, boundary_to_envelope, tolerance);
  expect_bounds(d.envelope_to_boundary, envelope_to_boundary, tolerance);
}

/// The point of a cube that is farthest from balls is often inside, where no direction leads away from all of them.
/// Samples at most h sqrt(3) / 2 from any point, h apart, bound the distance, which changes by no more than points
/// move.
TEST(EnvelopeDistance, FarthestPointsAreAsFarAsSamples) {
  constexpr int kSamples = 33;  // along a side
  const Case cube(make_box({2, 2, 2}));
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  EnvelopeOptions options;
  options.tolerance = 1e-3;
  int inside = 0;
  for (int set = 0; set < 30; ++set) {
    SCOPED_TRACE(set);
    std::vector<Ball> balls;
    for (int k = 0; k < 8; ++k) {
      const double x = 0.6 * uniform(random), y = 0.6 * uniform(random), z = 0.6 * uniform(random);
      const Point corner = {k & 1 ? 2 - x : x, k & 2 ? 2 - y : y, k & 4 ? 2 - z : z};
      balls.push_back({corner, 0.05 + 0.3 * uniform(random)});
    }
    double greatest = 0, at_boundary = 0;
    for (int n = 0; n < kSamples * kSamples * kSamples; ++n) {
      const std::array<int, 3> at = {n % kSamples, n / kSamples % kSamples, n / kSamples / kSamples};
      Point p{};
      for (std::size_t k = 0; k < 3; ++k) p[k] = 2.0 * at[k] / (kSamples - 1);
      double least = std::numeric_limits<double>::infinity();
      for (const Ball& ball : balls) least = std::min(least, length(p - ball.centre) - ball.radius);
      greatest = std::max(greatest, least);
      const bool is_on = std::any_of(at.begin(), at.end(), [](int x) { return x == 0 || x == kSamples - 1; });
      if (is_on) at_boundary = std::max(at_boundary, least);
    }
    const EnvelopeDistances d = measure_distances(*cube.solid, envelope_of(balls), options).value();
    EXPECT_GE(d.solid_to_balls.upper, greatest - 1e-9);
    EXPECT_LE(d.solid_to_balls.lower, greatest + std::sqrt(3.0) / (kSamples - 1) + 1e-9);
    inside += greatest > at_boundary + 0.01 ? 1 : 0;
  }
  EXPECT_GE(inside, 5);
}

TEST(EnvelopeDistance, BallInACube) {
  const double corner = std::sqrt(3.0);
  expect_in_cube(1, corner - 1, 0, corner - 1, 1 - 1 / corner);
  expect_in_cube(1.2, corner - 1.2, 0.2, corner - 1.2, 1 - 1.2 / corner);
  expect_in_cube(1.8, 0, 0.8, 0.8, 0.8);
}

TEST(EnvelopeDistance, FromInsideTheUnionToEveryKindOfFeature) {
  // Two balls that meet in a circle of radius 0.8 in the plane x = 0, and one far away.
  const Envelope two = envelope_of({{{-0.6, 0, 0}, 1}, {{0.6, 0, 0}, 1}, {{9, 0, 0}, 1}});
  EXPECT_NEAR(two.distance({-1.5, 0, 0}), 0.1, 1e-9);                    // a sphere
  EXPECT_NEAR(two.distance({0.1, 0.2, 0}), std::hypot(0.1, 0.6), 1e-9);  // the circle
  EXPECT_NEAR(two.distance({0.1, 0, 0}), std::hypot(0.1, 0.8), 1e-9);    // equally near to all of the circle
  EXPECT_NEAR(two.distance({-0.6, 0, 0}), 1, 1e-9);                      // a centre
  EXPECT_NEAR(two.distance({0, 3, 0}), std::hypot(0.6, 3) - 1, 1e-12);
  EXPECT_LT(two.signed_distance({-1.5, 0, 0}), 0);
  // Three that meet in two points at height h.
  const double third = 2 * std::numbers::pi / 3;
  std::vector<Ball> three;
  for (int k = 0; k < 3; ++k) three.push_back({{0.5 * std::cos(k * third), 0.5 * std::sin(k * third), 0}, 1});
  const Envelope envelope = envelope_of(three);
  EXPECT_EQ(envelope.vertices().size(), 2u);
  EXPECT_NEAR(envelope.distance({0, 0, 0.1}), std::sqrt(0.75) - 0.1, 1e-9);
}

/// Three spheres whose centres are almost on one line share two points that rounding moves along the circle of the
/// first two. A fourth ball holds one of them by less than that: it may be exposed in truth, so it is examined.
TEST(EnvelopeVertices, AreKeptWhereTheirErrorReachesOut) {
  constexpr double kOffLine = 1e-7, kDepth = 5e-9;
  const Point common = {0.5, 0.3, std::sqrt(0.75 - 0.3 * 0.3)};
  const Point third = {0.5, kOffLine, 0};
  const auto with_fourth = [&](double depth) {
    return envelope_of({{{0, 0, 0}, 1},
                        {{1, 0, 0}, 1},
                        {third, length(common - third)},
                        {{common[0], common[1], common[2] + 1 - depth}, 1}});
  };
  const auto kept = [&](const Envelope& envelope) {
    int count = 0;
    for (const EnvelopeVertex& vertex : envelope.vertices()) {
      if (vertex.balls != std::array<std::uint32_t, 3>{0, 1, 2} || length(vertex.at - common) > 1e-6) continue;
      ++count;
      EXPECT_GT(envelope.error_of(vertex), kDepth);
      EXPECT_LT(envelope.error_of(vertex), 1e-6);
      EXPECT_GE(envelope.distance_error(), envelope.error_of(vertex));
    }
    return count;
  };
  const Envelope envelope = with_fourth(kDepth);
  EXPECT_GT(kDepth, 2 * envelope.tolerance());
  EXPECT_EQ(kept(envelope), 1);
  EXPECT_EQ(kept(with_fourth(1e-5)), 0) << "held by more than the error";
}

/// Balls of a solid of revolution: centres that lie on its axis but for `off_line`, and spheres that share a point, up
/// to the rounding of radii. That point and a computed one have the same common point of the spheres nearby. The bound
/// of the former is at most (18 u (r + |y|)) 2 r (1 + 2 r / h) / off_line < 1e-13 / off_line: r and |y| are below 0.82,
/// the height h is at least 0.7 sin 0.2, and the two shorter sides are 0.9 long in all.
TEST(EnvelopeVertices, HaveBoundsWhereCentresAreNearlyOnOneLine) {
  const Point axis = (1 / 3.0) * Point{1, 2, 2}, across = (1 / 3.0) * Point{2, 1, -2},
              third = {-2 / 3.0, 2 / 3.0, -1 / 3.0};
  double farthest = 0;
  for (const double off_line : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-14, 1e-15}) {
    for (const double angle : {0.2, 0.9, 1.5}) {
      const Point common = 0.4 * axis + 0.7 * (std::cos(angle) * across + std::sin(angle) * third);
      std::vector<Ball> balls;
      for (const double at : {0.0, 0.5, 0.9}) {
        const Point centre = at * axis + (at == 0.5 ? off_line : 0) * across;
        balls.push_back({centre, length(common - centre)});
      }
      const Envelope envelope = envelope_of(balls);
      const double known = envelope.error_of({common, {0, 1, 2}});
      EXPECT_LE(known, std::min(1e-13 / off_line, 2 * balls[1].radius + 1e-14));
      std::array<Point, 2> points;
      const std::size_t count = meet(balls[0], balls[1], balls[2], envelope.tolerance(), points);
      double nearest = std::numeric_limits<double>::infinity(), error = 0;
      for (std::size_t k = 0; k < count; ++k) {
        if (length(points[k] - common) >= nearest) continue;
        nearest = length(points[k] - common);
        error = envelope.error_of({points[k], {0, 1, 2}});
      }
      if (count == 0) continue;
      EXPECT_LE(nearest, error + known) << off_line << ", " << angle;
      farthest = std::max(farthest, nearest);
    }
  }
  EXPECT_GT(farthest, 1e-3) << "computed points are far from the common one where centres are nearly on one line";
}

/// The nearest of many points of the envelope is never nearer than the result, and not much farther.
TEST(EnvelopeDistance, AgreesWithSamples) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const Envelope envelope = envelope_of(random_balls(40, seed, 0.1, 0.3));
    const std::vector<WeightedPoint> samples = sample_envelope(envelope, 60'000, 0);
    double area = 0;
    for (const WeightedPoint& sample : samples) area += sample.area;
    EXPECT_NEAR(area, envelope.measured().area, 1e-3 * area);
    for (const Ball& query : random_balls(200, seed + 100, 0.1, 0.2)) {
      double nearest = 1e9;
      for (const WeightedPoint& sample : samples) nearest = std::min(nearest, length(sample.at - query.centre));
      const auto [distance, at] = envelope.nearest(query.centre);
      EXPECT_LE(distance, nearest + 1e-8);
      EXPECT_GE(distance, nearest - 0.03);
      EXPECT_NEAR(length(at - query.centre), distance, envelope.distance_error());
      EXPECT_NEAR(envelope.distance(at), 0, envelope.distance_error());
    }
  }
}

/// Values at samples of boundary and envelope never exceed the upper bounds, and the bounds are as tight as requested.
TEST(EnvelopeDistance, BoundsHoldSamples) {
  int number = 0;
  for (Mesh input : {make_turned_torus(), make_l_shape(2, 0.7, 0.5), make_cup(1, 0.2, 1.5, 24)}) {
    const Case solid(std::move(input));
    const MeshReport& report = solid.mesh.report;
    for (double scale : {0.1, 0.3}) {
      std::vector<Ball> balls = random_balls(60, static_cast<unsigned>(++number), 0.3, 1);
      for (Ball& ball : balls) {
        for (std::size_t k = 0; k < 3; ++k) {
          ball.centre[k] = report.lower[k] + ball.centre[k] * (report.upper[k] - report.lower[k]);
        }
        ball.radius *= scale;
      }
      const Envelope envelope = envelope_of(balls);
      const EnvelopeDistances d = measure_distances(*solid.solid, envelope).value();
      for (const Bounds& bounds :
           {d.solid_to_balls, d.balls_to_solid, d.boundary_to_balls, d.boundary_to_envelope, d.envelope_to_boundary}) {
        EXPECT_LE(bounds.upper - bounds.lower, 1.01e-3 * solid.solid->diagonal());
      }
      double gap = 0, to_envelope = 0, to_boundary = 0, out = 0;
      for (const Point& p : sample_surface(solid.mesh.mesh, 3000)) {
        gap = std::max(gap, envelope.tree().nearest(p).distance);
        to_envelope = std::max(to_envelope, envelope.distance(p));
      }
      for (const WeightedPoint& p : sample_envelope(envelope, 3000, 0)) {
        to_boundary = std::max(to_boundary, solid.solid->distance(p.at));
        if (!solid.solid->contains(p.at)) out = std::max(out, solid.solid->distance(p.at));
      }
      EXPECT_LE(gap, d.boundary_to_balls.upper);
      EXPECT_LE(gap, d.solid_to_balls.upper);
      EXPECT_LE(to_envelope, d.boundary_to_envelope.upper);
      EXPECT_LE(to_boundary, d.envelope_to_boundary.upper);
      EXPECT_LE(out, d.balls_to_solid.upper);
      EXPECT_GT(to_envelope, 0.8 * d.boundary_to_envelope.lower);
      EXPECT_GT(to_boundary, 0.8 * d.envelope_to_boundary.lower);
    }
  }
}

TEST(EnvelopeDistance, DoesNotDependOnThreads) {
  const Case solid(make_turned_torus());
  const Envelope envelope = envelope_of(random_balls(50, 7, 0.2, 0.4));
  EnvelopeOptions one;
  one.threads = 1;
  const EnvelopeDistances a = measure_distances(*solid.solid, envelope).value();
  const EnvelopeDistances b = measure_distances(*solid.solid, envelope, one).value();
  EXPECT_EQ(a.envelope_to_boundary.lower, b.envelope_to_boundary.lower);
  EXPECT_EQ(a.envelope_to_boundary.upper, b.envelope_to_boundary.upper);
  EXPECT_EQ(a.boundary_to_envelope.upper, b.boundary_to_envelope.upper);
  EXPECT_EQ(a.balls_to_solid.upper, b.balls_to_solid.upper);
}

TEST(EnvelopeDistance, TooFewCellsLeaveTheBoundsApart) {
  const Case solid(make_turned_torus());
  EnvelopeOptions few;
  few.cells = 100;
  const Envelope envelope = envelope_of(random_balls(50, 7, 0.2, 0.4));
  const EnvelopeDistances coarse = measure_distances(*solid.solid, envelope, few).value();
  const EnvelopeDistances fine = measure_distances(*solid.solid, envelope).value();
  EXPECT_GE(coarse.envelope_to_boundary.upper, fine.envelope_to_boundary.lower);
  EXPECT_LE(coarse.envelope_to_boundary.lower, fine.envelope_to_boundary.upper);
}

TEST(EnvelopeDistance, NoBallsAreAnError) {
  const Case solid(make_turned_torus());
  EXPECT_EQ(measure_distances(*solid.solid, envelope_of({})).error().code, ErrorCode::kUsage);
}

TEST(SmallestBall, OfKnownPoints) {
  const std::vector<Point> one = {{1, 2, 3}, {1, 2, 3}};
  EXPECT_EQ(smallest_ball(one).radius, 0);
  const std::vector<Point> two = {{0, 0, 0}, {2, 0, 0}, {1, 0.5, 0}};
  EXPECT_NEAR(smallest_ball(two).radius, 1, 1e-12);
  std::vector<Point> cube;
  for (int k = 0; k < 8; ++k) cube.push_back({k & 1 ? 1.0 : 0.0, k & 2 ? 1.0 : 0.0, k & 4 ? 1.0 : 0.0});
  EXPECT_NEAR(smallest_ball(cube).radius, std::sqrt(0.75), 1e-12);
  // Points of a sphere, and some in it.
  std::vector<Point> sphere;
  for (std::size_t k = 0; k < 500; ++k) sphere.push_back((k % 3 == 0 ? 1.0 : 0.7) * spiral_point(k, 500));
  const Ball ball = smallest_ball(sphere);
  EXPECT_NEAR(ball.radius, 1, 1e-3);
  for (const Point& p : sphere) EXPECT_LE(length(p - ball.centre), ball.radius);
}

// In the opening of a mesh nothing but the winding number tells where the solid ends.
TEST(EnvelopeDistance, OfAnOpenSolidHasTheSameTolerance) {
  Mesh mesh = make_sphere(1, 400);
  std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.vertices[t[0]][2] > 0.6; });
  const Case open(std::move(mesh));
  ASSERT_FALSE(open.mesh.report.closed);
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::vector<Ball> balls = random_balls(4, seed, 0.1, 0.3);
    for (Ball& ball : balls) ball.centre = 2 * ball.centre - Point{1, 1, 1};
    const EnvelopeDistances d = measure_distances(*open.solid, envelope_of(balls)).value();
    EXPECT_LE(d.solid_to_balls.upper - d.solid_to_balls.lower, 1.01e-3 * open.solid->diagonal()) << seed;
    EXPECT_GE(d.solid_to_balls.upper, d.boundary_to_balls.lower) << seed;
  }
}

std::vector<Ball> random_balls(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Ball> balls;
  while (balls.size() < count) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    balls.push_back({{2 * x, 2 * y, 2 * z}, 0.2 + 0.4 * uniform(random)});
  }
  return balls;
}

/// The first point in no ball along a half-line, by the ends of the stretches in which balls meet it.
double first_exit(const std::vector<Ball>& balls, const Point& from, const Point& direction) {
  std::vector<std::pair<double, double>> stretches;
  for (const Ball& ball : balls) {
    const Point w = from - ball.centre;
    const double middle = -dot(w, direction), squared = middle * middle + ball.radius * ball.radius - dot(w, w);
    if (squared > 0) stretches.emplace_back(middle - std::sqrt(squared), middle + std::sqrt(squared));
  }
  std::sort(stretches.begin(), stretches.end());
  double exit = 0;
  for (const auto& [begin, end] : stretches) {
    if (begin <= exit) exit = std::max(exit, end);
  }
  return exit;
}

TEST(EnvelopeDistance, AlongALineIsTheFirstExitOrNone) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int found = 0;
  for (int set = 0; set < 20; ++set) {
    const std::vector<Ball> balls = random_balls(random, 12);
    const Envelope envelope = envelope_of(balls);
    for (int k = 0; k < 200; ++k) {
      const double x = 1 + uniform(random), y = 1 + uniform(random), z = 1 + uniform(random);
      const Point p = {x, y, z};
      if (!envelope.tree().holds(p)) continue;
      const Point direction = spiral_point(static_cast<std::size_t>(k), 200);
      const double along = envelope.distance_along(p, direction, 10);
      if (!std::isfinite(along)) continue;  // through many balls
      ++found;
      EXPECT_NEAR(along, first_exit(balls, p, direction), 1e-6);  // a grazed sphere doubles the digits that are lost
      EXPECT_GE(along, envelope.distance(p) - envelope.distance_error());
      EXPECT_FALSE(std::isfinite(envelope.distance_along(p, direction, 0.9 * along)) &&
                   envelope.distance_along(p, direction, 0.9 * along) < 0.9 * along);
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(EnvelopeDistance, OfSurfacesIsThatOfAllMeasures) {
  const Case cube(make_box({2, 2, 2}));
  std::mt19937 random(12);
  for (int set = 0; set < 5; ++set) {
    const std::vector<Ball> balls = random_balls(random, 12);
    const Bounds all = measure_distances(*cube.solid, envelope_of(balls)).value().between_surfaces();
    const Bounds alone = measure_surface_distance(*cube.solid, balls).value();
    EXPECT_EQ(alone.lower, all.lower);
    EXPECT_EQ(alone.upper, all.upper);
  }
}

}  // namespace
}  // namespace medial_vk
