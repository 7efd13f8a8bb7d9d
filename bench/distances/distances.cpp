// Bounds of distances by balls, and exact distances by FCL, of a solid and its copy in random poses: a row of a table.
//   bench_distances [--poses N] [--repeats N] MESH INSIDE.csv COVER.csv
// Poses: any rotation, a shift of up to two sides (of the box around the mesh) in any direction; those that overlap,
// and distances above one side, are left out. "Warm" queries start from the result for a pose one degree and one
// percent of a side away. Times are medians of the repeats, per query, on one thread; the methods take turns.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "../unions/ball_files.h"
#include "fcl_peer.h"
#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "medial_vk/proximity.h"

namespace {

using namespace medial_vk;
using bench::FclPeer;

template <typename T>
T or_exit(Result<T> result) {
  if (result.ok()) return std::move(result).value();
  std::fprintf(stderr, "bench_distances: %s\n", result.error().message.c_str());
  std::exit(1);
}

double longest_side(const Mesh& mesh) {
  Point lower = mesh.vertices.front(), upper = lower;
  for (const Point& p : mesh.vertices) {
    for (std::size_t k = 0; k < 3; ++k) {
      lower[k] = std::min(lower[k], p[k]);
      upper[k] = std::max(upper[k], p[k]);
    }
  }
  return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]});
}

using Random = std::mt19937_64;

Point direction(Random& random) {
  std::normal_distribution<> normal;
  const Point d = {normal(random), normal(random), normal(random)};
  const double length = std::hypot(d[0], d[1], d[2]);
  return {d[0] / length, d[1] / length, d[2] / length};
}

/// About `axis` through the origin (Rodrigues).
Pose turned(const Point& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), v = 1 - c;
  const auto& [x, y, z] = axis;
  Pose pose;
  pose.rotation = {{{c + v * x * x, v * x * y - s * z, v * x * z + s * y},
                    {v * x * y + s * z, c + v * y * y, v * y * z - s * x},
                    {v * x * z - s * y, v * y * z + s * x, c + v * z * z}}};
  return pose;
}

struct Query {
  Pose pose;
  DistanceBounds before;  // of a pose nearby
  Distance exact_before;  // likewise
};

/// Of random poses those in which the covers are apart and the balls inside no farther from each other than `side`.
std::vector<Query> queries(const Body& body, double side, std::size_t count) {
  Random random(1);
  std::uniform_real_distribution<> sides(0, 2), turn(0, 3.14159265358979);
  std::vector<Query> out;
  while (out.size() < count) {
    // Rotations that are uniform in axis and angle only: they cover all directions of approach.
    Query query;
    query.pose = turned(direction(random), turn(random));
    const Point to = direction(random);
    const double by = sides(random) * side;
    query.pose.shift = {by * to[0], by * to[1], by * to[2]};
    const DistanceBounds bounds = distance_bounds(body, body, query.pose);
    if (bounds.collision() != Collision::kFree || bounds.upper > side) continue;
    Pose step = turned(direction(random), 0.0174533);
    const Point aside = direction(random);
    step.shift = {0.01 * side * aside[0], 0.01 * side * aside[1], 0.01 * side * aside[2]};
    query.before = distance_bounds(body, body, step * query.pose);
    query.exact_before = or_exit(distance(body, body, step * query.pose));
    out.push_back(query);
  }
  return out;
}

