// The proof that a cell is empty: cells around points that are medial are never dismissed, cells far from any are.
#include "any_boundary/spread_test.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "support/any_boundary/boundaries.h"

namespace medial_vk::test {
namespace {

using namespace any_boundary;

constexpr double kObjectAngle = 0.6;

class RandomPoints {
 public:
  explicit RandomPoints(std::uint64_t seed) : random_(seed) {}

  double share() { return share_(random_); }
  Point direction() {
    const double x = normal_(random_), y = normal_(random_), z = normal_(random_);
    return (1 / length({x, y, z})) * Point{x, y, z};
  }
  Point in_unit_cube() {
    const double x = share(), y = share(), z = share();
    return {x - 0.5, y - 0.5, z - 0.5};
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<> share_{0, 1};
  std::normal_distribution<> normal_;
};

/// The unit cell around the origin, with answers that are the worst that `error` allows: any of the points that are
/// nearly as near as the nearest, and not exactly that point.
struct Surroundings {
  std::array<Point, kSamples> contacts;
  Point nearest;

  Surroundings(const std::vector<Point>& points, double error, RandomPoints& random) {
    const auto answer = [&](const Point& p) {
      const double least = length(nearest_of(points, p) - p);
      std::vector<Point> near;
      for (const Point& q : points) {
        if (length(q - p) <= least + 0.5 * error) near.push_back(q);
      }
      const auto one = static_cast<std::size_t>(random.share() * static_cast<double>(near.size()));
      return near[one] + (0.5 * error) * random.direction();
    };
    nearest = answer({0, 0, 0});
    for (std::size_t s = 0; s < kSamples; ++s) {
      const auto& [x, y, z] = sample_offsets()[s];
      contacts[s] = answer({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
    }
  }
  SampledCell cell(double error) const { return {{0, 0, 0}, 1, nearest, contacts, error}; }
};

/// Points on a circle, seen from `x` at the object angle from the axis, at the least, so that x is medial. One point on
/// the axis, hardly farther from x, is often nearest to the centre of the cell; the others are then as far from the
/// middle of all contacts as they can be. More points are at least as far from x.
std::vector<Point> cloud_with_medial_point(const Point& x, double distance, RandomPoints& random) {
  const Point behind = (0.2 * random.share() * length(x)) * random.direction() - x;
  const Point axis = (1 / length(behind)) * behind;
  const Point first = perpendicular_to(axis), second = cross(axis, first);
  const double angle = kObjectAngle * (1 + 1e-9), turn = 6.3 * random.share();
  const int pairs = 1 + static_cast<int>(12 * random.share()), others = static_cast<int>(8 * random.share());
  std::vector<Point> points = {x + (distance + 0.17 * random.share() * length(x)) * axis};
  for (int i = 0; i < 2 * pairs; ++i) {
    const double azimuth = turn + std::numbers::pi * i / pairs;
    const Point across = std::cos(azimuth) * first + std::sin(azimuth) * second;
    points.push_back(x + distance * (std::cos(angle) * axis + std::sin(angle) * across));
  }
  for (int i = 0; i < others; ++i) {
    const double farther = 1 + random.share() * random.share();
    points.push_back(x + (distance * farther) * random.direction());
  }
  return points;
}

/// In the cell, often at one of its corners.
Point random_place(RandomPoints& random) {
  Point x = random.in_unit_cube();
  if (random.share() < 0.5) {
    for (double& k : x) k = std::copysign(0.5, k);
  }
  return x;
}

TEST(SpreadTest, NeverDismissesAMedialPoint) {
  RandomPoints random(3);
  const SpreadTest test;
  for (int i = 0; i < 40'000; ++i) {
    const Point x = random_place(random);
    const double distance = std::pow(10, 1 + 2 * random.share());
    const std::vector<Point> points = cloud_with_medial_point(x, distance, random);
    const double error = i % 2 == 0 ? 1e-13 * distance : 0.1 * random.share();
    const Surroundings around(points, error, random);
    ASSERT_FALSE(test.dismisses(around.cell(error), kObjectAngle)) << i;
  }
}

// The least object angle that is not dismissed is a bound for all medial points; it is not much greater than the angle.
TEST(SpreadTest, DismissesAnglesBeyondThatOfTheMedialPoint) {
  RandomPoints random(4);
  const SpreadTest test;
  int dismissed = 0;
  constexpr int kClouds = 200;
  for (int i = 0; i < kClouds; ++i) {
    const Point x = random.in_unit_cube(), axis = random.direction(), across = perpendicular_to(axis);
    const std::vector<Point> points = {x + 200.0 * (std::cos(0.3) * axis + std::sin(0.3) * across),
                                       x + 200.0 * (std::cos(0.3) * axis - std::sin(0.3) * across)};
    const Surroundings around(points, 0, random);
    ASSERT_FALSE(test.dismisses(around.cell(1e-12), 0.3 - 1e-9));
    dismissed += test.dismisses(around.cell(1e-12), 1.0) ? 1 : 0;
  }
  EXPECT_EQ(dismissed, kClouds);
}

/// The cell around the origin at a depth below a plane wall.
bool is_dismissed_below_plane(const SpreadTest& test, const Point& normal, double depth, double object_angle) {
  const auto foot = [&](const Point& p) { return p - (dot(p, normal) + depth) * normal; };
  std::array<Point, kSamples> contacts;
  for (std::size_t s = 0; s < kSamples; ++s) {
    const auto& [x, y, z] = sample_offsets()[s];
    contacts[s] = foot({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  }
  const Point centre = {0, 0, 0};
  return test.dismisses({centre, 1, foot(centre), contacts, 1e-12}, object_angle);
}

// At any inclination: the depths of docs/theory.md.
TEST(SpreadTest, DismissesCellsBelowAPlane) {
  RandomPoints random(5);
  const SpreadTest test;
  for (int i = 0; i < 500; ++i) {
    const Point normal = random.direction();
    EXPECT_TRUE(is_dismissed_below_plane(test, normal, 6.1, 0.6)) << i;
    EXPECT_TRUE(is_dismissed_below_plane(test, normal, 10.8, 0.3)) << i;
    EXPECT_TRUE(is_dismissed_below_plane(test, normal, 4.1, 1.2)) << i;
    EXPECT_FALSE(is_dismissed_below_plane(test, normal, 2, 0.6)) << i;
  }
}

}  // namespace
}  // namespace medial_vk::test
