#include "bvh/triangle_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

// Without a type of 113 bits there is nothing to compare with.
#ifdef __SIZEOF_FLOAT128__
namespace medial_vk {
namespace {

__extension__ using Quad = __float128;

struct QuadPoint {
  Quad x, y, z;

  QuadPoint operator+(const QuadPoint& b) const { return {x + b.x, y + b.y, z + b.z}; }
  QuadPoint operator-(const QuadPoint& b) const { return {x - b.x, y - b.y, z - b.z}; }
};

QuadPoint quad(const Point& p) { return {p[0], p[1], p[2]}; }
QuadPoint times(Quad t, const QuadPoint& p) { return {t * p.x, t * p.y, t * p.z}; }
Quad product(const QuadPoint& a, const QuadPoint& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

QuadPoint across(const QuadPoint& a, const QuadPoint& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Quad squared_to_segment(const QuadPoint& start, const QuadPoint& edge) {
  const Quad whole = product(edge, edge);
  Quad t = whole > 0 ? -product(start, edge) / whole : Quad{0};
  t = t < 0 ? Quad{0} : t > 1 ? Quad{1} : t;
  const QuadPoint offset = start + times(t, edge);
  return product(offset, offset);
}

double exact_distance(const Point& p, const std::array<Point, 3>& corners) {
  const QuadPoint a = quad(corners[0]) - quad(p), b = quad(corners[1]) - quad(p), c = quad(corners[2]) - quad(p);
  const QuadPoint ab = b - a, ac = c - a, normal = across(ab, ac);
  Quad squared = squared_to_segment(a, ab);
  for (const Quad other : {squared_to_segment(a, ac), squared_to_segment(b, c - b)}) {
    squared = other < squared ? other : squared;
  }
  const Quad area = product(normal, normal);
  if (area > 0) {
    const Quad v = -product(across(a, ac), normal) / area, w = -product(across(ab, a), normal) / area;
    const Quad height = product(a, normal);
    if (v >= 0 && w >= 0 && v + w <= 1 && height * height / area < squared) squared = height * height / area;
  }
  return std::sqrt(static_cast<double>(squared));
}

/// A triangle whose width is between 1 and 2^-53 of its length, and a point above it; one in four is among the
/// thinnest.
struct Sliver {
  std::array<Point, 3> corners;
  Point p;

  explicit Sliver(std::mt19937_64& random) {
    std::uniform_real_distribution<double> share(0, 1), coordinate(-1, 1);
    const auto vector = [&] { return Point{coordinate(random), coordinate(random), coordinate(random)}; };
    const auto tiny = [&](double digits) { return std::pow(10.0, -digits * share(random)); };
    const bool is_thinnest = share(random) < 0.25;
    const Point along = tiny(3) * vector();
    corners[0] = vector();
    corners[1] = corners[0] + along;
    corners[2] = corners[0] + (tiny(6) * (0.3 + share(random))) * along +
                 (length(along) * (is_thinnest ? 1e-13 * tiny(3) : tiny(14))) * vector();
    std::ranges::shuffle(corners, random);
    const Point ab = corners[1] - corners[0], ac = corners[2] - corners[0], normal = cross(ab, ac);
    const double v = share(random), w = share(random) * (1 - v), size = length(normal);
    p = corners[0] + v * ab + w * ac;
    if (size > 0) p = p + ((is_thinnest ? 1e-12 * tiny(4) : tiny(10)) / size) * normal;
  }
};

/// In units of 2^-53 times the lengths in question.
double error_of(const Point& p, const std::array<Point, 3>& corners) {
  const double computed = std::sqrt(nearest_on_triangle(p, corners).squared_distance);
  const Point &a = corners[0], &b = corners[1], &c = corners[2];
  const double unit = 0x1p-53 * (length(b - a) + length(c - a) + length(a - p));
  return (computed - exact_distance(p, corners)) / unit;
}

// The bound below is that of the docstring of nearest_on_triangle(): offset, edges and their weighted sum take fewer
// than eight roundings of these lengths. The bound above adds 1/2, and 2^5 twice: for sqrt(u c), and where the height
// has no correct digit.
constexpr double kMostBelow = 8, kMostAbove = 72;

TEST(TriangleDistance, IsThatOfTheTriangleForSliversToo) {
  std::mt19937_64 random(20261127);
  for (int i = 0; i < 200'000; ++i) {
    const Sliver sliver(random);
    const double error = error_of(sliver.p, sliver.corners);
    ASSERT_GE(error, -kMostBelow) << "sliver " << i;
    ASSERT_LE(error, kMostAbove) << "sliver " << i;
  }
}

/// Where the weights of the first pass are in the thousands, and the second pass would find the foot outside.
TEST(TriangleDistance, DoesNotTakeAFootForOutsideTooSoon) {
  const std::array<Point, 3> corners = {{{0.00025587970188831817, 0.00072874494100885626, 8.2238853720313635e-05},
                                         {0.61812787922740964, 0.61359121027077013, 0.61802373864170057},
                                         {1.002608678632845, 0.99495474636992942, 1.0025477857047445}}};
  const Point p = {0.70056246443345516, 0.69535743880463374, 0.70046759635955558};
  EXPECT_LE(error_of(p, corners), kMostAbove);
}

}  // namespace
}  // namespace medial_vk
#endif
