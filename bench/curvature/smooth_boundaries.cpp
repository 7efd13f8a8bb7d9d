#include "smooth_boundaries.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "base/point_ops.h"
#include "support/solids/solids.h"

namespace medial_vk::bench {
namespace {

bool always(const Point&) { return true; }

SmoothBoundary ellipsoid(const std::string& name, const Point& axes, std::uint32_t triangles) {
  SmoothBoundary out = {name, {}, always, test::make_sphere(1, triangles)};
  for (Point& v : out.mesh.vertices) v = {axes[0] * v[0], axes[1] * v[1], axes[2] * v[2]};
  out.height = [axes](const Point& p) {
    return p[0] * p[0] / (axes[0] * axes[0]) + p[1] * p[1] / (axes[1] * axes[1]) + p[2] * p[2] / (axes[2] * axes[2]) -
           1;
  };
  return out;
}

/// A tube of elliptic sections, of semi-axes `minor` and `flat` times that, bent to a ring. The tightest bends of the
/// section have the radius flat^2 minor.
SmoothBoundary flat_torus(const std::string& name, double major, double minor, double flat, std::uint32_t around,
                          std::uint32_t along) {
  SmoothBoundary out = {name, {}, always, test::make_torus(major, minor, around, along, flat)};
  out.height = [=](const Point& p) {
    const double across = std::hypot(p[0], p[1]) - major, up = p[2] / flat;
    return across * across + up * up - minor * minor;
  };
  return out;
}

/// A grid of `rows` by `columns` places that closes in the columns, and in the rows if `is_closed`.
void add_grid(Mesh& mesh, std::uint32_t rows, std::uint32_t columns, bool is_closed,
              const std::function<Point(std::uint32_t, std::uint32_t)>& place) {
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) mesh.vertices.push_back(place(i, j));
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % rows * columns + j % columns; };
  for (std::uint32_t i = 0; i + (is_closed ? 0 : 1) < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
    }
  }
}

constexpr double kInner = 1 / 0.0875045, kOuter = 1 / 0.069898, kLength = 20;  // Table 5-1 of the source

/// The profile of the wall as a closed loop of rings; `turn`: every other ring is turned by half a step.
SmoothBoundary pipe(const std::string& name, std::uint32_t around, std::uint32_t along, bool turn) {
  SmoothBoundary out = {name, {}, {}, {}};
  const std::uint32_t rings = along + 1;
  add_grid(out.mesh, 2 * rings, around, true, [&](std::uint32_t i, std::uint32_t j) {
    const bool is_outer = i < rings;
    const std::uint32_t ring = is_outer ? i : 2 * rings - 1 - i;
    const double angle = 2 * std::numbers::pi * (j + (turn ? 0.5 * i : 0.0)) / around, r = is_outer ? kOuter : kInner;
    return Point{r * std::cos(angle), r * std::sin(angle), kLength * (static_cast<double>(ring) / along - 0.5)};
  });
  out.height = [](const Point& p) {
    const double r = std::hypot(p[0], p[1]);
    return std::max(r - kOuter, kInner - r);
  };
  out.is_known = [](const Point& p) { return std::fabs(p[2]) < kLength / 2 - 1.5 * (kOuter - kInner); };
  return out;
}

/// A sphere, scaled to `axes` and moved onto the boundary.
void wrap(SmoothBoundary& solid, const Point& axes, std::uint32_t triangles) {
  solid.mesh = test::make_sphere(1, triangles);
  for (Point& v : solid.mesh.vertices) v = solid.nearest({axes[0] * v[0], axes[1] * v[1], axes[2] * v[2]}).position;
}

constexpr double kCapped = 4, kDisc = 2, kRound = 0.5;  // lengths and radii of solids with round ends

/// The balls of radius 1 around a segment along z.
SmoothBoundary capsule(const std::string& name, std::uint32_t triangles) {
  SmoothBoundary out = {name, {}, {}, {}};
  out.height = [](const Point& p) { return std::hypot(p[0], p[1], std::max(0.0, std::fabs(p[2]) - kCapped / 2)) - 1; };
  // Where the cap begins one curvature jumps.
  out.is_known = [](const Point& p) { return std::fabs(std::fabs(p[2]) - kCapped / 2) > 0.1; };
  wrap(out, {1, 1, kCapped / 2 + 1}, triangles);
  return out;
}

