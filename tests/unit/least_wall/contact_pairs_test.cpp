// Pairs of contacts: random balls with contacts that are known up to cones.
#include "least_wall/contact_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace medial_vk::test {
namespace {

constexpr double kTheta = 1.2;

class RandomContacts {
 public:
  explicit RandomContacts(std::uint64_t seed) : random_(seed) {}

  double share() { return share_(random_); }

  Point direction() {
    std::normal_distribution<> normal;
    const Point p = {normal(random_), normal(random_), normal(random_)};
    return (1 / length(p)) * p;
  }

  /// Of a random axis, that holds the direction.
  SpokeCone cone_around(const Point& direction_inside) {
    const Point moved = direction_inside + share() * direction();
    const Point axis = (1 / length(moved)) * moved;
    return {axis, angle_between(axis, direction_inside) + kAngleRounding};
  }

  std::size_t number_to(std::size_t most) { return std::uniform_int_distribution<std::size_t>(0, most)(random_); }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<> share_{0, 1};
};

/// Of unit vectors.
Point turned_from(const Point& u, const Point& towards, double angle) {
  const Point across = towards - dot(towards, u) * u;
  return std::cos(angle) * u + (std::sin(angle) / length(across)) * across;
}

// The centre c is the origin. Other contacts do not raise the bound.
TEST(ContactPairs, BoundNoBallAway) {
  RandomContacts random(5);
  int useful = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double radius = 0.2 + random.share(), h = radius * std::pow(10, -3 * random.share()) / 2;
    const Point m = (h * random.share()) * random.direction(), u = random.direction();
    const double half_angle = kTheta + (0.5 * std::numbers::pi - kTheta) * random.share();
    const Point v = turned_from(u, random.direction(), 2 * half_angle);
    std::vector<PossibleContact> contacts;
    for (const Point& spoke : {u, v}) {
      const double away = length(m + radius * spoke) * (1 - 0.1 * random.share() * random.share());
      contacts.push_back({random.cone_around(spoke), random.cone_around(spoke), away});
    }
    for (std::size_t k = random.number_to(4); k > 0; --k) {
      const Point other = random.direction();
      contacts.push_back({random.cone_around(other), random.cone_around(other), radius * (1 + random.share())});
    }
    std::swap(contacts[random.number_to(contacts.size() - 1)], contacts.front());
    const double bound = least_radius_of_pairs(contacts, h, kTheta, 0, 0);
    EXPECT_LE(bound, radius * (1 + 1e-12)) << i;
    useful += bound > 0.9 * radius ? 1 : 0;
  }
  EXPECT_GT(useful, 1000);
}

std::vector<PossibleContact> contacts_along(const std::vector<Point>& spokes, double distance) {
  std::vector<PossibleContact> contacts;
  contacts.reserve(spokes.size());
  for (const Point& spoke : spokes) contacts.push_back({{spoke, 0.01}, {spoke, 0.01}, distance});
  return contacts;
}

TEST(ContactPairs, AreNotPossibleAtASeamOfThreeSheets) {
  const double s = std::sqrt(0.75);
  std::vector<PossibleContact> contacts = contacts_along({{1, 0, 0}, {-0.5, s, 0}, {-0.5, -s, 0}}, 1);
  EXPECT_EQ(least_radius_of_pairs(contacts, 0.01, kTheta, 0, 0), std::numeric_limits<double>::infinity());
  EXPECT_LT(least_radius_of_pairs(contacts, 0.01, 1.0, 0, 0), 1);
  EXPECT_EQ(least_radius_of_pairs(contacts, 0.01, 1.0, 0.999, 0), 0.999);  // what is known
}

// The bound of a wall with parallel sides from beside its middle, with spokes that are known up to rounding.
TEST(ContactPairs, OfParallelSidesLoseTheSquareOfTheCell) {
  std::vector<PossibleContact> contacts = contacts_along({{0, 0, 1}, {0, 0, -1}}, 1);
  for (PossibleContact& contact : contacts) contact.by_normals.angle = 0;
  contacts[0].distance = 0.9;
  contacts[1].distance = 1.1;
  const double bound = least_radius_of_pairs(contacts, 0.1, kTheta, 0, 0);
  // The mean of the squares is 1.01; half the rounding of angles stands for the cosine.
  EXPECT_NEAR(bound, std::sqrt(1.01 - 0.01), 0.1 * kAngleRounding);
}

// Where triangles are parallel, or an edge is parallel to a triangle, the bound is exact in a cell of any size.
TEST(ContactPairs, OfParallelFacesLoseNothingByHeights) {
  std::vector<PossibleContact> contacts = contacts_along({{0, 0, 1}, {0, 0, -1}}, 0.5);
  contacts[0].corners = {Point{1, 0, 0.9}, {-1, 2, 0.9}, {-1, -2, 0.9}};
  contacts[1].corners = {Point{3, 0, -1.1}, {-2, 3, -1.1}, {-1, -2, -1.1}};
  EXPECT_NEAR(least_radius_of_pairs(contacts, 0.45, kTheta, 0, 0), 1, 1e-15);
  EXPECT_NEAR(least_radius_of_pairs(contacts, 0.45, kTheta, 0, 0.125), 0.875, 1e-15);
  // The edge's cap is that of a face beside it and another one.
  contacts[1].corners = {Point{3, 1, -1.1}, {-2, 3, -1.1}, {-2, 3, -1.1}};
  contacts[1].by_normals = {{std::sin(0.1), 0, -std::cos(0.1)}, 0.11};
  EXPECT_NEAR(least_radius_of_pairs(contacts, 0.45, kTheta, 0, 0), 1, 1e-15);
}

