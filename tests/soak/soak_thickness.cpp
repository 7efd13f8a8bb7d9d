// Thickness without end: soak_thickness FIRST COUNT [SECONDS] [MODEL ...]. Compares intervals of measure_thickness()
// with balls that the reference finds along rays, for the seeds from FIRST on, and prints a table by solids, with a
// line for every fault. A seed is a solid, turned, on one of its sides, with a tolerance and 100 points of the
// boundary. Without a MODEL: of 20 generated solids; else of these meshes. The exit code is 1 if there is a fault.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "medial_vk/thickness.h"
#include "support/eigen_points.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/smooth_solids.h"
#include "support/solids/solids.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::test;

constexpr int kPoints = 100;

// Some 20 to 100 are used at a point. More, where the solid is thinner than delta, would take most of the time.
constexpr std::uint32_t kQueries = 200;

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

Mesh irregular(const SmoothSolid& solid, std::uint32_t triangles) {
  Mesh mesh = solid.mesh(triangles);
  make_irregular(solid, mesh, 5);
  return mesh;
}

std::vector<NamedMesh> generated_solids() {
  const std::array<Point, 4> flat = {Point{0, 0, 0}, {1, 0, 0}, {0.5, 0.02, 0}, {0.4, 0.3, 0.01}};
  return {{"ellipsoid", smooth_ellipsoid(1, 0.95, 0.2)->mesh(4000)},
          {"irregular ellipsoid", irregular(*smooth_ellipsoid(1, 0.7, 0.4), 900)},
          {"sphere", make_sphere(1, 80)},
          {"shell", make_shell(320, 80)},
          {"capsule", make_capsule(0.2, 1, 12)},
          {"pear", smooth_pear(0.1, 0.3, 1)->mesh(800)},
          {"torus", make_turned_torus(30, 20)},
          {"bent torus", bent(make_turned_torus(24, 16))},
          {"thin flat torus", make_torus(1, 0.02, 8, 60, 0.3)},
          {"irregular torus", irregular(*smooth_torus(1, 0.3), 1200)},
          {"box", make_box({2, 1, 0.4})},
          {"thin box", make_box({1, 1e-3, 0.5})},
          {"L", make_l_shape(1, 0.3, 0.2)},
          {"bent L", bent(make_l_shape(1, 0.1, 0.4))},
          {"plate with a hole", make_plate_with_hole(1, 0.1, 0.3)},
          {"plate with two holes", make_plate_with_two_holes(0.3, 0.05)},
          {"cup", make_cup(0.5, 0.05, 1, 24)},
          {"bent cup", bent(make_cup(0.5, 0.1, 0.4, 12))},
          {"two parts", make_two_parts(160)},
          {"flat tetrahedron", make_tetrahedron(flat)}};
}

std::vector<NamedMesh> solids_of(const std::vector<std::string>& files) {
  if (files.empty()) return generated_solids();
  std::vector<NamedMesh> solids;
  solids.reserve(files.size());
  for (const std::string& file : files) {
    Result<Mesh> mesh = read_mesh(file);
    if (!mesh.ok()) {
      fmt::print(stderr, "{}\n", mesh.error().message);
      std::exit(2);
    }
    solids.push_back({file.substr(file.rfind('/') + 1), std::move(mesh).value()});
  }
  return solids;
}

/// In triangles, on edges and at vertices.
std::vector<Point> points_of(const Mesh& mesh, std::mt19937_64& random) {
  std::uniform_real_distribution<> share(0, 1);
  std::uniform_int_distribution<std::size_t> triangle(0, mesh.triangles.size() - 1);
  std::uniform_int_distribution<int> kind(0, 3);
  std::vector<Point> points;
  points.reserve(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const Triangle& t = mesh.triangles[triangle(random)];
    const int of_point = kind(random);
    const double along = share(random);
    const double a = of_point == 0 ? 0 : of_point == 1 ? along : std::sqrt(along);
    const double b = of_point == 1 ? 0 : share(random);
    points.push_back((1 - a) * mesh.vertices[t[0]] + (a * (1 - b)) * mesh.vertices[t[1]] +
                     (a * b) * mesh.vertices[t[2]]);
  }
  return points;
}

/// A solid in the forms of the library and of the reference, with the rounding of the reference's distances: 64
/// roundings of a position, as for distances between solids.
struct ThicknessCase {
  const IndexedMesh& mesh;
  const reference::Tree& tree;
  ThicknessOptions options;
  double rounding;

  double limit() const { return mesh.longest_side(); }
  bool is_inside(const Point& p) const { return winding_number(tree, to_eigen(p), 0.01) > 0.5; }
  bool is_on_side(const Point& p) const { return is_inside(p) == (options.side == ThicknessSide::kWalls); }
  double distance(const Point& p) const { return tree.closest(to_eigen(p)).distance; }
};

/// A ball of more than the radius around a point p + s u that comes within delta of p, or none. The s that are possible
/// are those up to some number (docs/theory.md, "Thickness"), which bisection finds; as p is on the boundary, no ball
/// has a radius above s. With delta and the radius less by the rounding, the ball fulfils both conditions whatever is
/// rounded.
std::optional<Ball> ball_along(const ThicknessCase& of, const Point& p, const Point& direction, double radius) {
  const auto radius_at = [&](double s) { return of.distance(p + s * direction) - of.rounding; };
  const double delta = of.options.delta - 2 * of.rounding;
  const auto is_possible = [&](double s) { return s <= radius_at(s) + delta; };
  const double least = radius - of.rounding;
  double near = least, far = 0.5 * of.limit() + delta;
  if (!is_possible(near)) return std::nullopt;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (near + far);
    (is_possible(middle) ? near : far) = middle;
  }
  constexpr int kParts = 8;
  for (int i = 0; i <= kParts; ++i) {
    const double s = least + (near - least) * i / kParts, found = std::min(radius_at(s), 0.5 * of.limit());
    if (found > radius) return Ball{p + s * direction, found};
  }
  return std::nullopt;
}

