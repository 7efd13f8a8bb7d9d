// Unions of balls against closed forms, against slices (cpu_reference), against samples, and against each other.
#include "medial_vk/ball_union.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "cpu_reference/ball_union.h"
#include "support/solids/ball_families.h"

namespace medial_vk {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kExact = 1e-12;  // relative, as the project guarantees for closed forms

double ball_volume(double radius) { return 4 * kPi / 3 * radius * radius * radius; }

/// The part that a plane at distance `height` from the centre cuts off.
double cap_volume(double radius, double height) {
  const double rise = radius - height;
  return kPi * rise * rise * (3 * radius - rise) / 3;
}

/// The intersection of two balls, neither inside the other.
double lens_volume(double a, double b, double distance) {
  const double height = (distance * distance + a * a - b * b) / (2 * distance);
  return cap_volume(a, height) + cap_volume(b, distance - height);
}

BallUnion measure(const std::vector<Ball>& balls, bool complex = true) {
  auto result = measure_ball_union(balls, {.threads = 2, .complex = complex});
  EXPECT_TRUE(result.ok()) << result.error().message;
  return std::move(result).value();
}

BettiNumbers betti(const std::vector<Ball>& balls) { return betti_numbers(measure(balls).complex).value(); }

void expect_volume(const std::vector<Ball>& balls, double expected) {
  const BallUnion found = measure(balls);
  EXPECT_NEAR(found.volume, expected, kExact * expected);
  const double sum = std::accumulate(found.volumes.begin(), found.volumes.end(), 0.0);
  EXPECT_NEAR(sum, found.volume, kExact * expected);
}

std::vector<Ball> some_balls(std::size_t count, unsigned seed, double least = 0.2, double most = 0.6) {
  return test::random_balls(count, seed, least, most);
}

double by_slices(const std::vector<Ball>& balls) {
  std::vector<reference::UnionBall> spheres;
  for (const auto& [c, r] : balls) spheres.push_back({{c[0], c[1], c[2]}, r});
  return reference::union_volume_by_slices(spheres);
}

TEST(BallUnion, OfOneBall) {
  const BallUnion found = measure({{{3, -2, 5}, 0.7}});
  EXPECT_NEAR(found.volume, ball_volume(0.7), 1e-15 * found.volume);
  EXPECT_NEAR(found.area, 4 * kPi * 0.49, 1e-15 * found.area);
  EXPECT_EQ(found.complex.vertices, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(found.complex.edges.empty());
}

TEST(BallUnion, OfTwoBalls) {
  for (const double distance : {0.3001, 0.5, 0.9, 1.0999}) {
    const std::vector<Ball> balls = {{{0, 0, 0}, 0.7}, {{0, distance * 0.6, distance * 0.8}, 0.4}};
    expect_volume(balls, ball_volume(0.7) + ball_volume(0.4) - lens_volume(0.7, 0.4, distance));
    const double height = (distance * distance + 0.49 - 0.16) / (2 * distance);
    const double area = 2 * kPi * (0.7 * (0.7 + height) + 0.4 * (0.4 + distance - height));
    EXPECT_NEAR(measure(balls).area, area, kExact * area);
    EXPECT_EQ(betti(balls), (BettiNumbers{1, 0, 0}));
  }
}

TEST(BallUnion, OfBallsApart) {
  expect_volume({{{0, 0, 0}, 1}, {{2.5, 0, 0}, 1.25}}, ball_volume(1) + ball_volume(1.25));
  EXPECT_EQ(betti({{{0, 0, 0}, 1}, {{2.5, 0, 0}, 1.25}}), (BettiNumbers{2, 0, 0}));
}

TEST(BallUnion, OfBallsThatTouchIsConnected) {
  expect_volume({{{0, 0, 0}, 1}, {{2.25, 0, 0}, 1.25}}, ball_volume(1) + ball_volume(1.25));
  EXPECT_EQ(betti({{{0, 0, 0}, 1}, {{2.25, 0, 0}, 1.25}}), (BettiNumbers{1, 0, 0}));
}

/// Equal balls in a row, evenly spaced, all overlapping: the intersection of two lies in those between them.
TEST(BallUnion, OfThreeAndFourThatAllOverlap) {
  for (const int count : {3, 4}) {
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) balls.push_back({{0.3 * i, 0.4 * i, 0}, 1});
    expect_volume(balls, count * ball_volume(1) - (count - 1) * lens_volume(1, 1, 0.5));
  }
}

TEST(BallUnion, OfThreeAndFourInGeneralPosition) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    for (const std::size_t count : {3, 4}) {
      const auto balls = some_balls(count, seed, 0.6, 0.9);
      const double expected = by_slices(balls);
      EXPECT_NEAR(measure(balls).volume, expected, kExact * expected) << count << " balls, seed " << seed;
    }
  }
}