/// The balls around a disc in the plane z = 0: a plate with a round rim.
SmoothBoundary disc(const std::string& name, std::uint32_t triangles) {
  SmoothBoundary out = {name, {}, {}, {}};
  out.height = [](const Point& p) { return std::hypot(std::max(0.0, std::hypot(p[0], p[1]) - kDisc), p[2]) - kRound; };
  out.is_known = [](const Point& p) { return std::fabs(std::hypot(p[0], p[1]) - kDisc) > 0.05; };
  wrap(out, {kDisc + kRound, kDisc + kRound, kRound}, triangles);
  return out;
}

constexpr double kSide = 10;

double half_thickness(double x, double y) { return 0.5 + 0.15 * std::sin(0.8 * x) * std::cos(0.65 * y + 0.4); }

SmoothBoundary plate(std::uint32_t triangles) {
  SmoothBoundary out = {"plate", {}, {}, {}};
  const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 4.0)));
  const auto index = [&](std::uint32_t i, std::uint32_t j, bool top) { return (i * (n + 1) + j) * 2 + (top ? 1 : 0); };
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double x = kSide * (static_cast<double>(i) / n - 0.5), y = kSide * (static_cast<double>(j) / n - 0.5);
      const double z = half_thickness(x, y);
      out.mesh.vertices.push_back({x, y, -z});
      out.mesh.vertices.push_back({x, y, z});
    }
  }
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    out.mesh.triangles.push_back({a, b, c});
    out.mesh.triangles.push_back({a, c, d});
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      quad(index(i, j, true), index(i + 1, j, true), index(i + 1, j + 1, true), index(i, j + 1, true));
      quad(index(i, j, false), index(i, j + 1, false), index(i + 1, j + 1, false), index(i + 1, j, false));
    }
    quad(index(i, 0, false), index(i + 1, 0, false), index(i + 1, 0, true), index(i, 0, true));
    quad(index(i, n, true), index(i + 1, n, true), index(i + 1, n, false), index(i, n, false));
    quad(index(0, i, true), index(0, i + 1, true), index(0, i + 1, false), index(0, i, false));
    quad(index(n, i, false), index(n, i + 1, false), index(n, i + 1, true), index(n, i, true));
  }
  out.height = [](const Point& p) { return std::fabs(p[2]) - half_thickness(p[0], p[1]); };
  out.is_known = [](const Point& p) { return std::max(std::fabs(p[0]), std::fabs(p[1])) < kSide / 2 - 1.5; };
  return out;
}

constexpr double kArc = 4, kArcFrom = 2, kTall = 5, kOffEdges = 0.3;

/// Of a prism over a triangle of three arcs: how far a point is outside of each of its four faces.
std::array<double, 4> heights_over_prism(const Point& p) {
  std::array<double, 4> out;
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = std::numbers::pi * (0.5 + 2 * static_cast<double>(k) / 3);
    out[k] = std::hypot(p[0] - kArcFrom * std::cos(angle), p[1] - kArcFrom * std::sin(angle)) - kArc;
  }
  out[3] = std::fabs(p[2]) - kTall / 2;
  return out;
}

/// Three sheets meet along its axis, and others along seams that lead to its ends.
SmoothBoundary prism(const std::string& name, std::uint32_t around, std::uint32_t along) {
  SmoothBoundary out = {name, {}, {}, {}};
  out.height = [](const Point& p) { return std::ranges::max(heights_over_prism(p)); };
  out.is_known = [](const Point& p) {
    std::array<double, 4> heights = heights_over_prism(p);
    std::ranges::sort(heights);
    return heights[2] < -kOffEdges;
  };
  add_grid(out.mesh, along, around, false, [&](std::uint32_t i, std::uint32_t j) {
    const double angle = std::numbers::pi * (0.5 + 2.0 * j / around);
    double inside = 0, outside = kArc;
    while (outside - inside > 1e-13) {
      const double middle = (inside + outside) / 2;
      (out.height({middle * std::cos(angle), middle * std::sin(angle), 0}) < 0 ? inside : outside) = middle;
    }
    return Point{inside * std::cos(angle), inside * std::sin(angle), kTall * (i / (along - 1.0) - 0.5)};
  });
  const std::uint32_t top = (along - 1) * around;
  for (std::uint32_t j = 1; j + 1 < around; ++j) {
    out.mesh.triangles.push_back({0, j + 1, j});
    out.mesh.triangles.push_back({top, top + j, top + j + 1});
  }
  return out;
}

