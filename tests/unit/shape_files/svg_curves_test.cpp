// Flattening: how far polygons are from the curves, measured.
#include "shape_files/svg/svg_curves.h"

#include <algorithm>
#include <limits>
#include <random>

#include "unit/shape_files/read_for_tests.h"

namespace medial_vk {
namespace {

double distance_to_segment(const PlanePoint& p, const PlanePoint& a, const PlanePoint& b) {
  const double x = b[0] - a[0], y = b[1] - a[1], square = x * x + y * y;
  const double along = square > 0 ? ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / square : 0;
  const double t = std::clamp(along, 0.0, 1.0);
  return std::hypot(a[0] + t * x - p[0], a[1] + t * y - p[1]);
}

/// By the sum over Bernstein polynomials, or of the arc.
PlanePoint exact_point(const PlaneCurve& curve, const PlanePoint& start, double t) {
  PlanePoint p;
  const double s = 1 - t, angle = curve.begin + t * curve.sweep;
  for (std::size_t k = 0; k < 2; ++k) {
    if (curve.kind == CurveKind::kQuadratic) {
      p[k] = s * s * start[k] + 2 * s * t * curve.first[k] + t * t * curve.end[k];
    } else if (curve.kind == CurveKind::kCubic) {
      p[k] = s * s * s * start[k] + 3 * s * s * t * curve.first[k] + 3 * s * t * t * curve.second[k] +
             t * t * t * curve.end[k];
    } else {
      p[k] = curve.centre[k] + curve.first[k] * std::cos(angle) + curve.second[k] * std::sin(angle);
    }
  }
  return p;
}

/// The greatest distance of points of the curve from the chord of their part.
double greatest_error(const Outline& outline, double flatness) {
  const PlaneCurve& curve = outline.curves.front();
  PlaneRing ring = flatten(outline, flatness);
  if (ring.back() != curve.end) ring.push_back(curve.end);
  const std::size_t parts = ring.size() - 1;
  EXPECT_EQ(static_cast<double>(parts), parts_of(curve, outline.start, flatness));
  double greatest = 0;
  constexpr std::size_t kSamples = 64;
  for (std::size_t i = 0; i < parts; ++i) {
    for (std::size_t j = 0; j <= kSamples; ++j) {
      const double t = (static_cast<double>(i) + static_cast<double>(j) / kSamples) / static_cast<double>(parts);
      greatest = std::max(greatest, distance_to_segment(exact_point(curve, outline.start, t), ring[i], ring[i + 1]));
    }
  }
  return greatest;
}

class RandomCurves {
 public:
  PlanePoint point() { return {range_(random_), range_(random_)}; }
  double number() { return range_(random_); }

