// Planes between hulls and points, against exact arithmetic.
#include "hull_fits/proof/separation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "support/exact_number.h"
#include "support/hulls/random_hulls.h"

namespace medial_vk {
namespace {

using test::ExactNumber;

ExactNumber exact_dot(const std::array<ExactNumber, 3>& a, const std::array<ExactNumber, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether u . t - u . c - |u| (r + x) >= 0, or > 0, exactly, for all points t and balls (c, r).
bool exactly_apart(std::span<const Point> points, const BallHull& hull, const Point& u, double x, bool strictly) {
  const std::array<ExactNumber, 3> normal = {u[0], u[1], u[2]};
  const ExactNumber squared = exact_dot(normal, normal);
  for (const Point& t : points) {
    for (const Ball& ball : hull.balls()) {
      const Point& c = ball.centre;
      const std::array<ExactNumber, 3> offset = {ExactNumber(t[0]) - c[0], ExactNumber(t[1]) - c[1],
                                                 ExactNumber(t[2]) - c[2]};
      const ExactNumber a = exact_dot(normal, offset), r = ExactNumber(ball.radius) + x;
      // The sign of a - |u| r.
      const ExactNumber difference = a * a - squared * r * r;
      int sign;
      if (a.sign() >= 0) {
        sign = r.sign() < 0 ? 1 : difference.sign();
      } else {
        sign = r.sign() >= 0 ? -1 : -difference.sign();
      }
      if (strictly ? sign <= 0 : sign < 0) return false;
    }
  }
  return true;
}

struct Case {
  std::vector<Point> points;
  BallHull hull;
  Point u;
};

/// `close`: points so near to a plane that touches the hull that their side is in the rounding, and beyond it.
Case random_case(bool close, std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Case made;
  made.hull = test::random_hull(1 + static_cast<std::uint32_t>(random() % 3), random);
  for (double& x : made.u) x = random() % 8 == 0 ? 0 : uniform(-1, 1);
  if (made.u == Point{}) made.u[0] = 1;
  const double factor = std::ldexp(1, static_cast<int>(random() % 40) - 20);
  made.u = factor * made.u;
  const double size = length(made.u);
  double top = -HUGE_VAL;
  for (const Ball& ball : made.hull.balls()) top = std::max(top, dot(made.u, ball.centre) / size + ball.radius);
  const std::size_t count = 1 + random() % 3;
  for (std::size_t i = 0; i < count; ++i) {
    Point p = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    const double height = close ? uniform(-1, 1) * std::pow(10, uniform(-17, -13)) : uniform(-0.5, 1);
    p = p + ((top + height) / size - dot(made.u, p) / size / size) * made.u;
    made.points.push_back(p);
  }
  const Point away = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
  if (random() % 4 == 0) {  // far from the origin: differences are rounded as before, or cancel exactly
    for (Point& p : made.points) p = p + 1e3 * away;
    for (Ball& ball : made.hull.corners) ball.centre = ball.centre + 1e3 * away;
  }
  return made;
}

TEST(Separation, IsNeverMoreThanTheExactOne) {
  std::mt19937_64 random(36);
  int positive = 0, negative = 0;
  for (int i = 0; i < 8'000; ++i) {
    const Case made = random_case(i % 4 != 0, random);
    const double found = separation(made.points, made.hull, made.u);
    ASSERT_TRUE(std::isfinite(found));
    EXPECT_TRUE(exactly_apart(made.points, made.hull, made.u, found, false)) << i << ": " << found;
    if (found > 0) {
      EXPECT_TRUE(exactly_apart(made.points, made.hull, made.u, 0, true)) << i;
    }
    ++(found > 0 ? positive : negative);
  }
  EXPECT_GT(positive, 1'000);
  EXPECT_GT(negative, 1'000);
}

// By the comment there its errors are below 12 units of the sums of absolute products, and it takes off as much.
TEST(Separation, FindsWhatIsAboveTwiceItsRounding) {
  std::mt19937_64 random(37);
  int above = 0, below = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Case made = random_case(i % 4 != 0, random);
    const long double size = std::hypot(static_cast<long double>(made.u[0]), static_cast<long double>(made.u[1]),
                                        static_cast<long double>(made.u[2]));
    const Point& origin = made.hull.corners[0].centre;
    const auto product = [&](const Point& p, bool absolute) {
      long double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const long double x = made.u[k] * (static_cast<long double>(p[k]) - origin[k]);
        sum += absolute ? std::fabs(x) : x;
      }
      return sum;
    };
    long double least = HUGE_VALL, greatest = -HUGE_VALL, of_points = 0, of_balls = 0;
    for (const Point& p : made.points) {
      least = std::min(least, product(p, false));
      of_points = std::max(of_points, product(p, true));
    }
    for (const Ball& ball : made.hull.balls()) {
      greatest = std::max(greatest, product(ball.centre, false) + size * ball.radius);
      of_balls = std::max(of_balls, product(ball.centre, true) + size * ball.radius);
    }
    const bool is_above = least - greatest > 24 * 0x1p-53L * (of_points + of_balls);
    if (is_above) {
      EXPECT_GT(separation(made.points, made.hull, made.u), 0) << i;
    }
    if (least > greatest) ++(is_above ? above : below);
  }
  EXPECT_GT(above, 2'000);
  EXPECT_GT(below, 200) << "separations in the rounding are among the cases";
}

TEST(Separation, KnowsNothingByNumbersThatAreNotFinite) {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const BallHull hull = hull_of({{0, 0, 0}, 1}, {{1, 0, 0}, 0.5});
  const std::vector<Point> points = {{0, 0, 3}, {1, 0, 3}, {0, 1, 3}};
  EXPECT_GT(separation(points, hull, {0, 0, 1}), 1.9);
  EXPECT_EQ(separation(points, hull, {0, 0, 0}), kNothing);
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_EQ(separation(points, hull, {0, bad, 1}), kNothing);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        std::vector<Point> others = points;
        others[i][k] = bad;
        EXPECT_EQ(separation(others, hull, {0, 0, 1}), kNothing) << bad << " in point " << i;
        if (i == 2) continue;
        BallHull other = hull;
        other.corners[i].centre[k] = bad;
        EXPECT_EQ(separation(points, other, {0, 0, 1}), kNothing) << bad << " in centre " << i;
      }
    }
    BallHull other = hull;
    other.corners[1].radius = bad;
    EXPECT_EQ(separation(points, other, {0, 0, 1}), kNothing) << bad;
  }
  // Differences that overflow.
  EXPECT_EQ(separation(std::vector<Point>{{1.7e308, 0, 3}}, hull_of(Ball{{-1.7e308, 0, 0}, 1}), {0, 0, 1}), kNothing);
}

TEST(Separation, IsRightWhereProductsUnderflow) {
  std::mt19937_64 random(38);
  int positive = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto any = [&](double scale, int most) {
      return scale * static_cast<double>(1 + static_cast<int>(random() % static_cast<unsigned>(most)));
    };
    // |u| is near the least length that is taken, so that products are some units of the least number.
    const Point u = {any(1e-140, 5), any(1e-140, 5), any(1e-140, 5)};
    const double unit = std::numeric_limits<double>::denorm_min() / 1e-139;
    const int most = i % 2 == 0 ? 30 : 3000;
    const Point p = {any(unit, most), any(unit, most), any(unit, most)};
    const BallHull hull = hull_of(Ball{{0, 0, 0}, any(unit, 2 * most)});
    if (!(separation(std::vector<Point>{p}, hull, u) > 0)) continue;
    ++positive;
    EXPECT_TRUE(exactly_apart(std::vector<Point>{p}, hull, u, 0, true)) << i;
  }
  EXPECT_GT(positive, 100);
}

// A positive margin that is too small for a quotient is no separation; a negative one is none either.
TEST(Separation, TouchingIsNone) {
  const BallHull flat = hull_of({{0, 0, 0}, 0}, {{0, 1, 0}, 0}, {{0, 0, 1}, 0});
  const std::vector<Point> beside = {{0, 2, 0}, {0, 3, 0}, {0, 2, 1}};
  for (const double u : {1.0, 1e3, 1e30}) {
    EXPECT_FALSE(separation(beside, flat, {u, 0, 0}) > 0) << u;
    EXPECT_GT(separation(beside, flat, {0, u, 0}), 0.9) << u;
  }
}

}  // namespace
}  // namespace medial_vk
