// Writes a mesh that has what scans have and other generated meshes lack:
//   bench_make_scan bust|creature FILE.obj TRIANGLES
// triangles whose sizes differ by hundreds, as their number follows the curvature; noise of the scanner; the step and
// the needles where two scans are stitched together; a flat base with a crease. The creature also has thin limbs, and
// vertices that a bad merge has pulled through the surface, so that some triangles cross.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/point_ops.h"
#include "decimate.h"
#include "support/solids/mesh_files.h"

namespace medial_vk::bench {
namespace {

constexpr double kNoise = 2e-4, kStep = 6e-4;  // of the scanner, and between two scans; the solid has the size 2

Point unit(const Point& p) { return (1 / length(p)) * p; }

/// A smooth bump of that height around a direction.
double bump(const Point& d, const Point& around, double height, double width) {
  const Point away = d - unit(around);
  return height * std::exp(-dot(away, away) / (width * width));
}

/// The distance of the surface from the origin in direction d.
double bust(const Point& d) {
  double r = 0.8 / length({d[0] / 0.9, d[1] / 0.75, d[2]});
  r += bump(d, {1, 0, 0.05}, 0.16, 0.13);  // nose
  for (const double side : {-1.0, 1.0}) {
    r -= bump(d, {1, 0.35 * side, 0.3}, 0.05, 0.15);                                       // eyes
    r += bump(d, {0.1, side, 0.1}, 0.12, 0.09) - bump(d, {0.12, side, 0.12}, 0.09, 0.04);  // ears
  }
  r -= 0.02 * std::exp(-std::abs(d[2] + 0.25) / 0.02) * std::max(d[0] - 0.8, 0.0) / 0.2;  // mouth: a crease
  const double hair = std::clamp((d[2] - 0.35 - 0.5 * d[0]) / 0.2, 0.0, 1.0);
  r += hair * (0.04 + 0.008 * std::sin(50 * std::atan2(d[1], d[0])) * (1 + std::sin(31 * d[2])));  // locks
  return d[2] < 0 ? std::min(r, 0.62 / -d[2]) : r;                                                 // base: a plane
}

double creature(const Point& d) {
  double r = 0.42 / length({d[0] / 1.4, d[1] / 0.9, d[2] / 0.8});
  for (const double side : {-1.0, 1.0}) {
    for (const double end : {-1.0, 1.0}) r += bump(d, {end, 0.8 * side, -0.9}, 0.75, 0.13);  // legs
    r += bump(d, {1, 0.3 * side, 0.9}, 0.5, 0.06);                                           // horns
  }
  r += bump(d, {-1, 0, 0.3}, 0.9, 0.1);  // tail
  const double scales = std::sin(45 * d[0]) * std::sin(45 * d[1]) * std::sin(45 * d[2]);
  r += 0.006 * scales * std::clamp(2 * d[2], 0.0, 1.0);
  return r;
}

/// The surface of a cube whose faces have n x n squares, as directions. Vertices at its edges are shared.
Mesh cube_sphere(std::uint32_t n) {
  Mesh mesh;
  std::unordered_map<std::uint64_t, std::uint32_t> number;
  const auto vertex = [&](const std::array<std::uint32_t, 3>& at) {
    const std::uint64_t key = (std::uint64_t{at[2]} * (n + 1) + at[1]) * (n + 1) + at[0];
    const auto [found, is_new] = number.try_emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) {
      Point p{};
      // Equal angles, so that squares have about the same size.
      for (std::size_t k = 0; k < 3; ++k) p[k] = std::tan((at[k] / (n / 2.0) - 1) * std::numbers::pi / 4);
      mesh.vertices.push_back(unit(p));
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const std::uint32_t level : {0u, n}) {
      for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
          const auto corner = [&](std::uint32_t x, std::uint32_t y) {
            std::array<std::uint32_t, 3> at{};
            at[axis] = level;
            at[(axis + 1) % 3] = level == 0 ? y : x;
            at[(axis + 2) % 3] = level == 0 ? x : y;
            return vertex(at);
          };
          const std::uint32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
          mesh.triangles.push_back({a, b, c});
          mesh.triangles.push_back({a, c, d});
        }
      }
    }
  }
  return mesh;
}

Mesh scan(double (*solid)(const Point&), std::uint32_t squares) {
  Mesh mesh = cube_sphere(squares);
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0, kNoise);
  for (Point& p : mesh.vertices) {
    // The second scan is a little larger; its border wanders with the noise.
    const double step = p[1] + 0.2 * p[2] > 50 * noise(random) ? kStep : 0;
    p = (solid(p) + step + noise(random)) * p;
  }
  return mesh;
}

/// Pulls vertices to neighbours of neighbours and a little below the surface.
void merge_badly(Mesh& mesh, std::size_t count) {
  std::mt19937_64 random(11);
  for (std::size_t i = 0; i < count; ++i) {
    const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
    const Point along = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    mesh.vertices[t[0]] = 0.999 * (mesh.vertices[t[0]] + 2.5 * along);
  }
}

}  // namespace
}  // namespace medial_vk::bench

int main(int argc, char** argv) {
  using namespace medial_vk;
  const std::string kind = argc > 1 ? argv[1] : "";
  const long triangles = argc > 3 ? std::atol(argv[3]) : 0;
  if (argc != 4 || (kind != "bust" && kind != "creature") || triangles < 1000 || triangles > 1'000'000) {
    std::fprintf(stderr, "usage: bench_make_scan bust|creature FILE.obj TRIANGLES   (TRIANGLES 1000 to 1000000)\n");
    return 2;
  }
  constexpr double kDense = 8;  // triangles of the scan for one that is left
  const auto squares = 2 * static_cast<std::uint32_t>(std::sqrt(kDense * static_cast<double>(triangles) / 12) / 2);
  Mesh mesh = bench::decimate(bench::scan(kind == "bust" ? bench::bust : bench::creature, squares),
                              static_cast<std::size_t>(triangles));
  if (kind == "creature") bench::merge_badly(mesh, 8);
  std::ofstream out(argv[2]);
  if (!(out << test::to_obj(mesh)).flush()) {
    std::fprintf(stderr, "bench_make_scan: cannot write %s\n", argv[2]);
    return 1;
  }
  std::printf("%zu triangles\n", mesh.triangles.size());
  return 0;
}