 private:
  std::mt19937 random_{33};
  std::uniform_real_distribution<double> range_{-1, 1};
};

TEST(SvgFlattening, NoCurveIsFartherThanTheFlatness) {
  RandomCurves random;
  for (int i = 0; i < 600; ++i) {
    const double flatness = std::pow(10, -1 - i % 4);
    Outline outline;
    outline.start = random.point();
    PlaneCurve curve;
    curve.kind = i % 3 == 0 ? CurveKind::kQuadratic : i % 3 == 1 ? CurveKind::kCubic : CurveKind::kArc;
    curve.first = random.point();
    curve.second = random.point();
    curve.end = random.point();
    if (curve.kind == CurveKind::kArc) {
      curve.centre = random.point();
      curve.begin = 3 * random.number();
      curve.sweep = 6.28 * random.number();
      outline.start = exact_point(curve, {}, 0);
      curve.end = exact_point(curve, {}, 1);
    }
    outline.curves.push_back(curve);
    EXPECT_LE(greatest_error(outline, flatness), flatness + 1e-15) << i;
  }
}

/// The bounds are attained: by a parabola, where its axis is across a chord, and by a circle.
TEST(SvgFlattening, TheBoundsAreSharp) {
  Outline parabola;
  PlaneCurve curve;
  curve.kind = CurveKind::kQuadratic;
  curve.first = {1, 1};
  curve.end = {2, 0};
  parabola.curves.push_back(curve);
  // The second difference is 2: with 9 parts the error is 2 / (4 * 81), across the chord in the middle one.
  EXPECT_NEAR(greatest_error(parabola, 2.0 / 324 * (1 + 1e-12)), 2.0 / 324, 1e-12);
  const Outline circle = ellipse_outline({}, {0, 0}, 1, 1);
  const double sagitta = 1 - std::cos(std::acos(-1.0) / 60);
  EXPECT_EQ(parts_of(circle.curves[0], circle.start, sagitta * (1 + 1e-9)), 60);
  EXPECT_NEAR(greatest_error(circle, sagitta * (1 + 1e-9)), sagitta, 1e-12);
}

/// Errors are those after the transformation: a circle that is stretched has the flatness where it is long.
TEST(SvgFlattening, IsMeasuredAfterTransformations) {
  for (const SvgMatrix& matrix : {SvgMatrix{100, 0, 0, 1, 0, 0}, SvgMatrix{3, 4, -40, 30, 7, 8},
                                  SvgMatrix{1, 0, 50, 1, 0, 0}, SvgMatrix{-2, 0, 0, 0.5, 0, 0}}) {
    const Outline ellipse = ellipse_outline(matrix, {0.5, 0.25}, 2, 3);
    const double error = greatest_error(ellipse, 0.05);
    EXPECT_LE(error, 0.05);
    EXPECT_GE(error, 0.005) << "far more parts than are necessary";
  }
}

TEST(SvgFlattening, ASmallEllipseKeepsAnInside) {
  EXPECT_EQ(flatten(ellipse_outline({}, {0, 0}, 1, 1), 100).size(), 4u);
}

TEST(SvgFlattening, TheBoxOfAnArcIsThatOfItsPoints) {
  RandomCurves random;
  for (int i = 0; i < 200; ++i) {
    Outline outline;
    PlaneCurve arc;
    arc.kind = CurveKind::kArc;
    arc.centre = random.point();
    arc.first = random.point();
    arc.second = random.point();
    arc.begin = 3 * random.number();
    arc.sweep = 6.28 * random.number();
    if (std::fabs(arc.sweep) < 0.01) continue;  // the box is that of the chord, enlarged
    outline.start = exact_point(arc, {}, 0);
    arc.end = exact_point(arc, {}, 1);
    outline.curves.push_back(arc);
    CurveBox box, samples;
    box.add(outline);
    constexpr int kSamples = 20'000;
    for (int j = 0; j <= kSamples; ++j) samples.add(exact_point(arc, {}, static_cast<double>(j) / kSamples));
    for (std::size_t k = 0; k < 2; ++k) {
      // Between samples a coordinate is beyond them by |p''| h^2 / 8 at most: 1.5 (6.28 / 20,000)^2 / 8.
      EXPECT_NEAR(box.lower[k], samples.lower[k], 2e-8) << i;
      EXPECT_NEAR(box.upper[k], samples.upper[k], 2e-8) << i;
    }
  }
}

TEST(SvgFlattening, TheDefaultIsAShareOfTheLongestSide) {
  const ShapeFile shape = shape_tests::shape_of_svg("<circle r='50'/>");
  EXPECT_NEAR(shape.flatness, 100 * kDefaultFlatness, 1e-12);
  EXPECT_EQ(shape.curves, 1u);
  EXPECT_THAT(shape.assumptions, testing::ElementsAre("1 curve is a polygon within 0.01, in units of the file."));
  const std::size_t sides = shape.rings[0].size();
  ShapeFileOptions options;
  options.flatness = 1e-4;
  const ShapeFile fine = shape_tests::shape_of(shape_tests::svg_of("<circle r='50'/>"), "s.svg", options);
  EXPECT_NEAR(static_cast<double>(fine.rings[0].size()), 10 * static_cast<double>(sides), 10);
}

TEST(SvgFlattening, ARefusedFlatness) {
  const std::string circle = shape_tests::svg_of("\n<circle r='50'/>");
  for (const double flatness : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    ShapeFileOptions options;
    options.flatness = flatness;
    const Result<ShapeFile> shape = parse_shape_file(circle, "s.svg", options);
    ASSERT_FALSE(shape.ok());
    EXPECT_EQ(shape.error().code, ErrorCode::kUsage);
  }
  ShapeFileOptions options;
  options.flatness = 1e-14;
  EXPECT_EQ(shape_tests::fault_of(circle, "s.svg", options),
            "s.svg:2: <circle>: flattened to 1e-14, the file has more than 16777216 points");
}

}  // namespace
}  // namespace medial_vk
