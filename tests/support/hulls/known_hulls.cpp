#include "support/hulls/known_hulls.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/point_ops.h"
#include "support/hulls/random_hulls.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

using FarPoint = std::array<long double, 3>;

double uniform(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Evenly by its logarithm.
double of_any_size(double least, double most, std::mt19937_64& random) {
  return std::exp(uniform(std::log(least), std::log(most), random));
}

long double product(const FarPoint& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

FarPlane plane_of(const Point& a, const Point& b, const Point& c) {
  FarPoint ab, ac;
  for (std::size_t k = 0; k < 3; ++k) {
    ab[k] = static_cast<long double>(b[k]) - a[k];
    ac[k] = static_cast<long double>(c[k]) - a[k];
  }
  FarPoint normal = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]};
  const long double size = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  for (long double& x : normal) x /= size;
  return {normal, product(normal, a)};
}

FarPlane across(double x, double y, double through_x, double through_y) {
  const long double size = std::hypot(static_cast<long double>(x), static_cast<long double>(y));
  const FarPoint normal = {x / size, y / size, 0};
  return {normal, product(normal, {through_x, through_y, 0})};
}

ConvexPart box_of(const Point& lower, const Point& upper) {
  ConvexPart box;
  for (std::size_t k = 0; k < 3; ++k) {
    FarPoint normal = {};
    normal[k] = 1;
    box.push_back({normal, upper[k]});
    normal[k] = -1;
    box.push_back({normal, -static_cast<long double>(lower[k])});
  }
  return box;
}

/// The greatest excess of a hull over the planes, and the plane that has it.
std::pair<long double, const FarPlane*> excess_over(const ConvexPart& part, const BallHull& hull) {
  std::pair<long double, const FarPlane*> found = {-HUGE_VALL, nullptr};
  for (const FarPlane& plane : part) {
    for (const Ball& ball : hull.balls()) {
      const long double excess = product(plane.normal, ball.centre) + ball.radius - plane.bound;
      if (excess > found.first) found = {excess, &plane};
    }
  }
  return found;
}

Point random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Point d{};
  for (double& x : d) x = normal(random);
  return (1 / length(d)) * d;
}

Placement random_placement(std::mt19937_64& random) {
  const Point x = random_direction(random), other = random_direction(random);
  Placement placement{};
  const auto set = [&](std::size_t row, const Point& v) {
    const long double size = std::sqrt(static_cast<long double>(v[0]) * v[0] + static_cast<long double>(v[1]) * v[1] +
                                       static_cast<long double>(v[2]) * v[2]);
    for (std::size_t k = 0; k < 3; ++k) placement.axes[row][k] = v[k] / size;
  };
  const Point z = cross(x, other), y = cross(z, x);
  set(0, x);
  set(1, y);
  set(2, z);
  placement.factor = of_any_size(1e-3, 1e3, random);
  const double reach = random() % 2 == 0 ? 0 : of_any_size(0.1, 30, random);
  for (long double& o : placement.offset) o = placement.factor * reach * uniform(-1, 1, random);
  return placement;
}

/// A random small or large hull of all families with its first centre at `p`.
BallHull hull_at(const Point& p, std::mt19937_64& random) {
  BallHull hull = random_hull(1 + static_cast<std::uint32_t>(random() % 3), random);
  const double factor = of_any_size(0.02, 0.7, random);
  const Point first = hull.corners[0].centre;
  for (Ball& ball : hull.corners) {
    ball.centre = p + factor * (ball.centre - first);
    ball.radius *= factor;
  }
  return hull;
}

void shift(BallHull& hull, const FarPoint& direction, long double by) {
  for (Ball& ball : hull.corners) {
    for (std::size_t k = 0; k < 3; ++k) ball.centre[k] = static_cast<double>(ball.centre[k] + by * direction[k]);
  }
}

}  // namespace

Point Placement::of(const Point& p) const {
  Point result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = static_cast<double>(factor * (axes[0][k] * p[0] + axes[1][k] * p[1] + axes[2][k] * p[2]) + offset[k]);
  }
  return result;
}

