// Documents of SVG: transformations, viewports, references, styles, and hostile files.
#include "shape_files/svg/svg_matrix.h"
#include "shape_files/svg/svg_scanner.h"
#include "unit/shape_files/read_for_tests.h"

namespace medial_vk {
namespace {

using shape_tests::area_of;
using shape_tests::expect_ring;
using shape_tests::fault_of;
using shape_tests::fault_of_svg;
using shape_tests::ring_of_svg;
using shape_tests::shape_of;
using shape_tests::shape_of_svg;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kUnit = "<rect width='1' height='1'/>";

/// The images of (1, 0), (0, 1) and (0, 0), by hand.
void expect_transform(const std::string& text, const PlanePoint& x, const PlanePoint& y, const PlanePoint& origin) {
  const SvgMatrix m = parse_svg_transform(text);
  expect_ring({m * PlanePoint{1, 0}, m * PlanePoint{0, 1}, m * PlanePoint{0, 0}}, {x, y, origin}, 1e-14);
}

TEST(SvgTransforms, EachKind) {
  expect_transform("matrix(1 2 3 4 5 6)", {6, 8}, {8, 10}, {5, 6});
  expect_transform("translate(3)", {4, 0}, {3, 1}, {3, 0});
  expect_transform("translate(3,-4)", {4, -4}, {3, -3}, {3, -4});
  expect_transform("scale(2)", {2, 0}, {0, 2}, {0, 0});
  expect_transform("scale(2,-3)", {2, 0}, {0, -3}, {0, 0});
  expect_transform("rotate(90)", {0, 1}, {-1, 0}, {0, 0});
  expect_transform("rotate(-90 1 0)", {1, 0}, {2, 1}, {1, 1});
  expect_transform("rotate(30)", {std::sqrt(0.75), 0.5}, {-0.5, std::sqrt(0.75)}, {0, 0});
  expect_transform("skewX(45)", {1, 0}, {1, 1}, {0, 0});
  expect_transform("skewY(45)", {1, 1}, {0, 1}, {0, 0});
  expect_transform("none", {1, 0}, {0, 1}, {0, 0});
}

TEST(SvgTransforms, OfStylesHaveUnits) {
  expect_transform("translate(3px, 4px)", {4, 4}, {3, 5}, {3, 4});
  expect_transform("rotate(0.25turn)", {0, 1}, {-1, 0}, {0, 0});
  expect_transform("rotate(100grad)", {0, 1}, {-1, 0}, {0, 0});
  expect_transform("translateX(2) scaleY(3)", {3, 0}, {2, 3}, {2, 0});
  expect_ring(ring_of_svg("<rect style='transform: translate(3px,4px)' width='1' height='1'/>"),
              {{3, 4}, {4, 4}, {4, 5}, {3, 5}});
}

/// The last one is applied first; elements around come after those within.
TEST(SvgTransforms, AreComposed) {
  expect_transform("translate(10,0) scale(2), rotate(90)", {10, 2}, {8, 0}, {10, 0});
  expect_ring(ring_of_svg("<g transform='translate(5 0)'><g transform='scale(2)'>"
                          "<rect transform='translate(1,1)' width='1' height='1'/></g></g>"),
              {{7, 2}, {9, 2}, {9, 4}, {7, 4}});
}

TEST(SvgTransforms, MistakesAreNamed) {
  for (const char* text : {"turn(4)", "rotate(1 2)", "matrix(1 2 3)", "scale", "scale(1", "scale(1 2 3 4 5 6 7)",
                           "scale(a)", "rotate(1furlong)", "(3)"}) {
    EXPECT_THROW(parse_svg_transform(text), SvgFault) << text;
  }
  EXPECT_EQ(fault_of_svg("<g transform='turn(4)'>" + kUnit + "</g>"),
            "s.svg:1: <g>: transform: there is no transform \"turn\" of 1 numbers");
}

TEST(SvgTransforms, AScaleOfZeroLeavesNothing) {
  const ShapeFile shape = shape_of_svg("<g transform='scale(0)'>" + kUnit + "</g>" + kUnit);
  EXPECT_EQ(area_of(shape), 1);
  EXPECT_THAT(shape.assumptions, ElementsAre("1 area encloses nothing and is left out."));
}

TEST(SvgViewports, CoordinatesAreThoseOfTheFile) {
  const ShapeFile shape = shape_of_svg("<rect x='-50' y='-50' width='10' height='20'/>",
                                       "width='210mm' height='210mm' viewBox='-50 -50 100 100'");
  expect_ring(shape.rings[0], {{-50, -50}, {-40, -50}, {-40, -30}, {-50, -30}});
  EXPECT_TRUE(shape.y_is_down);
  ASSERT_TRUE(shape.view_box);
  EXPECT_THAT(*shape.view_box, ElementsAre(-50, -50, 100, 100));
  EXPECT_THAT(shape.assumptions, IsEmpty());
  EXPECT_THAT(*shape_of_svg(kUnit, "width='30' height='1in'").view_box, ElementsAre(0, 0, 30, 96));
  EXPECT_FALSE(shape_of_svg(kUnit, "width='100%' height='9'").view_box);
  EXPECT_FALSE(shape_of_svg(kUnit).view_box);
}

TEST(SvgViewports, AStretchedFileIsSaid) {
  const std::string stretched = "width='200' height='50' viewBox='0 0 100 100'";
  EXPECT_THAT(shape_of_svg(kUnit, stretched).assumptions, IsEmpty());
  EXPECT_THAT(shape_of_svg(kUnit, stretched + " preserveAspectRatio='none'").assumptions,
              ElementsAre("The file is shown 4 times as wide for its height as its coordinates are, which count."));
}

/// A box of 10 by 10 in a viewport of 40 by 20 at (100, 200), by hand.
TEST(SvgViewports, NestedOnesAreFitted) {
  const auto ring = [](const std::string& ratio) {
    return ring_of_svg("<svg x='100' y='200' width='40' height='20' viewBox='5 5 10 10' " + ratio +
                       "><rect x='5' y='5' width='10' height='10'/></svg>");
  };
  const auto box = [](double x, double y, double width, double height) {
    return PlaneRing{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  };
  expect_ring(ring(""), box(110, 200, 20, 20));
  expect_ring(ring("preserveAspectRatio='xMinYMid'"), box(100, 200, 20, 20));
  expect_ring(ring("preserveAspectRatio='xMaxYMax meet'"), box(120, 200, 20, 20));
  expect_ring(ring("preserveAspectRatio='xMidYMin slice'"), box(100, 200, 40, 40));
  expect_ring(ring("preserveAspectRatio='xMidYMid slice'"), box(100, 190, 40, 40));
  expect_ring(ring("preserveAspectRatio='xMidYMax slice'"), box(100, 180, 40, 40));
  expect_ring(ring("preserveAspectRatio='none'"), box(100, 200, 40, 20));
}

TEST(SvgViewports, NestedPercentages) {
  expect_ring(ring_of_svg("<svg x='10%' width='50%' height='50%'><rect width='50%' height='100%'/></svg>",
                          "viewBox='0 0 100 40'"),
              {{10, 0}, {35, 0}, {35, 20}, {10, 20}});
  EXPECT_THAT(fault_of_svg("<svg width='0' height='9'>" + kUnit + "</svg>"), HasSubstr("no element"));
  EXPECT_THAT(fault_of_svg("<svg width='-1' height='9'>" + kUnit + "</svg>"), HasSubstr("<svg>: width or height"));
  EXPECT_THAT(fault_of_svg(kUnit, "viewBox='0 0 9'"), HasSubstr("viewBox: there are 3 numbers instead of 4"));
  EXPECT_THAT(fault_of_svg(kUnit, "viewBox='0 0 9 -9'"), HasSubstr("viewBox: its size is negative"));
  EXPECT_THAT(fault_of_svg("<svg width='9' height='9' viewBox='0 0 1 1' preserveAspectRatio='middle'/>"),
              HasSubstr("preserveAspectRatio: \"middle\" is unknown"));
}

TEST(SvgUse, ElementsAndGroups) {
  expect_ring(ring_of_svg("<defs><rect id='r' width='1' height='1'/></defs><use href='#r' x='3' y='4'/>"),
              {{3, 4}, {4, 4}, {4, 5}, {3, 5}});
  expect_ring(ring_of_svg("<defs><g id='g' transform='scale(2)'>" + kUnit +
                          "</g></defs><use xlink:href='#g' x='3' transform='translate(0 1)'/>"),
              {{3, 1}, {5, 1}, {5, 3}, {3, 3}});
  EXPECT_EQ(area_of(shape_of_svg("<rect id='r' width='1' height='1'/><use href='#r' x='3'/><use href='#r' x='6'/>")),
            3);
}

TEST(SvgUse, Symbols) {
  const std::string symbol = "<symbol id='s' viewBox='0 0 10 10'><rect width='10' height='10'/></symbol>";
  expect_ring(ring_of_svg(symbol + "<use href='#s' x='5' y='5' width='4' height='2'/>"),
              {{6, 5}, {8, 5}, {8, 7}, {6, 7}});
  expect_ring(ring_of_svg(symbol + "<use href='#s'/>", "viewBox='0 0 20 20'"), {{0, 0}, {20, 0}, {20, 20}, {0, 20}});
  EXPECT_THAT(fault_of_svg(symbol), HasSubstr("no element"));
}

TEST(SvgUse, BrokenLinksAreLeftOutAndSaid) {
  const ShapeFile shape = shape_of_svg("<use href='#nothing'/><use href='other.svg#x'/>" + kUnit);
  EXPECT_THAT(shape.assumptions, ElementsAre("2 elements <use> refer to no element of the file and are left out."));
}

TEST(SvgUse, CirclesAreErrors) {
  EXPECT_EQ(fault_of_svg("<g id='a'>\n<use href='#a'/></g>"), "s.svg:2: <use>: it refers to itself");
  EXPECT_THAT(fault_of_svg("<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>"), HasSubstr("to itself"));
}

/// Each group shows the one before it ten times.
std::string billion(int levels) {
  std::string text = "<g id='g0'>" + kUnit + "</g>";
  for (int i = 1; i <= levels; ++i) {
    text += "<g id='g" + std::to_string(i) + "'>";
    for (int k = 0; k < 10; ++k) text += "<use href='#g" + std::to_string(i - 1) + "'/>";
    text += "</g>";
  }
  return text;
}

TEST(SvgUse, ABillionInstancesAreAnError) {
  EXPECT_THAT(fault_of_svg(billion(9)), HasSubstr("the elements <use> of the file show too many elements"));
  EXPECT_EQ(area_of(shape_of_svg("<defs>" + billion(2) + "</defs><use href='#g2'/>")), 1);
}

TEST(SvgUse, DepthIsLimited) {
  const auto chain = [](int length) {
    std::string text = "<defs><g id='g0'>" + kUnit + "</g>";
    for (int i = 1; i <= length; ++i) {
      text += "<g id='g" + std::to_string(i) + "'><use href='#g" + std::to_string(i - 1) + "'/></g>";
    }
    return text + "</defs><use href='#g" + std::to_string(length) + "'/>";
  };
  EXPECT_EQ(area_of(shape_of_svg(chain(31))), 1);
  EXPECT_THAT(fault_of_svg(chain(32)), HasSubstr("it is within more than 32 other elements <use>"));
  EXPECT_THAT(fault_of_svg(shape_tests::nested(200, "<g>", kUnit, "</g>")), HasSubstr("nested too deeply"));
}

/// 16 groups of 20 levels, each of which shows the next.
TEST(SvgUse, DepthIsLimitedAcrossReferences) {
  std::string text;
  for (int i = 0; i < 16; ++i) {
    const std::string inner = i == 15 ? kUnit : "<use href='#g" + std::to_string(i + 1) + "'/>";
    text += "<g id='g" + std::to_string(i) + "'>" + shape_tests::nested(20, "<g>", inner, "</g>") + "</g>";
  }
  EXPECT_THAT(fault_of_svg("<defs>" + text + "</defs><use href='#g0'/>"), HasSubstr("elements are nested too deeply"));
}

TEST(SvgStyles, WhatIsNotDisplayedIsLeftOut) {
  const ShapeFile shape = shape_of_svg(
      "<g display='none'><rect width='9' height='9'/></g><rect style='display:none' width='9' height='9'/>"
      "<g visibility='hidden'><rect width='9' height='9'/><rect visibility='visible' width='1' height='2'/></g>");
  EXPECT_EQ(area_of(shape), 2);
  EXPECT_THAT(shape.assumptions, ElementsAre("3 elements are not displayed and are left out."));
}

TEST(SvgStyles, WithoutAFillOutlinesCountOnlyWhereNothingHasOne) {
  const std::string outlines = "<g fill='none'><rect width='9' height='9'/></g>";
  const ShapeFile all = shape_of_svg(outlines);
  EXPECT_EQ(area_of(all), 81);
  EXPECT_THAT(all.assumptions, ElementsAre("No element has a fill; all count as if they had."));
  const ShapeFile some = shape_of_svg(outlines + "<rect style='fill : red' fill='none' width='1' height='2'/>");
  EXPECT_EQ(area_of(some), 2);
  EXPECT_THAT(some.assumptions, ElementsAre("1 element without a fill is left out."));
}

TEST(SvgStyles, FillRules) {
  const std::string path = "d='M0 0H4V4H0ZM1 1H3V3H1Z'";
  EXPECT_EQ(area_of(shape_of_svg("<path " + path + "/>")), 16);
  EXPECT_EQ(area_of(shape_of_svg("<path fill-rule='evenodd' " + path + "/>")), 12);
  EXPECT_EQ(area_of(shape_of_svg("<g style='fill-rule:evenodd!important'><path " + path + "/></g>")), 12);
  EXPECT_EQ(area_of(shape_of_svg("<g fill-rule='evenodd'><path fill-rule='nonzero' " + path + "/></g>")), 16);
  ShapeFileOptions options;
  options.fill_rule = FillRule::kEvenOdd;
  EXPECT_EQ(area_of(shape_of(shape_tests::svg_of("<path " + path + "/>"), "s.svg", options)), 12);
}

/// As painted: a hole of one element is filled by another one, and opposite directions do not cancel.
TEST(SvgStyles, ElementsAreUnited) {
  const std::string frame = "<path fill-rule='evenodd' d='M0 0H4V4H0ZM1 1H3V3H1Z'/>";
  const ShapeFile shape = shape_of_svg(frame + "<rect x='1' y='1' width='1' height='2'/>");
  EXPECT_EQ(shape.fill_rule, FillRule::kNonZero);
  EXPECT_EQ(shape.areas, 2u);
  EXPECT_EQ(area_of(shape), 14);
  EXPECT_EQ(area_of(shape_of_svg("<path d='M0 0H2V1H0Z'/><path d='M1 0V1H3V0Z'/>")), 3);
  const ShapeFile crossed = shape_of_svg("<path d='M0 0L2 2H0L2 0Z'/><rect x='9' width='1' height='1'/>");
  EXPECT_EQ(area_of(crossed), 3);
  EXPECT_THAT(crossed.assumptions, ElementsAre("1 crossing of an area with itself is cut.", "2 areas are united."));
}

TEST(SvgStyles, WhatIsNotAppliedIsSaid) {
  const ShapeFile shape =
      shape_of_svg("<style>rect { fill: none }</style><rect clip-path='url(#c)' width='1' height='1'/>");
  EXPECT_THAT(shape.assumptions,
              ElementsAre("1 element has a clip path, a mask or an origin of its transform, which is not applied.",
                          "The style sheet of the file is not applied."));
}

TEST(SvgDocuments, OfManyPrograms) {
  const std::string rect = "<rect width='1' height='2'/>";
  EXPECT_EQ(area_of(shape_of("<?xml version='1.0'?><!-- <!DOCTYPE [ --><svg>" + rect + "</svg>", "s.svg")), 2);
  EXPECT_EQ(area_of(shape_of("\xef\xbb\xbf<s:svg xmlns:s='http://www.w3.org/2000/svg'><s:rect width='1' height='2'/>"
                             "<other:rect width='9' height='9'/></s:svg>",
                             "s.svg")),
            2);
  EXPECT_EQ(area_of(shape_of("<?xml version='1.0'?>\n<!DOCTYPE svg PUBLIC '-//W3C//DTD SVG 1.1//EN' 'svg11.dtd' [\n"
                             "<!ENTITY ns 'http://[x]'>\n] >\n<svg xmlns='&ns;'>" +
                                 rect + "</svg>",
                             "s.svg")),
            2);
  EXPECT_EQ(area_of(shape_of_svg("<switch>" + rect + "<rect width='9' height='9'/></switch>")), 2);
  EXPECT_EQ(area_of(shape_of_svg("<a>" + rect + "</a><clipPath><rect width='9' height='9'/></clipPath>")), 2);
}

TEST(SvgDocuments, AreKnownByTheirContent) {
  EXPECT_EQ(shape_of("<svg><circle r='1'/></svg>", "a").format, ShapeFormat::kSvg);
  EXPECT_EQ(shape_of("\n <?xml version='1.0'?><svg><circle r='1'/></svg>", "a.txt").format, ShapeFormat::kSvg);
}

TEST(SvgDocuments, OthersAreRefused) {
  EXPECT_EQ(fault_of("<html/>", "s.svg"), "s.svg: this is no SVG: its outermost element is not <svg>");
  EXPECT_THAT(fault_of("<svg>\n<g></svg>", "s.svg"), HasSubstr("s.svg:2: this is no well-formed XML"));
  EXPECT_EQ(fault_of("", "s.svg"), "s.svg: file is empty");
  EXPECT_EQ(fault_of("\x1f\x8b", "s.svg"), "s.svg: the file is compressed by gzip; expand it first");
  EXPECT_EQ(fault_of("<svg/>", "s.svg"), "s.svg: no element of this SVG has an area");
  EXPECT_EQ(fault_of_svg("<path d='M0 0L1 1'/>"), "s.svg: no area of it encloses anything");
  std::string many = "<svg";
  for (int i = 0; i < 1001; ++i) many += " a" + std::to_string(i) + "=''";
  EXPECT_THAT(fault_of(many + "/>", "s.svg"), HasSubstr("more than 1000 attributes"));
}

/// An entity that is declared in terms of others does not grow.
TEST(SvgDocuments, EntitiesAreNotReplaced) {
  const std::string text =
      "<!DOCTYPE svg [<!ENTITY a 'aaaaaaaaaa'><!ENTITY b '&a;&a;&a;&a;'>]><svg><rect id='&b;' width='1' "
      "height='1'/></svg>";
  EXPECT_EQ(area_of(shape_of(text, "s.svg")), 1);
}

}  // namespace
}  // namespace medial_vk
