#include "curvature/differences.h"

#include <Eigen/LU>
#include <numbers>

namespace medial_vk {
namespace {

constexpr double kGammaCosine = 0.696706709;  // of gamma = 0.8 radians, Section 5.4.1
constexpr double kSimilarDot = 0.8;           // Section 5.4.2
constexpr double kStepTolerance = 0.2;        // epsilon_1
constexpr double kAverageShare = 0.25;        // epsilon_2 over the step; also sigma of Section 5.4.1 as it is read here
constexpr double kShorter = 0.75;             // a step is decreased by this factor

Point unit(const Point& v) {
  const double norm = length(v);
  return norm > 0 ? 1 / norm * v : Point{0, 0, 0};
}

/// A real eigenvalue of the radial shape operator, with its direction in the tangent plane.
struct RadialAxis {
  double kappa;
  Point direction;
};

/// Both axes of the matrix (a b; c d) in a basis; false if they are complex.
bool axes_of(double a, double b, double c, double d, const Point& first, const Point& second,
             std::array<RadialAxis, 2>& out) {
  const double half = (a + d) / 2, square = (a - d) * (a - d) / 4 + b * c;
  if (!(square >= 0)) return false;
  const double root = std::sqrt(square);
  for (std::size_t i = 0; i < 2; ++i) {
    const double value = half + (i == 0 ? -root : root);
    // Both rows of the matrix less the eigenvalue are perpendicular to the vector; the longer one says it better.
    const bool use_first = length(Point{a - value, b, 0}) >= length(Point{c, d - value, 0});
    double x = use_first ? -b : value - d, y = use_first ? a - value : c;
    if (x == 0 && y == 0) (i == 0 ? x : y) = 1;
    out[i] = {value, unit(x * first + y * second)};
  }
  return true;
}

}  // namespace

SpokeDifferences::SpokeDifferences(std::span<const Ball> balls, std::span<const SpokePair> spokes, double spacing,
                                   const CurvatureOptions& options)
    : balls_(balls),
      spokes_(spokes.begin(), spokes.end()),
      centres_(centres_of(balls)),
      step_(options.step * spacing),
      least_step_(2 * std::numbers::sqrt3 * spacing),
      grid_(centres_, step_ / 3) {
  if (!options.smooth) return;
  std::vector<SpokePair> smoothed(balls.size());
  for (std::uint32_t i = 0; i < balls.size(); ++i) {
    bool found = false;
    smoothed[i] = average(centres_[i], 2 * kAverageShare * step_, normal_of(i), kGammaCosine, found);
    if (!found) smoothed[i] = spokes_[i];
    // The average is about the ball's own normal, so that its spokes keep their names.
  }
  spokes_ = std::move(smoothed);
}

Point SpokeDifferences::normal_of(std::uint32_t ball) const { return unit(spokes_[ball].a - spokes_[ball].b); }

SpokePair SpokeDifferences::aligned(std::uint32_t ball, const Point& normal) const {
  const SpokePair& own = spokes_[ball];
  return dot(own.a - own.b, normal) < 0 ? SpokePair{own.b, own.a} : own;
}

SpokePair SpokeDifferences::average(const Point& place, double reach, const Point& normal, double least_cosine,
                                    bool& found) const {
  SpokePair sum = {{0, 0, 0}, {0, 0, 0}};
  const double sigma = kAverageShare * step_;
  found = false;
  grid_.visit_within(place, reach, [&](std::uint32_t other, double squared) {
    if (std::fabs(dot(normal_of(other), normal)) < least_cosine) return;
    const SpokePair pair = aligned(other, normal);
    const double weight = std::exp(-squared / (2 * sigma * sigma));
    sum.a = sum.a + weight * pair.a;
    sum.b = sum.b + weight * pair.b;
    found = true;
  });
  return {unit(sum.a), unit(sum.b)};
}

bool SpokeDifferences::find_step(std::uint32_t ball, const Point& direction, double step, Neighbour& found) const {
  const Point target = centres_[ball] + step * direction;
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = ball;
  // Balls farther from the target than the step tolerates cannot pass the test of the distance from x_0 along it.
  grid_.visit_within(target, step, [&](std::uint32_t other, double squared) {
    if (squared < least || (squared == least && other < nearest)) {
      least = squared;
      nearest = other;
    }
  });
  const double distance = length(centres_[nearest] - centres_[ball]);
  if (nearest == ball || std::fabs(distance - step) > kStepTolerance * step) return false;
  if (std::fabs(dot(normal_of(nearest), normal_of(ball))) <= kGammaCosine) return false;
  found = {nearest, distance};
  return true;
}

bool SpokeDifferences::find_basis(std::uint32_t ball, Basis& basis) const {
  const Point normal = normal_of(ball);
  if (!(dot(normal, normal) > 0)) return false;
  const Point direction = perpendicular_to(normal);
  for (double step = step_; step >= least_step_; step *= kShorter) {
    for (const double sign : {1.0, -1.0}) {
      if (find_basis_along(sign * direction, step, ball, normal, basis)) return true;
    }
  }
  return false;
}

bool SpokeDifferences::find_basis_along(const Point& direction, double step, std::uint32_t ball, const Point& normal,
                                        Basis& basis) const {
  Neighbour next{};
  if (!find_step(ball, direction, step, next)) return false;
  basis.length = next.length;
  basis.first = 1 / next.length * (centres_[next.ball] - centres_[ball]);
  basis.second = unit(cross(normal, basis.first));
  basis.normal = cross(basis.first, basis.second);
  basis.at_first = aligned(next.ball, normal);
  const Point place = centres_[ball] + next.length * basis.second;
  bool found = false;
  for (const double least_cosine : {kSimilarDot, -1.0}) {
    basis.at_second = average(place, kAverageShare * step_, normal, least_cosine, found);
    if (found) return true;
  }
  return false;
}

bool SpokeDifferences::find_bases(std::uint32_t ball, Bases& bases) const {
  if (!find_basis(ball, bases.chosen)) return false;
  const Point normal = normal_of(ball);
  // The other directions of the chosen basis, in the plane across the normal.
  const Point aside = bases.chosen.second, along = cross(aside, normal);
  for (const Point& direction : {-1 * along, aside, -1 * aside}) {
    for (double step = step_; step >= least_step_; step *= kShorter) {
      if (!find_basis_along(direction, step, ball, normal, bases.others[bases.count].basis)) continue;
      ++bases.count;
      break;
    }
  }
  Other& shorter = bases.others[bases.count];
  if (!find_basis_along(along, least_step_, ball, normal, shorter.basis)) return true;
  const double share = shorter.basis.length / bases.chosen.length;
  if (share > kShorter) return true;  // steps of nearly equal lengths have nearly equal errors
  // Of an error that grows with the step; of one that grows with its square, it is more than the error.
  shorter.factor = 1 / (1 - share);
  ++bases.count;
  return true;
}

Eigen::Matrix2d SpokeDifferences::radial_shape(const Basis& basis, const Point& spoke, const Point& at_first,
                                               const Point& at_second) {
  // Equations 5.9, 5.10, 5.12, 5.13; then 5.4 and 5.5, along the spoke onto the tangent plane.
  const double across = dot(spoke, basis.normal);
  const auto column = [&](const Point& there) {
    const Point change = 1 / basis.length * (there - spoke);
    const Point turned = -1 * (change - dot(change, basis.normal) / across * spoke);
    return Eigen::Vector2d(dot(turned, basis.first), dot(turned, basis.second));
  };
  Eigen::Matrix2d out;
  out << column(at_first), column(at_second);
  return out;
}

double SpokeDifferences::error_of(const Bases& bases, std::size_t side, const SpokePair& own, double radius) const {
  const Point& spoke = side == 0 ? own.a : own.b;
  const Point x = perpendicular_to(spoke), y = cross(spoke, x);
  bool is_focal = false;
  const auto boundary_shape = [&](const Basis& basis) {
    const SpokePair &first = basis.at_first, &second = basis.at_second;
    const Eigen::Matrix2d radial =
        side == 0 ? radial_shape(basis, spoke, first.a, second.a) : radial_shape(basis, spoke, first.b, second.b);
    const Eigen::Matrix2d left = Eigen::Matrix2d::Identity() - radius * radial;
    // Both eigenvalues of `left` are positive, or complex: the condition of Definition 5.1.
    if (!(left.determinant() > 0) || !(left.trace() > 0)) is_focal = true;
    Eigen::Matrix2d axes;  // from the tangent plane of the sheet to that of the boundary
    axes << dot(x, basis.first), dot(x, basis.second), dot(y, basis.first), dot(y, basis.second);
    return Eigen::Matrix2d(-axes * radial * left.inverse() * axes.inverse());
  };
  const Eigen::Matrix2d chosen = boundary_shape(bases.chosen);
  double greatest = TipCurvature::kUnknown;
  for (std::size_t k = 0; k < bases.count; ++k) {
    const Eigen::Matrix2d difference = boundary_shape(bases.others[k].basis) - chosen;
    const double squares = difference.squaredNorm(), product = 2 * difference.determinant();
    const double norm = std::sqrt((squares + std::sqrt(std::max(0.0, squares * squares - product * product))) / 2);
    if (!std::isfinite(norm)) is_focal = true;  // the spoke lies in the plane of this basis
    greatest = std::fmax(greatest, bases.others[k].factor * norm);
  }
  return is_focal ? TipCurvature::kUnknown : greatest;
}

BallCurvature SpokeDifferences::measure(std::uint32_t ball) const {
  BallCurvature out;
  const SpokePair& own = spokes_[ball];
  out.object_angle = 0.5 * std::atan2(length(cross(own.a, own.b)), dot(own.a, own.b));
  Bases bases;
  const bool has_basis = find_bases(ball, bases);
  const Basis& basis = bases.chosen;
  const double r = balls_[ball].radius;
  for (std::size_t side = 0; side < 2; ++side) {
    TipCurvature& tip = out.tips[side];
    const Point &spoke = side == 0 ? own.a : own.b, &at_first = side == 0 ? basis.at_first.a : basis.at_first.b;
    const Point& at_second = side == 0 ? basis.at_second.a : basis.at_second.b;
    tip.normal = spoke;
    if (!has_basis || dot(spoke, basis.normal) == 0) continue;  // kFew
    const Eigen::Matrix2d shape = radial_shape(basis, spoke, at_first, at_second);
    std::array<RadialAxis, 2> axes;
    tip.state = CurvatureState::kUncertain;
    if (!axes_of(shape(0, 0), shape(0, 1), shape(1, 0), shape(1, 1), basis.first, basis.second, axes)) continue;
    tip.state = CurvatureState::kFocal;
    if (axes[1].kappa * r >= 1) continue;  // equation 5.6
    tip.state = CurvatureState::kKnown;
    tip.window = basis.length;
    tip.error = error_of(bases, side, own, r);
    for (std::size_t i = 0; i < 2; ++i) {
      tip.kappa[i] = -axes[i].kappa / (1 - r * axes[i].kappa);  // equation 5.7
      tip.directions[i] = unit(axes[i].direction - dot(axes[i].direction, spoke) * spoke);
    }
  }
  return out;
}

}  // namespace medial_vk
