// An arm of seven links among obstacles: configurations a second on one core, self-collision and scene, by balls and,
// where these leave it open, by triangles. Prints rows of a markdown table; bench/run_clearance runs it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "../helpers.h"
#include "base/stopwatch.h"
#include "medial_vk/body_group.h"
#include "medial_vk/context.h"
#include "medial_vk/prepare.h"
#include "medial_vk/sphere_fits.h"
#include "robots/primitive_mesh.h"

namespace {

using namespace medial_vk;
using bench::or_exit;

constexpr std::size_t kJoints = 7, kScene = kJoints, kLinks = kJoints + 1;

/// A capsule along z from 0 to `length`, with `sides` sides.
Mesh capsule(double radius, double length, std::uint32_t sides) {
  Mesh mesh;
  const std::uint32_t rings = sides / 2;  // of both caps together, an even number
  mesh.vertices.push_back({0, 0, -radius});
  for (std::uint32_t i = 1; i < 2 * (rings / 2) + 2; ++i) {
    const bool upper = i > rings / 2;
    const double turn = std::numbers::pi / 2 * (upper ? i - rings / 2 - 1 : i - rings / 2 - 0.0) / (rings / 2);
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides, across = radius * std::cos(turn);
      mesh.vertices.push_back(
          {across * std::cos(angle), across * std::sin(angle), (upper ? length : 0) + radius * std::sin(turn)});
    }
    if (upper && i == 2 * (rings / 2)) break;
  }
  mesh.vertices.push_back({0, 0, length + radius});
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1), count = (last - 1) / sides;
  for (std::uint32_t k = 0; k < sides; ++k) {
    const std::uint32_t next = (k + 1) % sides;
    mesh.triangles.push_back({0, 1 + next, 1 + k});
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      const std::uint32_t row = 1 + i * sides;
      mesh.triangles.push_back({row + k, row + next, row + sides + k});
      mesh.triangles.push_back({row + next, row + sides + next, row + sides + k});
    }
    const std::uint32_t row = 1 + (count - 1) * sides;
    mesh.triangles.push_back({row + k, row + next, last});
  }
  return mesh;
}

Mesh box(const Point& size) {
  Geometry geometry;
  geometry.kind = GeometryKind::kBox;
  geometry.size = size;
  return make_primitive(geometry, FacetSide::kInscribed);
}

/// With balls inside and a cover, `count` of each.
Body fitted(Mesh mesh, std::size_t count, Context& context) {
  const IndexedMesh indexed = or_exit(IndexedMesh::build(or_exit(prepare_mesh(std::move(mesh)))));
  SphereFitOptions options;
  options.count = count;
  const std::vector<Ball> inside = or_exit(fit_spheres(indexed, options, context)).levels.back();
  options.contract = SphereContract::kCover;
  return or_exit(Body::create(indexed, inside, or_exit(fit_spheres(indexed, options, context)).levels.back()));
}

double uniform(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution<>(from, to)(random);
}

struct Arm {
  std::vector<double> lengths = {0.3, 0.2, 0.35, 0.2, 0.35, 0.15, 0.12};
  std::vector<double> radii = {0.09, 0.08, 0.075, 0.07, 0.06, 0.055, 0.045};

  /// Joints turn about z and y in turn.
  void poses(std::mt19937_64& random, std::vector<Pose>& poses) const {
    Pose at;
    for (std::size_t i = 0; i < kJoints; ++i) {
      const double turn = uniform(random, -2.5, 2.5);
      at = at * make_pose({0, 0, i == 0 ? 0 : lengths[i - 1]}, i % 2 == 0 ? Point{0, 0, turn} : Point{0, turn, 0});
      poses.push_back(at);
    }
    poses.emplace_back();
  }
};

/// Obstacles of four shapes in a box around the arm, none within reach of its first two links.
std::vector<GroupPart> scene(const std::vector<Body>& shapes, std::size_t count, double half, std::mt19937_64& random) {
  std::vector<GroupPart> parts;
  while (parts.size() < count) {
    const Point at = {uniform(random, -half, half), uniform(random, -half, half), uniform(random, -0.3, half)};
    if (std::hypot(at[0], at[1]) < 0.3 && at[2] < 0.8) continue;
    const Point turn = {uniform(random, -3, 3), uniform(random, -1.5, 1.5), uniform(random, -3, 3)};
    parts.push_back({shapes[parts.size() % shapes.size()], kScene, make_pose(at, turn)});
  }
  return parts;
}