BallHull Placement::of(const BallHull& hull) const {
  BallHull result = hull;
  for (std::uint32_t i = 0; i < hull.count; ++i) {
    result.corners[i] = {of(hull.corners[i].centre), static_cast<double>(factor * hull.corners[i].radius)};
  }
  return result;
}

KnownSolid::KnownSolid(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  switch (seed % 4) {
    case 0:
    case 1:
      make_convex(random);
      break;
    case 2:
      make_l_shape(random);
      break;
    default:
      make_plate(random);
  }
  divide(static_cast<int>(random() % 4));
  placement_ = random_placement(random);
  placed_ = mesh_;
  for (Point& p : placed_.vertices) p = placement_.of(p);
}

void KnownSolid::make_convex(std::mt19937_64& random) {
  if (random() % 2 == 0) {
    // Corners of a cube, each moved: from a regular tetrahedron to a flat one.
    std::array<Point, 4> corners = {{{0, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}};
    const double height = of_any_size(0.05, 1, random);
    for (Point& corner : corners) {
      for (double& x : corner) x = 0.8 * x + 0.2 * uniform(0, 1, random);
      corner[2] *= height;
    }
    mesh_ = make_tetrahedron(corners);
    if (signed_volume(mesh_) < 0) turn_over(mesh_);
  } else {
    // A prism over a polygon with its corners on an ellipse.
    const auto sides = 3 + static_cast<std::uint32_t>(random() % 20);
    const double height = of_any_size(0.02, 1, random), width = of_any_size(0.1, 0.5, random);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * (i + uniform(0, 0.8, random)) / sides;
      for (const double z : {0.0, height}) {
        mesh_.vertices.push_back({0.5 + 0.5 * std::cos(angle), 0.5 + width * std::sin(angle), z});
      }
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
      mesh_.triangles.push_back({a, b, b + 1});
      mesh_.triangles.push_back({a, b + 1, a + 1});
      if (i == 0 || i + 1 == sides) continue;
      mesh_.triangles.push_back({0, b, a});
      mesh_.triangles.push_back({1, a + 1, b + 1});
    }
  }
  ConvexPart part;
  for (const Triangle& t : mesh_.triangles) {
    part.push_back(plane_of(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]));
  }
  cover_ = {part};
}

void KnownSolid::make_l_shape(std::mt19937_64& random) {
  const double thickness = uniform(0.1, 0.6, random), height = of_any_size(0.02, 1, random);
  mesh_ = test::make_l_shape(1, thickness, height);
  cover_ = {box_of({0, 0, 0}, {1, thickness, height}), box_of({0, 0, 0}, {thickness, 1, height})};
  box_ = box_of({0, 0, 0}, {1, 1, height});
  notch_ = {{thickness, thickness}, {1, thickness}, {1, 1}, {thickness, 1}};
}

void KnownSolid::make_plate(std::mt19937_64& random) {
  const double thickness = of_any_size(0.02, 0.5, random), hole = uniform(0.1, 0.8, random);
  mesh_ = make_plate_with_hole(1, thickness, hole);
  const double low = 0.5 - 0.5 * hole, high = 0.5 + 0.5 * hole;
  cover_ = {box_of({0, 0, 0}, {low, 1, thickness}), box_of({high, 0, 0}, {1, 1, thickness}),
            box_of({0, 0, 0}, {1, low, thickness}), box_of({0, high, 0}, {1, 1, thickness})};
  box_ = box_of({0, 0, 0}, {1, 1, thickness});
  notch_ = {{low, low}, {high, low}, {high, high}, {low, high}};
}

/// Every triangle into four.
void KnownSolid::divide(int times) {
  for (; times > 0; --times) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] =
          middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh_.vertices.size()));
      if (is_new) mesh_.vertices.push_back(0.5 * (mesh_.vertices[a] + mesh_.vertices[b]));
      return at->second;
    };
    std::vector<Triangle> smaller;
    for (const auto& [a, b, c] : mesh_.triangles) {
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      smaller.insert(smaller.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh_.triangles = std::move(smaller);
  }
}

