#include "shape_files/svg/svg_matrix.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/quoted.h"
#include "shape_files/svg/svg_scanner.h"

namespace medial_vk {
namespace {

constexpr double kRadians = std::numbers::pi / 180;

/// Exact for multiples of a quarter turn, which drawings have often.
SvgMatrix rotation(double degrees) {
  const double rest = std::fmod(degrees, 360);
  double cosine = std::cos(rest * kRadians), sine = std::sin(rest * kRadians);
  if (std::fmod(rest, 90) == 0) {
    cosine = std::round(cosine);
    sine = std::round(sine);
  }
  return {cosine, sine, -sine, cosine, 0, 0};
}

/// A number with a unit of CSS: angles in degrees, lengths in pixels.
double number_with_unit(SvgScanner& scanner) {
  const double value = scanner.number_before_unit();
  const std::string_view unit = scanner.letters();
  scanner.skip_blanks();
  scanner.accept(',');
  if (unit.empty() || unit == "px" || unit == "deg") return value;
  if (unit == "rad") return value / kRadians;
  if (unit == "grad") return value * 0.9;
  if (unit == "turn") return value * 360;
  throw SvgFault{fmt::format("the unit {} is unknown in a transform", quoted(unit))};
}

std::vector<double> arguments(SvgScanner& scanner) {
  std::vector<double> numbers;
  while (!scanner.at_end() && scanner.next() != ')') {
    if (numbers.size() == 6) throw SvgFault{"a transform has more than six numbers"};
    numbers.push_back(number_with_unit(scanner));
  }
  if (!scanner.accept(')')) throw SvgFault{"a transform lacks its closing bracket"};
  return numbers;
}

SvgMatrix rotation_about(const std::vector<double>& v) {
  if (v.size() == 1) return rotation(v[0]);
  return SvgMatrix{1, 0, 0, 1, v[1], v[2]} * rotation(v[0]) * SvgMatrix{1, 0, 0, 1, -v[1], -v[2]};
}

/// One function of a list, by its name. Throws SvgFault.
SvgMatrix function_of(std::string_view name, const std::vector<double>& v) {
  const std::size_t n = v.size();
  const auto slope = [](double degrees) { return std::tan(degrees * kRadians); };
  if (name == "matrix" && n == 6) return {v[0], v[1], v[2], v[3], v[4], v[5]};
  if (name == "translate" && (n == 1 || n == 2)) return {1, 0, 0, 1, v[0], n == 2 ? v[1] : 0};
  if (name == "translateX" && n == 1) return {1, 0, 0, 1, v[0], 0};
  if (name == "translateY" && n == 1) return {1, 0, 0, 1, 0, v[0]};
  if (name == "scale" && (n == 1 || n == 2)) return {v[0], 0, 0, n == 2 ? v[1] : v[0], 0, 0};
  if (name == "scaleX" && n == 1) return {v[0], 0, 0, 1, 0, 0};
  if (name == "scaleY" && n == 1) return {1, 0, 0, v[0], 0, 0};
  if (name == "rotate" && (n == 1 || n == 3)) return rotation_about(v);
  if (name == "skewX" && n == 1) return {1, 0, slope(v[0]), 1, 0, 0};
  if (name == "skewY" && n == 1) return {1, slope(v[0]), 0, 1, 0, 0};
  if (name == "skew" && (n == 1 || n == 2)) return {1, n == 2 ? slope(v[1]) : 0, slope(v[0]), 1, 0, 0};
  throw SvgFault{fmt::format("there is no transform {} of {} numbers", quoted(name), n)};
}

}  // namespace

SvgMatrix operator*(const SvgMatrix& outer, const SvgMatrix& inner) {
  const PlanePoint x = outer.turn({inner.a, inner.b}), y = outer.turn({inner.c, inner.d});
  const PlanePoint shift = outer * PlanePoint{inner.e, inner.f};
  return {x[0], x[1], y[0], y[1], shift[0], shift[1]};
}

SvgMatrix parse_svg_transform(std::string_view text) {
  SvgMatrix matrix;
  text = without_svg_blanks(text);
  if (text == "none") return matrix;
  for (SvgScanner scanner(text); !scanner.at_end();) {
    const std::string_view name = scanner.letters();
    scanner.skip_blanks();
    if (name.empty() || !scanner.accept('(')) throw SvgFault{fmt::format("{} is no transform", quoted(text))};
    matrix = matrix * function_of(name, arguments(scanner));
    scanner.accept(',');
  }
  return matrix;
}

}  // namespace medial_vk