// Balls that touch two triangles, which they do not cut: random ones through the contacts and across the spokes.
TEST(ContactPairs, BoundNoBallAwayByHeights) {
  RandomContacts random(6);
  int useful = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double radius = 0.2 + random.share();
    const Point m = random.direction(), u = random.direction();
    const double half_angle = kTheta + (0.5 * std::numbers::pi - kTheta) * random.share();
    std::vector<PossibleContact> pair;
    for (const Point& spoke : {u, turned_from(u, random.direction(), 2 * half_angle)}) {
      const Point x = m + radius * spoke, along = turned_from(spoke, random.direction(), 0.5 * std::numbers::pi),
                  across = cross(spoke, along);
      const double size = random.share();
      const std::array<Point, 3> corners = {x + size * along, x - size * along + size * across,
                                            x - size * along - size * across};
      pair.push_back({{spoke, 0}, {spoke, 0}, 0, corners});
    }
    const double bound = least_radius_by_heights(pair[0], pair[1], 0);
    EXPECT_LE(bound, radius * (1 + 1e-12)) << i;
    useful += bound > 0.9 * radius ? 1 : 0;
  }
  EXPECT_GT(useful, 1000);
}

// A triangle whose position and normal do not agree is not touched.
TEST(ContactPairs, NeedPositionsAlongNormals) {
  std::vector<PossibleContact> contacts = contacts_along({{0, 0, 1}, {0, 0, -1}}, 1);
  contacts[1].by_normals.axis = {0, 0, 1};
  EXPECT_EQ(least_radius_of_pairs(contacts, 0.01, kTheta, 0, 0), std::numeric_limits<double>::infinity());
}

bool holds(const SpokeCone& cap, const Point& direction) {
  return cap.axis == Point{0, 0, 0} || angle_between(cap.axis, direction) <= cap.angle + kAngleRounding;
}

FacingTriangle facing(const Point& a, const Point& b, const Point& c) {
  const Point area = cross(b - a, c - a);
  return {{a, b, c}, {(1 / length(area)) * area, 0}};
}

std::vector<SpokeCone> caps_of(std::span<const FacingTriangle> triangles) {
  std::vector<const SpokeCone*> memory;
  std::vector<SpokeCone> caps;
  spokes_by_normals(triangles, 1e-15, memory, caps);
  return caps;
}

// Two triangles at an edge, one below that is parallel to the first, and one with a corner inside the first.
TEST(ContactPairs, TakeNormalsOfTrianglesThatMeet) {
  const std::vector<FacingTriangle> triangles = {
      facing({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), facing({0, 1, 0}, {1, 0, 0}, {1, 1, -0.3}),
      facing({0, 0, -0.1}, {0, 1, -0.1}, {1, 0, -0.1}), facing({0.2, 0.2, 0}, {0.3, 0.3, 0.1}, {0.1, 0.2, 0.1})};
  std::vector<SpokeCone> caps = caps_of({triangles.data(), 3});
  EXPECT_TRUE(holds(caps[0], triangles[0].normal.axis) && holds(caps[0], triangles[1].normal.axis));
  EXPECT_LT(caps[0].angle, 0.3);
  EXPECT_LT(caps[2].angle, 1e-6);
  caps = caps_of(triangles);
  for (const std::size_t i : {0u, 1u, 3u}) EXPECT_TRUE(holds(caps[0], triangles[i].normal.axis)) << i;
  EXPECT_TRUE(holds(caps[3], triangles[0].normal.axis));
}

TEST(ContactPairs, KnowNothingBesideAnUnknownNormal) {
  std::vector<FacingTriangle> triangles = {facing({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
                                           facing({0, 1, 0}, {1, 0, 0}, {1, 1, -0.3})};
  triangles[1].normal = {};
  for (const SpokeCone& cap : caps_of(triangles)) EXPECT_EQ(cap.axis, (Point{0, 0, 0}));
}

// Two triangles of a plane, and one whose normal is turned from theirs by an angle t, meet at a vertex. That normal has
// the angle t - atan(sin t / (2 + cos t)) with their sum: 92 degrees for t = 122, and 82 degrees for t = 112.
TEST(ContactPairs, KnowNoCapWiderThanAHemisphere) {
  const auto caps_for = [](double degrees) {
    const double t = degrees * std::numbers::pi / 180;
    return caps_of(std::vector{facing({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), facing({0, 0, 0}, {0, 1, 0}, {-1, 0, 0}),
                               facing({1, 0, 0}, {0, 0, 0}, {0.5, -std::cos(t), -std::sin(t)})});
  };
  for (const SpokeCone& cap : caps_for(122)) EXPECT_EQ(cap.axis, (Point{0, 0, 0}));
  for (const SpokeCone& cap : caps_for(112)) EXPECT_NEAR(cap.angle, 82.3 * std::numbers::pi / 180, 0.01);
}

}  // namespace
}  // namespace medial_vk::test
