// Chords of hulls, against signed distances along the lines.
#include "hull_fits/search/hull_chords.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "support/hulls/random_hulls.h"

namespace medial_vk {
namespace {

/// Lines along an axis, by the two other coordinates in cyclic order.
struct AxisLine {
  std::size_t axis;
  double u, v;

  Point at(double z) const {
    Point p;
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    p[axis] = z;
    return p;
  }
};

/// The least signed distance along a line, of a convex function, by ternary search; and where it is.
double lowest_on(const BallHull& hull, const AxisLine& line, double& z) {
  double low = -4, high = 4;
  for (int i = 0; i < 100; ++i) {
    const double a = (2 * low + high) / 3, b = (low + 2 * high) / 3;
    (signed_distance(hull, line.at(a)) < signed_distance(hull, line.at(b)) ? high : low) =
        signed_distance(hull, line.at(a)) < signed_distance(hull, line.at(b)) ? b : a;
  }
  z = 0.5 * (low + high);
  return signed_distance(hull, line.at(z));
}

/// Ends of chords are on the surface up to some hundred units in the last place (measured: below 2^-43). At the apex of
/// a cone, a ball of radius 0, both solutions of a quadratic equation are one, and have the square root of its
/// rounding.
double chord_rounding(const BallHull& hull, const AxisLine& line) {
  for (const Ball& ball : hull.balls()) {
    const Point& c = ball.centre;
    if (ball.radius == 0 && c[(line.axis + 1) % 3] == line.u && c[(line.axis + 2) % 3] == line.v) return 0x1p-25;
  }
  return 0x1p-43;
}

void expect_chord(const BallHull& hull, const AxisLine& line, int number) {
  const Chord chord = HullChords(hull, line.axis).at(line.u, line.v);
  double z;
  const double lowest = lowest_on(hull, line, z), rounding = chord_rounding(hull, line);
  if (chord.is_empty()) {
    EXPECT_GE(lowest, -rounding) << number;
    return;
  }
  EXPECT_NEAR(signed_distance(hull, line.at(chord.begin)), 0, rounding) << number;
  EXPECT_NEAR(signed_distance(hull, line.at(chord.end)), 0, rounding) << number;
  EXPECT_LE(lowest, rounding) << number;
  if (lowest < -1e-6) {
    EXPECT_LT(chord.begin, z) << number;
    EXPECT_GT(chord.end, z) << number;
  }
}

double uniform_of(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

TEST(HullChords, EndOnTheSurface) {
  for (int i = 0; i < 30'000; ++i) {
    std::mt19937_64 random(static_cast<std::uint64_t>(i));
    const BallHull hull = test::random_hull(1 + static_cast<std::uint32_t>(i % 3), random);
    const std::size_t axis = random() % 3;
    const HullBounds box = bounds_of(hull);
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double at_u = uniform_of(box.lower[u], box.upper[u], random);
    const double at_v = uniform_of(box.lower[v], box.upper[v], random);
    expect_chord(hull, {axis, at_u, at_v}, i);
  }
}

/// Axes along lines or across them, cones of which lines are parts, faces across lines and along them.
TEST(HullChords, OfHullsAlongAxes) {
  const std::array<BallHull, 8> hulls = {{
      hull_of(Ball{{0, 0, -1}, 0.5}, Ball{{0, 0, 1}, 0.5}),
      hull_of(Ball{{0, 0, -1}, 0.5}, Ball{{0, 0, 1}, 0.25}),
      hull_of(Ball{{0, 0, 0}, 0.25}, Ball{{0.375, 0, 0.5}, 0.625}),  // slope 0.6, at an angle with the cosine 0.8
      hull_of(Ball{{0, 0, 0}, 0.1}, Ball{{0.3, 0, 0.4}, 0.4}),       // the same, rounded
      hull_of(Ball{{0, 0, 0}, 0.5}, Ball{{1, 0, 0}, 0.5}, Ball{{0, 1, 0}, 0.5}),
      hull_of(Ball{{0, 0, 0}, 0.5}, Ball{{1, 0, 0}, 0.25}, Ball{{0, 1, 0}, 0.125}),
      hull_of(Ball{{0, 0, 0}, 0}, Ball{{1, 0, 0}, 0.5}, Ball{{0.5, 1, 0.25}, 0}),
      hull_of(Ball{{0, 0, 0}, 0.25}, Ball{{1, 0, 0}, 0.25}, Ball{{2, 0, 0}, 0.5}),
  }};
  for (std::size_t k = 0; k < hulls.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 300; ++i) {
        std::mt19937_64 random(static_cast<std::uint64_t>(i));
        const HullBounds box = bounds_of(hulls[k]);
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double at_u = uniform_of(box.lower[u], box.upper[u], random);
        const double at_v = uniform_of(box.lower[v], box.upper[v], random);
        SCOPED_TRACE(testing::Message() << "hull " << k << ", axis " << axis);
        expect_chord(hulls[k], {axis, at_u, at_v}, i);
      }
      const Point& c = hulls[k].corners[0].centre;  // through a centre
      expect_chord(hulls[k], {axis, c[(axis + 1) % 3], c[(axis + 2) % 3]}, -1);
    }
  }
}

TEST(HullChords, RowsHoldAllLinesThatMeetTheHull) {
  for (int i = 0; i < 10'000; ++i) {
    std::mt19937_64 random(static_cast<std::uint64_t>(i));
    const BallHull hull = test::random_hull(1 + static_cast<std::uint32_t>(i % 3), random);
    const std::size_t axis = random() % 3;
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const HullChords chords(hull, axis);
    const HullBounds box = bounds_of(hull);
    EXPECT_DOUBLE_EQ(chords.rows().begin, box.lower[v]);
    EXPECT_DOUBLE_EQ(chords.rows().end, box.upper[v]);
    const double at_v = uniform_of(box.lower[v], box.upper[v], random);
    const Chord row = chords.row(at_v);
    const double at_u = uniform_of(box.lower[u], box.upper[u], random);
    double z;
    const double lowest = lowest_on(hull, {axis, at_u, at_v}, z);
    const double rounding = chord_rounding(hull, {axis, at_u, at_v});
    if (lowest < -rounding) {
      EXPECT_LE(row.begin, at_u) << i;
      EXPECT_GE(row.end, at_u) << i;
    } else if (lowest > rounding) {
      EXPECT_FALSE(row.begin <= at_u && at_u <= row.end) << i;
    }
    for (const double end : {row.begin, row.end}) {
      if (row.is_empty()) continue;
      EXPECT_NEAR(lowest_on(hull, {axis, end, at_v}, z), 0, rounding) << i;
    }
  }
}

}  // namespace
}  // namespace medial_vk