/// Beside a notch: the half of the solid's box that a plane through an edge of the notch cuts off, with the whole notch
/// on the other side of it.
ConvexPart KnownSolid::random_part(std::mt19937_64& random) const {
  if (notch_.empty() || random() % 4 == 0) return cover_[random() % cover_.size()];
  for (;;) {
    const std::size_t corner = random() % notch_.size();
    const double x = notch_[corner][0], y = notch_[corner][1];
    const double angle = uniform(-std::numbers::pi, std::numbers::pi, random);
    const double nx = std::cos(angle), ny = std::sin(angle);
    const auto is_beyond = [&](const std::array<double, 2>& other) {
      return nx * (other[0] - x) + ny * (other[1] - y) >= 0;
    };
    if (!std::ranges::all_of(notch_, is_beyond)) continue;
    ConvexPart part = box_;
    part.push_back(across(nx, ny, x, y));
    return part;
  }
}

bool KnownSolid::is_outside(const Point& p) const {
  BallHull point = hull_of(Ball{p, 0});
  return std::ranges::all_of(cover_, [&](const ConvexPart& part) { return excess_over(part, point).first >= kLeast; });
}

BallHull KnownSolid::inside(std::mt19937_64& random) const {
  for (;;) {
    const ConvexPart part = random_part(random);
    const Point p = {uniform(0, 1, random), uniform(0, 1, random), uniform(0, 1, random)};
    if (!(excess_over(part, hull_of(Ball{p, 0})).first < 0)) continue;
    BallHull hull = hull_at(p, random);
    const double most = random() % 2 == 0 ? 1e-2 : 2e-9;
    const double depth = of_any_size(1.01e-9, most, random);
    if (random() % 2 == 0) {
      const auto change = static_cast<double>(-depth - excess_over(part, hull).first);
      for (std::uint32_t i = 0; i < hull.count; ++i) hull.corners[i].radius += change;
      if (std::ranges::any_of(hull.balls(), [](const Ball& ball) { return ball.radius < 0; })) continue;
    } else {
      for (int step = 0; step < 20; ++step) {
        const auto [excess, plane] = excess_over(part, hull);
        if (step > 0 && excess <= -kLeast) break;
        shift(hull, plane->normal, -depth - excess);
      }
    }
    if (excess_over(part, hull).first <= -kLeast) return placement_.of(hull);
  }
}

BallHull KnownSolid::outside(std::mt19937_64& random) const {
  for (;;) {
    // A point beyond a face, an edge or a corner.
    const Triangle& t = mesh_.triangles[random() % mesh_.triangles.size()];
    const Point &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    const double v = random() % 4 == 0 ? 0 : uniform(0, 1, random);
    const double w = random() % 4 == 0 ? 0 : uniform(0, 1 - v, random);
    Point normal = cross(b - a, c - a);
    normal = (1 / length(normal)) * normal;
    Point away = normal;
    if (random() % 4 == 0) away = normal + uniform(0, 1, random) * random_direction(random);
    away = (1 / length(away)) * away;
    const double reach = of_any_size(1.01e-9, random() % 2 == 0 ? 2e-9 : 0.5, random);
    const Point beyond = a + v * (b - a) + w * (c - a) + reach * away;
    if (!is_outside(beyond)) continue;
    // One of the balls of a hull reaches to it: mostly from inside.
    BallHull hull = hull_at(beyond, random);
    std::array<double, 3> weight = {};
    double sum = 0;
    for (std::uint32_t i = 0; i < hull.count; ++i) sum += weight[i] = uniform(0, 1, random);
    if (random() % 4 == 0 || !(sum > 0)) {
      weight = {1, 0, 0};
      sum = 1;
    }
    Point reached = {0, 0, 0};
    const Point direction = random() % 8 == 0 ? -1.0 * away : random() % 8 == 0 ? random_direction(random) : away;
    for (std::uint32_t i = 0; i < hull.count; ++i) {
      const Ball& ball = hull.corners[i];
      reached = reached + (weight[i] / sum) * (ball.centre + ball.radius * direction);
    }
    for (Ball& ball : hull.corners) ball.centre = ball.centre + (beyond - reached);
    return placement_.of(hull);
  }
}

}  // namespace medial_vk::test