Point gradient_of(const std::function<double(const Point&)>& height, const Point& p, double step) {
  Point out;
  for (std::size_t k = 0; k < 3; ++k) {
    Point to = p, from = p;
    to[k] += step;
    from[k] -= step;
    out[k] = (height(to) - height(from)) / (2 * step);
  }
  return out;
}

}  // namespace

SmoothPoint SmoothBoundary::nearest(Point p) const {
  constexpr double kStep = 1e-4;  // curvatures of all solids here have lengths of 0.3 and more
  for (int i = 0; i < 4; ++i) {
    const Point gradient = gradient_of(height, p, kStep);
    p = p - height(p) / dot(gradient, gradient) * gradient;
  }
  const Point gradient = gradient_of(height, p, kStep);
  SmoothPoint out = {p, 1 / length(gradient) * gradient, {}, {}};
  Eigen::Matrix3d hessian;
  for (int k = 0; k < 3; ++k) {
    Point to = p, from = p;
    to[static_cast<std::size_t>(k)] += kStep;
    from[static_cast<std::size_t>(k)] -= kStep;
    const Point difference = gradient_of(height, to, kStep) - gradient_of(height, from, kStep);
    for (int i = 0; i < 3; ++i) hessian(i, k) = difference[static_cast<std::size_t>(i)] / (2 * kStep);
  }
  const Point x = perpendicular_to(out.normal), y = cross(out.normal, x);
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << x[0], y[0], x[1], y[1], x[2], y[2];
  const Eigen::Matrix2d form = tangents.transpose() * hessian * tangents / length(gradient);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(0.5 * (form + form.transpose()));
  for (int i = 0; i < 2; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.kappa[k] = axes.eigenvalues()[1 - i];
    const Eigen::Vector3d direction = tangents * axes.eigenvectors().col(1 - i);
    out.directions[k] = {direction[0], direction[1], direction[2]};
  }
  return out;
}

void SmoothBoundary::jitter(double share, std::uint64_t seed) {
  std::vector<double> shortest(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const double edge = length(mesh.vertices[a] - mesh.vertices[b]);
      shortest[a] = std::min(shortest[a], edge);
      shortest[b] = std::min(shortest[b], edge);
    }
  }
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<> offset(-1, 1);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const double by = share * shortest[i];
    const Point move = {by * offset(random), by * offset(random), by * offset(random)};
    if (is_known(mesh.vertices[i])) mesh.vertices[i] = nearest(mesh.vertices[i] + move).position;
  }
}

SmoothBoundary make_boundary(const std::string& name, std::uint32_t triangles) {
  const double size = std::sqrt(triangles / 16000.0);
  const auto sized = [&](double count) { return static_cast<std::uint32_t>(std::lround(size * count / 2)) * 2; };
  if (name == "triaxial") return ellipsoid(name, {5, 3.5, 2}, triangles);
  if (name == "oblate") return ellipsoid(name, {2, 2, 1}, triangles);
  if (name == "flat torus") return flat_torus(name, 1.5, 0.78, 0.8, sized(72), sized(112));
  if (name == "tight torus") return flat_torus(name, 3, 1, 0.6, sized(50), sized(160));
  if (name == "slivers") {
    SmoothBoundary slivers = flat_torus(name, 1.5, 0.78, 0.8, sized(320), sized(25));
    slivers.jitter(0.3, 1);
    return slivers;
  }
  if (name == "pipe") return pipe(name, sized(160), sized(24), false);
  if (name == "lantern") return pipe(name, sized(120), sized(32) + 1, true);
  if (name == "plate") return plate(triangles);
  if (name == "prism") return prism(name, sized(48) * 3, sized(52));
  if (name == "capsule") return capsule(name, triangles);
  if (name == "disc") return disc(name, triangles);
  return {};
}

}  // namespace medial_vk::bench
