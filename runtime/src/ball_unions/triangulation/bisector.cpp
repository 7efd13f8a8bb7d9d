#include "ball_unions/triangulation/bisector.h"

#include <cfloat>
#include <cmath>
#include <functional>

#include "base/point_ops.h"

namespace medial_vk {

bool are_apart(const Ball& a, const Ball& b) {
  const double both = a.radius + b.radius;
  const Point between = b.centre - a.centre;
  return dot(between, between) > both * both * (1 + 16 * DBL_EPSILON);
}

Bisector bisector(std::span<const Ball> balls, std::uint32_t i, std::uint32_t j) {
  const Ball& a = balls[i];
  const Ball& b = balls[j];
  const Point between = b.centre - a.centre;  // each coordinate rounded once
  const double distance = length(between);
  const auto name = static_cast<std::int32_t>(j);
  if (distance == 0) return {.normal = {}, .ball = name};
  const double scale = 1 / distance;
  const double radii = (a.radius - b.radius) * (a.radius + b.radius) * scale;
  // distance: six roundings of its square, halved by the root, and its own; radii: three, with scale's; the sum: one.
  const double slack = 4 * DBL_EPSILON * (distance + std::fabs(radii));
  return {.normal = scale * between,
          .offset = 0.5 * (distance + radii),
          .slack = slack,
          .ball = name,
          .is_apart = are_apart(a, b)};
}

// With unit normals, |p x q| <= 1, so every product in the numerator is at most |offset|, and the determinant carries
// an error of at most 32 roundings (6 products of 3 factors with 4 roundings each, the factors' own 4 among them); the
// point then moves by numerator and denominator.
std::pair<Point, double> meeting_point(const Bisector& p, const Bisector& q, const Bisector& s) {
  const Point qs = cross(q.normal, s.normal);
  const double determinant = dot(p.normal, qs);
  if (std::fabs(determinant) < 64 * DBL_EPSILON) return {{}, HUGE_VAL};
  const Point sum = p.offset * qs + q.offset * cross(s.normal, p.normal) + s.offset * cross(p.normal, q.normal);
  const double scale = 1 / determinant;
  const Point at = scale * sum;
  const double offsets = std::fabs(p.offset) + std::fabs(q.offset) + std::fabs(s.offset);
  const double error = 32 * DBL_EPSILON * (offsets + length(at)) + p.slack + q.slack + s.slack;
  return {at, 2 * std::fabs(scale) * error};
}

namespace {

/// The determinant of three normals, for both kinds of numbers.
template <class Row, class Difference, class Sum, class Product>
auto determinant(const Row& a, const Row& b, const Row& c, const Difference& difference, const Sum& sum,
                 const Product& product) {
  const auto minor = [&](int u, int v) {
    return difference(product(b.normal[u], c.normal[v]), product(b.normal[v], c.normal[u]));
  };
  return sum(sum(product(a.normal[0], minor(1, 2)), product(a.normal[1], minor(2, 0))),
             product(a.normal[2], minor(0, 1)));
}

/// Cramer's rule: the point is (x, y, z) / determinant.
template <class Number>
struct Quotient {
  Number x[3], determinant;
};

template <class Row, class Difference, class Sum, class Product>
auto meeting_point(const Row& a, const Row& b, const Row& c, const Difference& difference, const Sum& sum,
                   const Product& product) {
  Quotient<decltype(product(a.offset, a.offset))> point;
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    const auto part = [&](const Row& p, const Row& q, const Row& s) {
      return product(p.offset, difference(product(q.normal[u], s.normal[v]), product(q.normal[v], s.normal[u])));
    };
    point.x[k] = sum(sum(part(a, b, c), part(b, c, a)), part(c, a, b));
  }
  point.determinant = determinant(a, b, c, difference, sum, product);
  return point;
}

}  // namespace

