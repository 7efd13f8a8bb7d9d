// Elements of SVG and commands of paths: the points that they stand for.
#include <fmt/format.h>

#include <numbers>

#include "shape_files/svg/svg_path.h"
#include "unit/shape_files/read_for_tests.h"

namespace medial_vk {
namespace {

using shape_tests::area_of;
using shape_tests::expect_ring;
using shape_tests::fault_of_svg;
using shape_tests::ring_of_path;
using shape_tests::ring_of_svg;
using shape_tests::shape_of_svg;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

TEST(SvgPath, LinesOfAllKinds) {
  const PlaneRing square = {{1, 2}, {4, 2}, {4, 6}, {1, 6}};
  expect_ring(ring_of_path("M1 2L4 2L4 6L1 6Z"), square);
  expect_ring(ring_of_path("M1,2 4,2 4,6 1,6z"), square);
  expect_ring(ring_of_path("m1 2 3 0 0 4-3 0z"), square);
  expect_ring(ring_of_path("M1 2H4V6H1Z"), square);
  expect_ring(ring_of_path("m1 2h3v4h-3z"), square);
  expect_ring(ring_of_path(" M 1 2 H 2 4 V 3 6 H 1 \n Z "), {{1, 2}, {2, 2}, {4, 2}, {4, 3}, {4, 6}, {1, 6}});
}

TEST(SvgPath, NumbersNeedNoSeparators) {
  expect_ring(ring_of_path("M1-2.5e1.5-3L+4.25.5-.5.5"), {{1, -25}, {0.5, -3}, {4.25, 0.5}, {-0.5, 0.5}});
  expect_ring(ring_of_path("M1.e0,2L3E-1-4e+0 5.,6."), {{1, 2}, {0.3, -4}, {5, 6}});
}

TEST(SvgPath, APartAfterZBeginsWhereTheLastDid) {
  const ShapeFile shape = shape_of_svg("<path d='M1 1h2v2zl-1 0 0-1zm5 5h1v1'/>");
  ASSERT_EQ(shape.rings.size(), 3u);
  expect_ring(shape.rings[1], {{1, 1}, {0, 1}, {0, 0}});
  expect_ring(shape.rings[2], {{6, 6}, {7, 6}, {7, 7}});
  EXPECT_EQ(shape.closed_lines, 1u);
}

TEST(SvgPath, SmoothCurvesReflectTheLastControlPoint) {
  const std::vector<Outline> cubic = parse_svg_path("M0 0C1 2 3 4 5 5s2 3 4 4S1 2 0 0", {});
  ASSERT_EQ(cubic[0].curves.size(), 3u);
  EXPECT_THAT(cubic[0].curves[1].first, ElementsAre(7, 6));  // 2 (5, 5) - (3, 4)
  EXPECT_THAT(cubic[0].curves[1].second, ElementsAre(7, 8));
  EXPECT_THAT(cubic[0].curves[2].first, ElementsAre(11, 10));  // 2 (9, 9) - (7, 8)
  const std::vector<Outline> quadratic = parse_svg_path("M0 0Q1 2 3 3t2-1T9 9", {});
  EXPECT_THAT(quadratic[0].curves[1].first, ElementsAre(5, 4));
  EXPECT_THAT(quadratic[0].curves[1].end, ElementsAre(5, 2));
  EXPECT_THAT(quadratic[0].curves[2].first, ElementsAre(5, 0));
}

TEST(SvgPath, SmoothCurvesAfterOtherCommandsBeginStraight) {
  for (const char* data : {"M0 0L5 5S7 8 9 9", "M0 0Q1 2 5 5S7 8 9 9", "M0 0A9 9 0 0 0 5 5S7 8 9 9"}) {
    EXPECT_THAT(parse_svg_path(data, {})[0].curves[1].first, ElementsAre(5, 5)) << data;
  }
  EXPECT_THAT(parse_svg_path("M0 0C1 2 3 4 5 5T9 9", {})[0].curves[1].first, ElementsAre(5, 5));
}

/// Of the four arcs of a radius between two points, by their middles: centres are (1, 1) and (0, 0).
TEST(SvgPath, FlagsChooseAmongFourArcs) {
  const double r = std::sqrt(0.5);
  const auto middle = [](const std::string& flags) {
    const std::vector<Outline> outlines = parse_svg_path("M1 0A1 1 0 " + flags + " 0 1", {});
    const PlaneCurve& arc = outlines[0].curves[0];
    const double angle = arc.begin + arc.sweep / 2;
    return PlanePoint{arc.centre[0] + arc.first[0] * std::cos(angle) + arc.second[0] * std::sin(angle),
                      arc.centre[1] + arc.first[1] * std::cos(angle) + arc.second[1] * std::sin(angle)};
  };
  const auto near = [](const PlanePoint& p, double x, double y) { return std::hypot(p[0] - x, p[1] - y) < 1e-15 * 10; };
  EXPECT_TRUE(near(middle("0 1"), r, r));
  EXPECT_TRUE(near(middle("0 0"), 1 - r, 1 - r));
  EXPECT_TRUE(near(middle("1 1"), 1 + r, 1 + r));
  EXPECT_TRUE(near(middle("1 0"), -r, -r));
  EXPECT_TRUE(near(middle("01"), r, r)) << "flags need no separator";
}

TEST(SvgPath, AnArcThatIsTooSmallIsEnlarged) {
  const Outline outline = parse_svg_path("M-2 0a1 1 0 0 1 4 0", {})[0];
  EXPECT_NEAR(std::hypot(outline.curves[0].first[0], outline.curves[0].first[1]), 2, 1e-15);
  EXPECT_NEAR(outline.curves[0].centre[0], 0, 1e-15);
  EXPECT_NEAR(outline.curves[0].sweep, kPi, 1e-15);
}

TEST(SvgPath, ATurnedArcTouchesItsBox) {
  // Half of the ellipse with half-axes 2 and 1, turned by 90 degrees: 1 wide and 2 high.
  const ShapeFile shape = shape_of_svg("<path d='M0-2A2 1 90 0 1 0 2Z'/>");
  EXPECT_NEAR(area_of(shape), kPi, 2e-3);
  double most = 0;
  for (const PlanePoint& p : shape.rings[0]) most = std::max(most, p[0]);
  EXPECT_NEAR(most, 1, 1e-3);
}

TEST(SvgPath, ArcsWithoutExtentAreLinesOrNothing) {
  expect_ring(ring_of_path("M0 0A0 5 0 0 1 4 0L4 4Z"), {{0, 0}, {4, 0}, {4, 4}});
  expect_ring(ring_of_path("M0 0A5 5 0 0 1 0 0L4 0L4 4Z"), {{0, 0}, {4, 0}, {4, 4}});
  expect_ring(ring_of_path("M0 0A1e-320 5 0 0 1 4 0L4 4Z"), {{0, 0}, {4, 0}, {4, 4}});
}

TEST(SvgPath, AWideArcIsNoUnitOfTheFlatness) {
  // A radius of 1e6 makes this side bend by 1.25e-5: far less than 1e-4 of the shape, not of the circle.
  EXPECT_EQ(ring_of_path("M0 0A1e6 1e6 0 0 1 10 0V10H0Z").size(), 4u);
  const ShapeFile shape = shape_of_svg("<path d='M0 0A1e6 1e6 0 0 1 10 0V10H0Z'/>");
  EXPECT_NEAR(shape.flatness, 1e-3, 1e-8);
}

/// Whatever the radius, the arc stays within half of a chord from it, and the angle within that of the flags.
TEST(SvgPath, ArcsOfAnyRadiusAreBounded) {
  for (double radius = 10; radius < 1e300; radius *= 7) {
    for (const char* flags : {"0 0", "0 1"}) {
      const std::string arc = fmt::format("A{0} {0} 33 {1} 13 14", radius, flags);
      const ShapeFile shape = shape_of_svg("<path d='M3 4" + arc + "L-5 30Z'/>");
      EXPECT_LE(shape.flatness, 3e-3) << arc;
      EXPECT_NEAR(area_of(shape), 170, 300 / radius + 0.05) << arc;  // two thirds of the chord times the bend
    }
  }
}

/// Nearly whole circles, as programs write them that cannot write a whole one.
TEST(SvgPath, ArcsBetweenNearPointsMayBeLong) {
  for (const char* gap : {"1e-3", "1e-6", "1e-9", "1e-12"}) {
    EXPECT_NEAR(area_of(shape_of_svg(fmt::format("<path d='M0 0a2 2 0 1 1 {} 0Z'/>", gap))), 4 * kPi, 6e-3) << gap;
  }
}

TEST(SvgPath, MistakesAreNamed) {
  EXPECT_EQ(fault_of_svg("\n<path d='L1 1'/>"), "s.svg:2: <path>: d: the path does not begin with the command M");
  EXPECT_THAT(fault_of_svg("<path d='M1 1 L2'/>"), HasSubstr("it ends where a number is expected"));
  EXPECT_THAT(fault_of_svg("<path d='M1 1 R2 2'/>"), HasSubstr("\"R2 2\" is no command of a path"));
  EXPECT_THAT(fault_of_svg("<path d='M1 1 L2 2 z 3 3'/>"), HasSubstr("\"3 3\" is no command of a path"));
  EXPECT_THAT(fault_of_svg("<path d='M1 1 A1 1 0 2 0 3 3'/>"), HasSubstr("is not a flag of an arc"));
  EXPECT_THAT(fault_of_svg("<path d='M1 1e999 2 2'/>"), HasSubstr("beyond the range of a double"));
  EXPECT_THAT(fault_of_svg("<path d='M1 1,,2 2'/>"), HasSubstr("is no command"));
  EXPECT_THAT(fault_of_svg("<path d='M0 0H1e200V1'/>"), HasSubstr("s.svg:1: <path>: a coordinate is beyond 1e150"));
}

TEST(SvgShapes, Rectangles) {
  expect_ring(ring_of_svg("<rect x='1' y='2' width='3' height='4'/>"), {{1, 2}, {4, 2}, {4, 6}, {1, 6}});
  EXPECT_THAT(fault_of_svg("<rect width='3'/>"), HasSubstr("no element of this SVG has an area"));
  EXPECT_THAT(fault_of_svg("<rect width='-3' height='1'/>"), HasSubstr("<rect>: width is negative"));
}

/// Corners are quarters of ellipses, whose radii are half of the sides at most; one that is missing is that of the
/// other.
TEST(SvgShapes, RoundedRectangles) {
  const auto area = [](const std::string& radii) {
    return area_of(shape_of_svg("<rect width='10' height='6' " + radii + "/>"));
  };
  const double tolerance = 2 * kPi * 5 * 1e-3;  // the flatness along all corners
  EXPECT_NEAR(area("rx='2' ry='1'"), 60 - (4 - kPi) * 2, tolerance);
  EXPECT_NEAR(area("rx='2'"), 60 - (4 - kPi) * 4, tolerance);
  EXPECT_NEAR(area("ry='2'"), 60 - (4 - kPi) * 4, tolerance);
  EXPECT_NEAR(area("rx='9' ry='9'"), 60 - (4 - kPi) * 15, tolerance);
  EXPECT_EQ(area("rx='2' ry='0'"), 60);
}

TEST(SvgShapes, CirclesAndEllipses) {
  EXPECT_NEAR(area_of(shape_of_svg("<circle cx='5' cy='6' r='2'/>")), 4 * kPi, 2 * kPi * 2 * 4e-4);
  EXPECT_NEAR(area_of(shape_of_svg("<ellipse cx='5' rx='3' ry='1'/>")), 3 * kPi, 2 * kPi * 3 * 6e-4);
  EXPECT_NEAR(area_of(shape_of_svg("<ellipse rx='3'/>")), 9 * kPi, 2 * kPi * 3 * 6e-4);
  for (const PlanePoint& p : ring_of_svg("<circle cx='5' cy='6' r='2'/>")) {
    EXPECT_NEAR(std::hypot(p[0] - 5, p[1] - 6), 2, 1e-14);
  }
  EXPECT_THAT(fault_of_svg("<circle r='0'/>"), HasSubstr("no element"));
}

TEST(SvgShapes, PolygonsAndPolylines) {
  expect_ring(ring_of_svg("<polygon points='1,2 3,4-5,6'/>"), {{1, 2}, {3, 4}, {-5, 6}});
  const ShapeFile open = shape_of_svg("<polyline points='1 2 3 4 5 0'/>");
  expect_ring(open.rings[0], {{1, 2}, {3, 4}, {5, 0}});
  EXPECT_EQ(open.closed_lines, 1u);
  EXPECT_THAT(open.assumptions, ElementsAre("1 open outline is closed by a straight segment, as SVG fills it."));
  EXPECT_EQ(shape_of_svg("<polyline points='1 2 3 4 5 0 1 2'/>").closed_lines, 0u);
  EXPECT_THAT(fault_of_svg("<polygon points='1 2 3'/>"),
              HasSubstr("<polygon>: points: the number of coordinates, 3, is odd"));
}

TEST(SvgShapes, WhatHasNoAreaIsLeftOutAndSaid) {
  const ShapeFile shape = shape_of_svg(
      "<line x2='5'/><text>a</text><text>b</text><image width='9' height='9'/><rect width='1' height='1'/>");
  EXPECT_EQ(area_of(shape), 1);
  EXPECT_THAT(shape.assumptions,
              ElementsAre("1 <line> has no area and is left out.",
                          "2 elements <text> are left out; convert them to paths.", "1 <image> is left out."));
}

TEST(SvgShapes, LengthsHaveUnits) {
  const auto width = [](const std::string& length) {
    return ring_of_svg("<rect height='1' width='" + length + "'/>", "viewBox='0 0 200 100'")[1][0];
  };
  EXPECT_EQ(width("7"), 7);
  EXPECT_EQ(width("7px"), 7);
  EXPECT_EQ(width("1in"), 96);
  EXPECT_NEAR(width("2.54cm"), 96, 1e-13);
  EXPECT_NEAR(width("25.4mm"), 96, 1e-13);
  EXPECT_NEAR(width("101.6Q"), 96, 1e-13);
  EXPECT_NEAR(width("72pt"), 96, 1e-13);
  EXPECT_EQ(width("6pc"), 96);
  EXPECT_EQ(width("25%"), 50);
  EXPECT_THAT(fault_of_svg("<rect width='1em' height='1'/>"), HasSubstr("width: the unit of \"1em\" is not supported"));
  EXPECT_THAT(fault_of_svg("<rect width='1%' height='1'/>"), HasSubstr("a size that the file does not state"));
  EXPECT_THAT(fault_of_svg("<rect width='1 2' height='1'/>"), HasSubstr("more than one length"));
}

/// Of the diagonal divided by the square root of 2: sqrt((30^2 + 40^2) / 2).
TEST(SvgShapes, APercentageOfARadius) {
  const PlaneRing ring = ring_of_svg("<circle r='10%'/>", "viewBox='0 0 30 40'");
  EXPECT_NEAR(ring[0][0], std::sqrt(1250.0) / 10, 1e-14);
}

}  // namespace
}  // namespace medial_vk