double microseconds_each(std::size_t count, const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return 1e6 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() /
         static_cast<double>(count);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

struct Row {
  double mean_width = 0, greatest_width = 0;  // of the intervals, percent of the side
  double middle_error = 0;                    // mean, percent of the side; with FCL only
  std::size_t wrong = 0;                      // intervals without FCL's distance
  double error = 0;                           // greatest, of exact distances from FCL's, in sides
  std::vector<double> cold, warm, fcl;        // microseconds
  std::vector<double> exact_cold, exact_warm, near_cold, near_warm;  // likewise; "near": to 1e-6 of the side
};

void compare(const Body& body, const FclPeer& peer, const std::vector<Query>& all, double side, Row& row) {
  const auto share = 100 / side / static_cast<double>(all.size());
  for (const Query& query : all) {
    const DistanceBounds bounds = distance_bounds(body, body, query.pose);
    row.mean_width += share * (bounds.upper - bounds.lower);
    row.greatest_width = std::max(row.greatest_width, 100 * (bounds.upper - bounds.lower) / side);
    if (!FclPeer::is_there()) continue;
    const double exact = peer.distance(query.pose);
    row.middle_error += share * std::abs(exact - (bounds.lower + bounds.upper) / 2);
    row.wrong += !(bounds.lower <= exact && exact <= bounds.upper);
    const Distance found = or_exit(distance(body, body, query.pose));
    row.error = std::max({row.error, std::abs(found.upper - exact) / side, std::abs(found.lower - exact) / side});
  }
}

void measure(const Body& body, const FclPeer& peer, const std::vector<Query>& all, double side, int repeats, Row& row) {
  double sum = 0;  // keeps the results in use
  DistanceOptions near;
  near.tolerance = 1e-6 * side;
  const auto exact = [&](const DistanceOptions& options, bool is_warm) {
    return microseconds_each(all.size(), [&] {
      for (const Query& query : all) {
        sum += or_exit(distance(body, body, query.pose, options, is_warm ? query.exact_before : Distance{})).lower;
      }
    });
  };
  for (int repeat = 0; repeat < repeats; ++repeat) {
    row.cold.push_back(microseconds_each(all.size(), [&] {
      for (const Query& query : all) sum += distance_bounds(body, body, query.pose).lower;
    }));
    row.warm.push_back(microseconds_each(all.size(), [&] {
      for (const Query& query : all) sum += distance_bounds(body, body, query.pose, query.before).lower;
    }));
    row.exact_cold.push_back(exact({}, false));
    row.exact_warm.push_back(exact({}, true));
    row.near_cold.push_back(exact(near, false));
    row.near_warm.push_back(exact(near, true));
    if (!FclPeer::is_there()) continue;
    const std::size_t few = std::min<std::size_t>(all.size(), 200);
    row.fcl.push_back(microseconds_each(few, [&] {
      for (std::size_t i = 0; i < few; ++i) sum += peer.distance(all[i].pose);
    }));
  }
  if (sum < 0) std::puts("distances are not negative");
}

void print(const std::string& name, const Mesh& mesh, const Body& body, const Row& row) {
  const double cold = median(row.cold), warm = median(row.warm);
  fmt::print("| {} | {} | {} / {} | {:.2f} / {:.2f} | {:.2f} | {:.2f} |", name, mesh.triangles.size(),
             body.inside().size(), body.cover().size(), row.mean_width, row.greatest_width, cold, warm);
  if (row.fcl.empty()) {
    fmt::print(" | | | |\n");
    return;
  }
  const double exact = median(row.fcl);
  const double exact_cold = median(row.exact_cold), exact_warm = median(row.exact_warm);
  const double near_cold = median(row.near_cold), near_warm = median(row.near_warm);
  fmt::print(" {:.3f} | {:.0f} | {:.0f} / {:.0f} | {} |\n", row.middle_error, exact, exact / cold, exact / warm,
             row.wrong);
  fmt::print("| exact {:.2f} / {:.2f}, FCL {:.0f} / {:.0f} | near {:.2f} / {:.2f}, FCL {:.0f} / {:.0f} | error {:.1e} |\n",
             exact_cold, exact_warm, exact / exact_cold, exact / exact_warm, near_cold, near_warm, exact / near_cold,
             exact / near_warm, row.error);
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t poses = 2000;
  int repeats = 7;
  std::string mesh_file, inside_file, cover_file;
  CLI::App app("Bounds of distances by balls, and distances by FCL.");
  app.add_option("--poses", poses, "poses of the copy")->check(CLI::PositiveNumber);
  app.add_option("--repeats", repeats, "runs, of which the median counts")->check(CLI::PositiveNumber);
  app.add_option("mesh", mesh_file)->required();
  app.add_option("inside", inside_file)->required();
  app.add_option("cover", cover_file)->required();
  CLI11_PARSE(app, argc, argv);

  const Mesh mesh = or_exit(read_mesh(mesh_file));
  const IndexedMesh indexed = or_exit(IndexedMesh::build(or_exit(prepare_mesh(mesh))));
  const Body body =
      or_exit(Body::create(indexed, bench::read_balls(inside_file), bench::read_balls(cover_file)));
  const bench::FclPeer peer(mesh);
  const double side = longest_side(mesh);
  const std::vector<Query> all = queries(body, side, poses);
  Row row;
  compare(body, peer, all, side, row);
  measure(body, peer, all, side, repeats, row);
  const std::size_t slash = mesh_file.rfind('/') + 1;
  print(mesh_file.substr(slash, mesh_file.rfind('.') - slash), mesh, body, row);
}