ExactSide::Row<DoubleDouble> ExactSide::rounded_row(std::uint32_t i, std::int32_t plane) const {
  Row<DoubleDouble> row;
  if (plane < 0) {
    const Wall& wall = walls_[static_cast<std::size_t>(-1 - plane)];
    for (int k = 0; k < 3; ++k) row.normal[k] = DoubleDouble(wall.normal[k]);
    row.offset = DoubleDouble(wall.offset);
    return row;
  }
  const Ball& a = balls_[i];
  const Ball& b = balls_[static_cast<std::size_t>(plane)];
  const DoubleDouble ra(a.radius), rb(b.radius);
  row.offset = DoubleDouble::difference(a.radius, b.radius) * (ra + rb);  // exact for equal balls
  for (int k = 0; k < 3; ++k) {
    const DoubleDouble between = DoubleDouble::difference(b.centre[k], a.centre[k]);
    row.normal[k] = between + between;
    row.offset = row.offset + between * between;
  }
  return row;
}

ExactSide::Row<Expansion> ExactSide::exact_row(std::uint32_t i, std::int32_t plane) {
  Row<Expansion> row;
  if (plane < 0) {
    const Wall& wall = walls_[static_cast<std::size_t>(-1 - plane)];
    for (int k = 0; k < 3; ++k) row.normal[k] = math_.number(wall.normal[k]);
    row.offset = math_.number(wall.offset);
    return row;
  }
  const Ball& a = balls_[i];
  const Ball& b = balls_[static_cast<std::size_t>(plane)];
  row.offset = math_.difference(math_.square(a.radius), math_.square(b.radius));
  for (int k = 0; k < 3; ++k) {
    const Expansion between = math_.difference(b.centre[k], a.centre[k]);
    row.normal[k] = math_.sum(between, between);
    row.offset = math_.sum(row.offset, math_.product(between, between));
  }
  return row;
}

// With the determinants of three normals as cofactors of the offsets, the determinant of the four rows (normal, offset)
// is det(p, q, s) (offset_m - normal_m . x), where x is the point.
bool ExactSide::keeps(std::uint32_t i, std::int32_t p, std::int32_t q, std::int32_t s, std::int32_t m) {
  const std::array<std::int32_t, 4> names = {p, q, s, m};
  std::array<Row<DoubleDouble>, 4> r;
  for (std::size_t k = 0; k < 4; ++k) r[k] = rounded_row(i, names[k]);
  const auto det = [&](int a, int b, int c) {
    return determinant(r[a], r[b], r[c], std::minus<>{}, std::plus<>{}, std::multiplies<>{});
  };
  const std::array<DoubleDouble, 4> cofactors = {-det(1, 2, 3), det(0, 2, 3), -det(0, 1, 3), det(0, 1, 2)};
  const DoubleDouble sum = (cofactors[0] * r[0].offset + cofactors[1] * r[1].offset) +
                           (cofactors[2] * r[2].offset + cofactors[3] * r[3].offset);
  const auto side = sum.certain_sign(), orientation = cofactors[3].certain_sign();
  if (!side || !orientation) return keeps_by_expansions(i, names);
  if (*side != 0) return *side == *orientation;
  DoubleDouble of_own;
  Signs signs{};
  bool is_certain = true;
  for (std::size_t k = 0; k < 4; ++k) {
    if (names[k] >= 0) of_own = of_own + cofactors[k];
    const auto sign = cofactors[k].certain_sign();
    is_certain = is_certain && sign;
    signs.cofactors[k] = sign.value_or(0);
  }
  const auto sign_of_own = of_own.certain_sign();
  if (!is_certain || !sign_of_own) return keeps_by_expansions(i, names);
  signs.of_own = *sign_of_own;
  return keeps_tied(i, names, signs);
}