TEST(BallUnion, OfADozenAgainstSlices) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const auto balls = some_balls(12, 100 + seed);
    const double expected = by_slices(balls);
    EXPECT_NEAR(measure(balls).volume, expected, kExact * expected) << "seed " << seed;
  }
}

/// Eight planes meet in each corner of a cell, up to rounding: cells in the middle must be equal nevertheless.
TEST(BallUnion, OfGridsWhoseNumbersAreRounded) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int trial = 0; trial < 40; ++trial) {
    const double unit = 1 + 0.37 * share(random);
    auto balls = test::lattice(5, 0.75 * unit);
    const Point shift = {share(random), share(random), share(random)};
    for (Ball& ball : balls) {
      for (std::size_t k = 0; k < 3; ++k) ball.centre[k] = unit * ball.centre[k] + shift[k];
    }
    const BallUnion found = measure(balls, false);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const std::size_t x = i % 5, y = i / 5 % 5, z = i / 25;
      if (x % 4 == 0 || y % 4 == 0 || z % 4 == 0) continue;
      EXPECT_NEAR(found.areas[i], 0.341608006695 * unit * unit, 1e-11) << "trial " << trial << ", ball " << i;
    }
  }
}

TEST(BallUnion, OfNestedBallsIsTheLargest) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 0.2}, {{0.1, 0, 0}, 1}, {{0.1, 0, 0}, 0.5}, {{0.6, 0, 0}, 0.5}};
  expect_volume(balls, ball_volume(1));
  const BallUnion found = measure(balls);
  EXPECT_NEAR(found.volumes[1], ball_volume(1), kExact);
  EXPECT_EQ(betti_numbers(found.complex).value(), (BettiNumbers{1, 0, 0}));
}

TEST(BallUnion, OfDuplicatesCountsTheFirst) {
  auto balls = some_balls(10, 7);
  const BallUnion once = measure(balls);
  const auto again = balls;
  balls.insert(balls.end(), again.begin(), again.end());
  balls.insert(balls.end(), again.begin(), again.end());
  const BallUnion thrice = measure(balls);
  EXPECT_NEAR(thrice.volume, once.volume, kExact * once.volume);
  EXPECT_EQ(thrice.complex.edges, once.complex.edges);
  EXPECT_EQ(thrice.complex.tetrahedra, once.complex.tetrahedra);
  for (std::size_t i = 10; i < 30; ++i) EXPECT_EQ(thrice.volumes[i], 0);
}

/// Neighbours overlap, others do not: lenses are disjoint.
TEST(BallUnion, OfAGridOfOverlappingBalls) {
  const int n = 6;
  const double radius = 0.6;
  expect_volume(test::lattice(n, radius),
                n * n * n * ball_volume(radius) - 3 * n * n * (n - 1) * lens_volume(radius, radius, 1));
}

/// Spheres that fill their cells: every interior cell is a unit cube, whose eight corners are shared by eight balls.
TEST(BallUnion, OfAGridThatFillsSpace) {
  const int n = 5;
  const BallUnion found = measure(test::lattice(n, 0.9));
  const int middle = n * n * n / 2;
  EXPECT_NEAR(found.volumes[static_cast<std::size_t>(middle)], 1, kExact);
  EXPECT_NEAR(found.areas[static_cast<std::size_t>(middle)], 0, kExact);
  EXPECT_EQ(betti_numbers(found.complex).value(), (BettiNumbers{1, 0, 0}));
}

/// The grid's lines: n^3 points, 3 n^2 (n - 1) edges, and a tunnel for every edge but those of a spanning tree. Between
/// radius sqrt(1/2) and sqrt(3/4) squares are filled and cubes are hollow.
TEST(BallUnion, FindsTunnelsAndCavitiesOfAGrid) {
  const std::uint64_t n = 5, points = n * n * n, edges = 3 * n * n * (n - 1);
  EXPECT_EQ(betti(test::lattice(n, 0.6)), (BettiNumbers{1, edges - points + 1, 0}));
  EXPECT_EQ(betti(test::lattice(n, 0.8)), (BettiNumbers{1, 0, (n - 1) * (n - 1) * (n - 1)}));
}

