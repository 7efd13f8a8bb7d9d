#include "support/solids/assembly.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include "base/point_ops.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// Coordinates as in a file of seven digits, so that points of one place are one point.
Point rounded(const Point& p) {
  const auto round_one = [](double x) { return std::round(x * 1e7) / 1e7 + 0.0; };
  return {round_one(p[0]), round_one(p[1]), round_one(p[2])};
}

/// How the two parameters of a surface, in [0, 1], come back to where they began.
struct Closing {
  bool in_u = false, in_v = false;
};

using Surface = std::function<Point(double u, double v)>;

/// The surface over a grid of nu * nv squares.
Mesh grid(const Surface& surface, std::uint32_t nu, std::uint32_t nv, Closing closing) {
  const std::uint32_t columns = closing.in_u ? nu : nu + 1, rows = closing.in_v ? nv : nv + 1;
  Mesh mesh;
  for (std::uint32_t i = 0; i < columns; ++i) {
    for (std::uint32_t j = 0; j < rows; ++j) mesh.vertices.push_back(rounded(surface(double(i) / nu, double(j) / nv)));
  }
  for (std::uint32_t i = 0; i < nu; ++i) {
    for (std::uint32_t j = 0; j < nv; ++j) {
      const std::uint32_t next_i = (i + 1) % columns, next_j = (j + 1) % rows;
      const std::uint32_t a = i * rows + j, b = next_i * rows + j, c = next_i * rows + next_j, d = i * rows + next_j;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

struct Limb {
  Point from, to;
  double radius_from, radius_to;
  bool is_open = false;  // at both ends, which are round otherwise
};

/// A tube with muscles.
Mesh make_limb(const Limb& limb, std::uint32_t around, std::uint32_t along) {
  const Point way = limb.to - limb.from, axis = (1 / length(way)) * way;
  const Point side = std::abs(axis[0]) < 0.9 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point across = cross(axis, side), u = (1 / length(across)) * across, v = cross(axis, u);
  return grid(
      [=](double s, double t) {
        const double angle = kTurn * s,
                     end = limb.is_open ? 1 : std::sqrt(std::max(0.0, 1 - (2 * t - 1) * (2 * t - 1)));
        const double radius = (limb.radius_from + (limb.radius_to - limb.radius_from) * t) *
                              (1 + 0.08 * std::sin(5 * angle) * std::sin(9 * t)) * end;
        return limb.from + t * way + radius * (std::cos(angle) * u + std::sin(angle) * v);
      },
      around, along, {true, false});
}

/// Inside out.
Mesh make_ball(const Point& centre, double radius, std::uint32_t around, std::uint32_t along) {
  Mesh ball = grid(
      [=](double s, double t) {
        const double angle = kTurn * s, height = std::numbers::pi * t;
        return centre +
               radius * Point{std::sin(height) * std::cos(angle), std::sin(height) * std::sin(angle), std::cos(height)};
      },
      around, along, {true, false});
  return ball;
}

/// A cone of cloth with folds, its two sides apart from each other.
Mesh make_skirt(std::uint32_t around, std::uint32_t along) {
  return grid(
      [](double s, double t) {
        const double angle = kTurn * s, aside = t < 0.5 ? 0.015 : -0.015, down = t < 0.5 ? 2 * t : 2 - 2 * t;
        const double radius = 0.52 + 0.35 * down + 0.05 * std::sin(12 * angle) + aside;
        return Point{radius * std::cos(angle), radius * std::sin(angle), 0.2 - 0.6 * down};
      },
      around, along, {true, true});
}

class Figure {
 public:
  explicit Figure(double fineness) : fineness_(fineness) {}

  Mesh make(bool has_sheets) {
    add_trunk();
    for (const double side : {-1.0, 1.0}) add_side(side);
    add_clothes();
    if (has_sheets) add_sheets();
    return std::move(mesh_);
  }

 private:
  std::uint32_t fine(double edges) const { return std::max(4u, static_cast<std::uint32_t>(edges * fineness_)); }
  void add(const Limb& limb, double around, double along) { append(mesh_, make_limb(limb, fine(around), fine(along))); }
  void add_ball(const Point& centre, double radius, double around, double along) {
    append(mesh_, make_ball(centre, radius, fine(around), fine(along)));
  }

  void add_trunk() {
    add({{0, 0, 0}, {0, 0, 1.2}, 0.45, 0.5}, 120, 80);
    add_ball({0, 0, 1.55}, 0.35, 100, 60);
  }

  void add_side(double s) {
    add_ball({0.12 * s, -0.25, 1.6}, 0.09, 40, 24);
    add_ball({0.12 * s, -0.31, 1.6}, 0.05, 24, 12);
    if (s > 0) {
      add({{0.2 * s, 0, 0.85}, {s, -0.067, 0.863}, 0.14, 0.07, true}, 50, 60);
      add({{0.8 * s, 0, 0.92}, {1.4 * s, -0.2, 0.75}, 0.14, 0.1}, 60, 60);
    } else {
      add({{0.4 * s, 0, 1.05}, {s, 0, 0.9}, 0.17, 0.13, true}, 50, 60);
      add({{0.9 * s, 0, 0.92}, {1.4 * s, -0.2, 0.75}, 0.14, 0.1}, 60, 60);
    }
    add_ball({1.45 * s, -0.22, 0.73}, 0.14, 60, 36);
    add({{0.2 * s, 0, 0.25}, {0.25 * s, 0, -0.6}, 0.22, 0.17}, 60, 60);
    add({{0.25 * s, 0, -0.3}, {0.27 * s, 0.05, -1.25}, 0.18, 0.12}, 60, 60);
    add_ball({0.27 * s, -0.12, -1.25}, 0.2, 60, 36);
  }

  void add_clothes() {
    append(mesh_, make_skirt(fine(160), fine(80) / 2 * 2));
    add({{0, 0, 0.1}, {0, 0, 1.15}, 0.48, 0.53}, 120, 80);
    for (int copy = 0; copy < 2; ++copy) add({{0, 0, 0.1}, {0, 0, 0.3}, 0.6, 0.6}, 120, 20);
    constexpr int kStrands = 22;
    for (int i = 0; i < kStrands; ++i) {
      const double angle = kTurn * i / kStrands + 0.1 * std::sin(7.0 * i);
      add({{0.36 * std::cos(angle), 0.36 * std::sin(angle), 1.8},
           {0.5 * std::cos(angle), 0.5 * std::sin(angle), 1},
           0.035,
           0.02},
          10, 24);
    }
  }

  void add_sheets() {
    append(mesh_,
           grid(
               [](double s, double t) {
                 return Point{1.2 * (s - 0.5) * (1 + 0.4 * t), 0.6 + 0.25 * t + 0.04 * std::sin(14 * s), 1.2 - 1.6 * t};
               },
               fine(80), fine(80), {}));
    constexpr int kCards = 25;
    for (int i = 0; i < kCards; ++i) {
      const double middle = kTurn * i / kCards;
      append(mesh_, grid(
                        [=](double s, double t) {
                          const double angle = middle + 0.35 * (s - 0.5), radius = 0.37 + 0.1 * t;
                          return Point{radius * std::cos(angle), radius * std::sin(angle), 1.75 - 0.7 * t - 0.05 * s};
                        },
                        fine(8), fine(20), {}));
    }
  }

  double fineness_;
  Mesh mesh_;
};

}  // namespace

Mesh make_assembly(const AssemblyOptions& options) { return Figure(options.fineness).make(options.has_sheets); }

}  // namespace medial_vk::test