/// A sentence on what is wrong, or nothing.
std::string fault_of(const ThicknessCase& of, const Point& p, const Thickness& found, std::mt19937_64& random) {
  const Bounds& diameter = found.diameter;
  const Ball& ball = found.ball;
  if (!(diameter.lower <= diameter.upper)) return "the ends of the interval are in the wrong order";
  if (diameter.lower != 2 * ball.radius) return "the ball is not that of the lower end";
  Point towards = {0, 0, 1};
  if (ball.radius > 0) {
    const double away = length(ball.centre - p);
    if (ball.radius > of.distance(ball.centre) + of.rounding) return "the ball is too large";
    // Products, sums and roots of differences between given numbers.
    if (away > (ball.radius + of.options.delta) * (1 + 0x1p-50)) return "the ball is too far away";
    if (!of.is_on_side(ball.centre)) return "the ball is on the wrong side";
    towards = (1 / away) * (ball.centre - p);
  }
  std::normal_distribution<> normal;
  // Near the direction of the ball, and any.
  for (const double spread : {0.001, 0.01, 0.01, 0.03, 0.1, 0.1, 0.5, 0.5, 5.0, 5.0, 5.0, 5.0}) {
    const Point turned = towards + spread * Point{normal(random), normal(random), normal(random)};
    const auto larger = ball_along(of, p, (1 / length(turned)) * turned, 0.5 * diameter.upper);
    if (!larger || !of.is_on_side(larger->centre)) continue;
    return fmt::format("the ball of radius {:.17g} around {:.17g}, {:.17g}, {:.17g} is larger than {:.17g}",
                       larger->radius, larger->centre[0], larger->centre[1], larger->centre[2], diameter.upper);
  }
  return {};
}

struct Row {
  std::uint64_t points = 0, wide = 0, wrong = 0;
};

void run_seed(const NamedMesh& solid, std::uint64_t seed, Row& row) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<> share(0, 1);
  Mesh mesh = solid.mesh;
  const double x = share(random), y = share(random), turn = 6 * share(random);
  rotate(mesh, {x, y, 1}, turn);
  const PreparedMesh prepared = prepare_mesh(mesh).value();
  const IndexedMesh indexed_mesh = indexed(prepared);
  const reference::Tree tree(to_reference(prepared));
  ThicknessOptions options;
  options.side = share(random) < 0.5 ? ThicknessSide::kWalls : ThicknessSide::kGaps;
  options.delta = indexed_mesh.longest_side() * std::pow(10, -1.5 - 3 * share(random));
  options.queries = kQueries;
  options.threads = 1;
  double greatest = 0;  // of the coordinates of centres
  for (std::size_t axis = 0; axis < 3; ++axis) {
    greatest = std::max({greatest, std::fabs(prepared.report.lower[axis]), std::fabs(prepared.report.upper[axis])});
  }
  greatest += indexed_mesh.longest_side();
  const ThicknessCase of = {indexed_mesh, tree, options, 64 * 0x1p-53 * greatest};
  const std::vector<Point> points = points_of(prepared.mesh, random);
  const std::vector<Thickness> found = measure_thickness(indexed_mesh, points, options).value();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Bounds& diameter = found[i].diameter;
    ++row.points;
    row.wide += diameter.upper - diameter.lower > 0.1 * diameter.upper ? 1 : 0;
    const std::string fault = fault_of(of, points[i], found[i], random);
    if (fault.empty()) continue;
    ++row.wrong;
    fmt::print("seed {}, {}, point {}: {}\n", seed, solid.name, i, fault);
  }
}

int run(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: soak_thickness FIRST COUNT [SECONDS] [MODEL ...]\n", stderr);
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10), count = std::strtoull(argv[2], nullptr, 10);
  const double seconds = argc > 3 ? std::strtod(argv[3], nullptr) : 1e30;
  const std::vector<NamedMesh> solids = solids_of({argv + std::min(argc, 4), argv + argc});
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  std::vector<Row> rows(solids.size());
  std::uint64_t done = 0;
  for (double told = 0; done < count && elapsed() < seconds; ++done) {
    const std::size_t solid = (first + done) % solids.size();
    run_seed(solids[solid], first + done, rows[solid]);
    if (elapsed() < told + 10) continue;
    told = elapsed();
    fmt::print(stderr, "{} of {} seeds, {:.0f} s\n", done + 1, count, told);
    std::fflush(stdout);
  }
  Row all;
  fmt::print("| solid | points | wider than a tenth | wrong |\n|---|---|---|---|\n");
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const Row& row = rows[i];
    fmt::print("| {} | {} | {} | {} |\n", solids[i].name, row.points, row.wide, row.wrong);
    all = {all.points + row.points, all.wide + row.wide, all.wrong + row.wrong};
  }
  fmt::print("| all | {} | {} | {} |\n\n", all.points, all.wide, all.wrong);
  fmt::print("{} seeds of {} solids from seed {}, {:.0f} s\n", done, solids.size(), first, elapsed());
  return all.wrong == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