std::vector<Ball> ring(int count, double size, double radius, const Point& at) {
  std::vector<Ball> balls;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count;
    balls.push_back({{at[0] + size * std::cos(angle), at[1] + size * std::sin(angle), at[2]}, radius});
  }
  return balls;
}

TEST(BallUnion, CountsComponentsTunnelsAndCavities) {
  auto balls = ring(40, 1, 0.2, {0, 0, 0});
  EXPECT_EQ(betti(balls), (BettiNumbers{1, 1, 0}));
  const auto other = ring(30, 1, 0.2, {0, 0, 5});
  balls.insert(balls.end(), other.begin(), other.end());
  EXPECT_EQ(betti(balls), (BettiNumbers{2, 2, 0}));
  // A shell: balls on a sphere, close enough to leave no hole.
  for (int i = 0; i < 400; ++i) {
    const double z = 1 - (2 * i + 1) / 400.0, angle = i * kPi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    balls.push_back({{10 + r * std::cos(angle), r * std::sin(angle), z}, 0.2});
  }
  EXPECT_EQ(betti(balls), (BettiNumbers{3, 2, 1}));
}

/// All centres in a plane, or on a line, or on a sphere: no tetrahedra, or one point that all bisectors share.
TEST(BallUnion, OfCoplanarAndCosphericalCentres) {
  std::vector<Ball> plane;
  for (int i = 0; i < 400; ++i) plane.push_back({{0.1 * (i % 20), 0.1 * (i / 20), 0.5}, 0.45});
  // Cells are columns over squares of side 0.1; away from the border a column has no dome but its own.
  const BallUnion found = measure(plane);
  const double expected = by_slices({plane.begin(), plane.begin() + 8});
  EXPECT_NEAR(measure({plane.begin(), plane.begin() + 8}).volume, expected, kExact * expected);
  EXPECT_TRUE(found.complex.tetrahedra.empty());
  EXPECT_EQ(betti_numbers(found.complex).value(), (BettiNumbers{1, 0, 0}));

  std::vector<Ball> sphere = {{{0, 0, 0}, 0.5}};
  for (int i = 0; i < 8; ++i) sphere.push_back({{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0}, 1.75});
  const double by_slice = by_slices(sphere);
  EXPECT_NEAR(measure(sphere).volume, by_slice, kExact * by_slice);
  EXPECT_EQ(betti(sphere), (BettiNumbers{1, 0, 0}));
}

/// The area is the derivative of the volume by all radii at once: a central difference, with an error of the step's
/// square.
TEST(BallUnion, AreaIsTheDerivativeOfVolume) {
  const double step = 1e-4;
  auto larger = some_balls(50, 3, 0.1, 0.3), smaller = larger;
  const BallUnion found = measure(larger);
  for (Ball& ball : larger) ball.radius += step;
  for (Ball& ball : smaller) ball.radius -= step;
  const double slope = (measure(larger).volume - measure(smaller).volume) / (2 * step);
  // The third derivative of the volume is a few thousand at most: 50 balls with 4 pi each, and the edges' changes.
  EXPECT_NEAR(found.area, slope, 1e-5 * found.area);
}

/// Each ball's share agrees with samples in its power cell, within five standard errors.
TEST(BallUnion, SharesAgainstSamples) {
  const auto balls = some_balls(30, 11, 0.1, 0.3);
  const BallUnion found = measure(balls);
  const double low = -0.3, side = 1.6;
  const int samples = 2'000'000;
  std::vector<int> hits(balls.size());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(low, low + side);
  for (int n = 0; n < samples; ++n) {
    const Point x = {coordinate(random), coordinate(random), coordinate(random)};
    double least = 0;
    std::size_t owner = balls.size();
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const auto& [c, r] = balls[i];
      const double power =
          (x[0] - c[0]) * (x[0] - c[0]) + (x[1] - c[1]) * (x[1] - c[1]) + (x[2] - c[2]) * (x[2] - c[2]) - r * r;
      if (power < least) {
        least = power;
        owner = i;
      }
    }
    if (owner < balls.size()) ++hits[owner];
  }
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double box = side * side * side, share = found.volumes[i] / box;
    const double error = box * std::sqrt(share * (1 - share) / samples);
    EXPECT_NEAR(found.volumes[i], box * hits[i] / samples, 5 * error + box / samples) << "ball " << i;
  }
}

