// Branches as polylines, and smooth ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial_vk/plane_centre_line.h"
#include "unit/plane_centre_lines/axes_of_shapes.h"

namespace medial_vk {
namespace {

using test::axis_of;
using test::axis_of_graph;

double distance(const PlanePoint& a, const PlanePoint& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Of a point of space (x, y, radius) from one piece of a polyline: the greater of the distance and the error of the
/// radius at the nearest place.
double off_piece(const AxisSample& a, const AxisSample& b, const AxisSample& p) {
  const double dx = b.point[0] - a.point[0], dy = b.point[1] - a.point[1], square = dx * dx + dy * dy;
  const double along = ((p.point[0] - a.point[0]) * dx + (p.point[1] - a.point[1]) * dy) / square;
  const double share = square > 0 ? std::clamp(along, 0.0, 1.0) : 0;
  const PlanePoint q = {a.point[0] + share * dx, a.point[1] + share * dy};
  return std::max(distance(p.point, q), std::fabs(a.radius + share * (b.radius - a.radius) - p.radius));
}

TEST(PlanePolylines, AreWithinTheStepOfTheCurves) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const PlaneAxis axis = axis_of({test::star_ring(seed, 25)}, 0.05);
    for (const double step : {1e-2, 1e-4, 1e-6}) {
      for (const AxisBranch& branch : axis.branches) {
        const std::vector<AxisSample> line = sample_branch(axis, branch, step);
        ASSERT_GE(line.size(), branch.arcs.size() + 1);
        EXPECT_EQ(line.front().point, axis.nodes[branch.ends[0]].point);
        EXPECT_EQ(line.back().point, axis.nodes[branch.ends[1]].point);
        for (std::size_t i = 0; i < branch.arcs.size(); ++i) {
          const AxisArc& arc = axis.arcs[branch.arcs[i]];
          for (int k = 0; k <= 16; ++k) {
            const double t = arc.t[0] + (arc.t[1] - arc.t[0]) * k / 16;
            const AxisSample exact = {arc.curve.point_at(t), arc.curve.radius_at(t), 0};
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t j = 1; j < line.size(); ++j)
              least = std::min(least, off_piece(line[j - 1], line[j], exact));
            EXPECT_LE(least, step + 4 * axis.epsilon);
          }
        }
      }
    }
  }
}

// The number of points of a parabola grows as the square root of 1 / step.
TEST(PlanePolylines, AFinerStepTakesAsManyPointsAsItMust) {
  const PlaneAxis axis = axis_of({{{0, 0}, {8, 0}, {8, 4}, {4, 2}, {0, 4}}}, 0.3);  // the reflex corner makes parabolas
  const auto points = [&](double step) {
    std::size_t count = 0;
    for (const AxisBranch& branch : axis.branches) count += sample_branch(axis, branch, step).size();
    return static_cast<double>(count);
  };
  EXPECT_GT(points(1e-6), 5 * points(1e-4));
  EXPECT_LT(points(1e-6), 20 * points(1e-4));
}

TEST(PlanePolylines, SmoothOnesStayInTheDiscs) {
  const PlaneAxis axis = axis_of({test::star_ring(2, 40)}, 0.3);
  for (const AxisBranch& branch : axis.branches) {
    const std::vector<AxisSample> line = sample_branch(axis, branch, 1e-5), smooth = smooth_polyline(line, 0.05);
    ASSERT_GE(smooth.size(), 2u);
    EXPECT_EQ(smooth.front().point, line.front().point);
    EXPECT_EQ(smooth.back().point, line.back().point);
    // Each disc lies in one of the line. Samples of the line are at most 1e-3 apart, and one within half of that, whose
    // radius differs by no more.
    std::vector<AxisSample> fine;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const AxisSample &a = line[i - 1], &b = line[i];
      const int parts = static_cast<int>(distance(a.point, b.point) / 1e-3) + 1;
      for (int k = 0; k <= parts; ++k) {
        const double t = static_cast<double>(k) / parts;
        fine.push_back({{a.point[0] + t * (b.point[0] - a.point[0]), a.point[1] + t * (b.point[1] - a.point[1])},
                        a.radius + t * (b.radius - a.radius),
                        0});
      }
    }
    for (const AxisSample& s : smooth) {
      EXPECT_TRUE(std::ranges::any_of(
          fine, [&](const AxisSample& t) { return distance(s.point, t.point) + s.radius <= t.radius + 1e-3 + 1e-9; }));
    }
  }
}

TEST(PlanePolylines, SmoothingLeavesStraightLinesAndStraightensZigzags) {
  std::vector<AxisSample> straight, zigzag;
  for (int i = 0; i <= 200; ++i) {
    straight.push_back({{0.05 * i, 1}, 1, 1});
    zigzag.push_back({{0.05 * i, i % 2 == 0 ? 0.02 : -0.02}, 1, 1});
  }
  for (const AxisSample& s : smooth_polyline(straight, 0.5)) {
    EXPECT_NEAR(s.point[1], 1, 1e-12);
    EXPECT_NEAR(s.radius, 1, 1e-6);
  }
  const std::vector<AxisSample> smooth = smooth_polyline(zigzag, 0.5);
  for (const AxisSample& s : smooth) {
    if (s.point[0] > 1 && s.point[0] < 9) {
      EXPECT_NEAR(s.point[1], 0, 2e-3);
    }
  }
}

TEST(PlanePolylines, ALoopIsSmoothAtItsEnds) {
  std::vector<AxisSample> circle;
  for (int i = 0; i <= 400; ++i) {
    const double angle = 2 * std::numbers::pi * i / 400;
    circle.push_back({{std::cos(angle), std::sin(angle)}, 0.5, 1});
  }
  circle.back() = circle.front();
  const std::vector<AxisSample> smooth = smooth_polyline(circle, 0.2, true);
  EXPECT_EQ(smooth.front().point, smooth.back().point);
  // A Gaussian of 0.2 radians makes the circle smaller by exp(-0.02), everywhere the same.
  for (const AxisSample& s : smooth) EXPECT_NEAR(std::hypot(s.point[0], s.point[1]), std::exp(-0.02), 2e-3);
  EXPECT_EQ(smooth_polyline({circle.front()}, 1).size(), 1u);
}

}  // namespace
}  // namespace medial_vk