bool ExactSide::keeps_by_expansions(std::uint32_t i, const std::array<std::int32_t, 4>& names) {
  arena_.reset();
  std::array<Row<Expansion>, 4> r;
  for (std::size_t k = 0; k < 4; ++k) r[k] = exact_row(i, names[k]);
  const auto difference = [&](Expansion a, Expansion b) { return math_.difference(a, b); };
  const auto plus = [&](Expansion a, Expansion b) { return math_.sum(a, b); };
  const auto times = [&](Expansion a, Expansion b) { return math_.product(a, b); };
  const auto det = [&](int a, int b, int c) { return determinant(r[a], r[b], r[c], difference, plus, times); };
  const Expansion zero;
  const std::array<Expansion, 4> cofactors = {difference(zero, det(1, 2, 3)), det(0, 2, 3),
                                              difference(zero, det(0, 1, 3)), det(0, 1, 2)};
  Expansion sum, of_own;
  for (std::size_t k = 0; k < 4; ++k) sum = plus(sum, times(cofactors[k], r[k].offset));
  if (!sum.empty()) return sign(sum) == sign(cofactors[3]);
  Signs signs{};
  for (std::size_t k = 0; k < 4; ++k) {
    if (names[k] >= 0) of_own = plus(of_own, cofactors[k]);
    signs.cofactors[k] = sign(cofactors[k]);
  }
  signs.of_own = sign(of_own);
  return keeps_tied(i, names, signs);
}

/// A larger r_k^2 lowers the offset of plane k, a larger r_i^2 raises all that are between balls. The ball named first
/// decides, unless its cofactor vanishes.
bool ExactSide::keeps_tied(std::uint32_t i, const std::array<std::int32_t, 4>& names, const Signs& signs) {
  struct Decision {
    std::int32_t ball = INT32_MAX;
    int sign = 0;
  };
  Decision decision;
  const auto consider = [&](std::int32_t ball, int sign_of_term) {
    if (sign_of_term != 0 && ball < decision.ball) decision = {ball, sign_of_term};
  };
  consider(static_cast<std::int32_t>(i), signs.of_own);
  for (std::size_t k = 0; k < 4; ++k) {
    if (names[k] >= 0) consider(names[k], -signs.cofactors[k]);
  }
  // Without a decision m is a wall: walls are perturbed outwards symbolically.
  return decision.sign == 0 || decision.sign == signs.cofactors[3];
}

int ExactSide::orientation(std::uint32_t i, std::uint32_t p, std::uint32_t q, std::uint32_t s) {
  const auto name = [](std::uint32_t ball) { return static_cast<std::int32_t>(ball); };
  const auto rounded = determinant(rounded_row(i, name(p)), rounded_row(i, name(q)), rounded_row(i, name(s)),
                                   std::minus<>{}, std::plus<>{}, std::multiplies<>{});
  if (const auto sign = rounded.certain_sign()) return *sign;
  arena_.reset();
  return sign(determinant(
      exact_row(i, name(p)), exact_row(i, name(q)), exact_row(i, name(s)),
      [&](Expansion a, Expansion b) { return math_.difference(a, b); },
      [&](Expansion a, Expansion b) { return math_.sum(a, b); },
      [&](Expansion a, Expansion b) { return math_.product(a, b); }));
}

std::pair<Point, double> ExactSide::meet(std::uint32_t i, std::int32_t p, std::int32_t q, std::int32_t s) {
  const auto point = meeting_point(rounded_row(i, p), rounded_row(i, q), rounded_row(i, s), std::minus<>{},
                                   std::plus<>{}, std::multiplies<>{});
  const double size = std::fabs(point.determinant.value()), error = point.determinant.error();
  Point at;
  double slack = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    at[k] = point.x[k].value() / point.determinant.value();
    slack += (point.x[k].error() + std::fabs(at[k]) * error) / size;
  }
  // Twice, as the determinant may be smaller than its rounded value and for the roundings here.
  if (error < 0.25 * size && 2 * slack <= 0x1p-46 * balls_[i].radius) return {at, 2 * slack};
  return meet_by_expansions(i, {p, q, s});
}

std::pair<Point, double> ExactSide::meet_by_expansions(std::uint32_t i, const std::array<std::int32_t, 3>& names) {
  arena_.reset();
  const auto point = meeting_point(
      exact_row(i, names[0]), exact_row(i, names[1]), exact_row(i, names[2]),
      [&](Expansion a, Expansion b) { return math_.difference(a, b); },
      [&](Expansion a, Expansion b) { return math_.sum(a, b); },
      [&](Expansion a, Expansion b) { return math_.product(a, b); });
  Point at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = value(point.x[k]) / value(point.determinant);
  return {at, 8 * DBL_EPSILON * length(at)};
}

}  // namespace medial_vk