/// A vertex of the envelope lies on its three spheres and in no ball.
TEST(BallUnion, VerticesOfTheEnvelope) {
  const auto balls = some_balls(200, 5, 0.05, 0.2);
  const BallUnion found = measure(balls);
  ASSERT_GT(found.vertices.size(), 100u);
  for (const EnvelopeVertex& vertex : found.vertices) {
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
      const auto& [c, r] = balls[i];
      const double gap = std::hypot(vertex.at[0] - c[0], vertex.at[1] - c[1], vertex.at[2] - c[2]) - r;
      const bool own = std::find(vertex.balls.begin(), vertex.balls.end(), i) != vertex.balls.end();
      if (own) {
        EXPECT_NEAR(gap, 0, 1e-9);
      } else {
        EXPECT_GT(gap, -1e-9);
      }
    }
  }
}

TEST(BallUnion, HoldsInAllUnits) {
  const auto balls = some_balls(40, 17);
  const BallUnion found = measure(balls);
  for (const double unit : {1e-30, 1e-9, 1e12}) {
    auto other = balls;
    for (auto& [c, r] : other) {
      for (double& x : c) x *= unit;
      r *= unit;
    }
    const double expected = found.volume * unit * unit * unit;
    const BallUnion again = measure(other);
    EXPECT_NEAR(again.volume, expected, kExact * expected);
    EXPECT_EQ(again.complex.edges, found.complex.edges);
  }
}

TEST(BallUnion, HoldsFarAway) {
  // Multiples of 2^-20, so that moving causes no rounding.
  auto balls = some_balls(40, 19);
  for (auto& [c, r] : balls) {
    for (double& x : c) x = std::round(x * 0x1p20) * 0x1p-20;
  }
  const BallUnion found = measure(balls);
  for (auto& [c, r] : balls) c = {c[0] + 0x1p20, c[1] - 0x1p21, c[2] + 0x1p22};
  const BallUnion again = measure(balls);
  EXPECT_NEAR(again.volume, found.volume, kExact * found.volume);
  EXPECT_EQ(again.complex.tetrahedra, found.complex.tetrahedra);
}

TEST(BallUnion, DoesNotDependOnOrderOrThreads) {
  const auto balls = some_balls(500, 23, 0.05, 0.15);
  const BallUnion found = measure(balls);
  const auto one = measure_ball_union(balls, {.threads = 1, .complex = true});
  ASSERT_TRUE(one.ok());
  EXPECT_EQ(one.value().volumes, found.volumes);  // the same bits
  EXPECT_EQ(one.value().complex.tetrahedra, found.complex.tetrahedra);

  std::vector<std::uint32_t> order(balls.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(2));
  std::vector<Ball> shuffled;
  for (const std::uint32_t i : order) shuffled.push_back(balls[i]);
  const BallUnion again = measure(shuffled);
  for (std::size_t n = 0; n < order.size(); ++n) EXPECT_NEAR(again.volumes[n], found.volumes[order[n]], 1e-15);
  EXPECT_EQ(again.complex.tetrahedra.size(), found.complex.tetrahedra.size());
}

TEST(BallUnion, OfBallsWithoutAnExtent) {
  EXPECT_EQ(measure({}).volume, 0);
  EXPECT_EQ(measure({{{1, 2, 3}, 0}}).volume, 0);
  expect_volume({{{0, 0, 0}, 1}, {{0.5, 0, 0}, 0}, {{1.5, 0, 0}, 0}}, ball_volume(1));
}

TEST(BallUnion, OneLargeBallAmongThousandsOfSmallOnes) {
  std::vector<Ball> balls = {{{0, 0, 0}, 1}};
  const int count = 3000;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, angle = i * kPi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    balls.push_back({{r * std::cos(angle), r * std::sin(angle), z}, 0.01});
  }
  expect_volume(balls, ball_volume(1) + count * (ball_volume(0.01) - lens_volume(1, 0.01, 1)));
}

TEST(BallUnion, RefusesWhatIsNoBall) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const Ball& bad : {Ball{{0, nan, 0}, 1}, Ball{{0, 0, infinity}, 1}, Ball{{0, 0, 0}, nan}, Ball{{0, 0, 0}, -1}}) {
    const std::vector<Ball> balls = {{{0, 0, 0}, 1}, bad};
    const auto result = measure_ball_union(balls);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::kUsage);
    EXPECT_THAT(result.error().message, testing::HasSubstr("ball 1"));
  }
}

}  // namespace
}  // namespace medial_vk