struct Row {
  const char* name;
  GroupOptions options;
};

void measure(const BodyGroup& group, const std::vector<Pose>& poses, const Row& row, std::size_t repeats) {
  const std::size_t count = poses.size() / kLinks;
  std::vector<LeastDistance> cold(count);
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < repeats; ++k) {
    Stopwatch stopwatch;
    for (std::size_t i = 0; i < count; ++i) {
      cold[i] = or_exit(least_distance(group, std::span(poses).subspan(i * kLinks, kLinks), row.options));
    }
    best = std::min(best, stopwatch.lap());
  }
  std::array<std::size_t, 3> states = {0, 0, 0};
  for (const LeastDistance& found : cold) ++states[static_cast<std::size_t>(found.collision())];
  const auto share = [&](std::size_t i) { return 100.0 * static_cast<double>(states[i]) / static_cast<double>(count); };
  fmt::print("| {} | {:.0f} | {:.2f} | {:.1f} | {:.1f} | {:.2f} |\n", row.name, static_cast<double>(count) / best,
             1e6 * best / static_cast<double>(count), share(0), share(1), share(2));
}

void measure_scene(const Arm& arm, std::vector<GroupPart> parts, const std::vector<Body>& shapes, std::size_t obstacles,
                   double half, std::size_t count, std::size_t repeats) {
  fmt::print("\nObstacles up to {} m from the base along each axis:\n\n", half);
  std::mt19937_64 random(1);
  const std::vector<GroupPart> others = scene(shapes, obstacles, half, random);
  parts.insert(parts.end(), others.begin(), others.end());
  std::vector<LinkPair> pairs;
  for (std::uint32_t a = 0; a < kJoints; ++a) {
    for (std::uint32_t b = a + 2; b < kJoints; ++b) pairs.push_back({a, b});
    pairs.push_back({a, kScene});
  }
  const BodyGroup group = or_exit(BodyGroup::create(parts, kLinks, pairs));
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < count; ++i) arm.poses(random, poses);
  fmt::print("| query | configurations a second | microseconds each | free, % | hit, % | undecided, % |\n");
  fmt::print("|---|---|---|---|---|---|\n");
  GroupOptions collisions, nearest, exact_collisions, exact;
  collisions.limit = exact_collisions.limit = 0;
  exact_collisions.exact = exact.exact = true;
  for (const Row& row : {Row{"balls: collision", collisions}, Row{"balls: least distance", nearest},
                         Row{"balls, then triangles: collision", exact_collisions},
                         Row{"balls, then triangles: least distance", exact}}) {
    measure(group, poses, row, repeats);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t balls = 64, obstacles = 100, count = 20000, repeats = 5;
  std::vector<double> halves = {1.5, 3};
  CLI::App app("configurations of an arm a second");
  app.add_option("--balls", balls);
  app.add_option("--obstacles", obstacles);
  app.add_option("--configurations", count);
  app.add_option("--repeats", repeats);
  app.add_option("--half", halves, "half the side of the scene, metres");
  CLI11_PARSE(app, argc, argv);
  Context context = or_exit(Context::create());
  const Arm arm;
  std::vector<GroupPart> parts;
  for (std::uint32_t i = 0; i < kJoints; ++i) {
    parts.push_back({fitted(capsule(arm.radii[i], arm.lengths[i], 24), balls, context), i, {}});
  }
  const std::vector<Body> shapes = {
      fitted(box({0.2, 0.12, 0.15}), balls, context), fitted(capsule(0.06, 0.2, 24), balls, context),
      fitted(box({0.08, 0.08, 0.3}), balls, context), fitted(capsule(0.1, 0.02, 24), balls, context)};
  for (const double half : halves) {
    measure_scene(arm, parts, shapes, obstacles, half, count, repeats);
  }
}
