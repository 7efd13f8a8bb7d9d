// Distances of a solid and its copy in random poses, and those of FCL: a row of a table.
//   bench_distances [--poses N] [--repeats N] BODY.npz    bounds by balls
//   bench_distances [--poses N] [--repeats N] MESH        exact distances
// Poses: any rotation, a shift of up to two sides (of the box around the mesh) in any direction; those that overlap,
// and distances above one side, are left out. "Warm" queries start from the result for a pose one degree and one
// percent of a side away. Times are of the processor, medians of the repeats, per query, on one thread; the methods
// take turns.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "body_files/body_file.h"
#include "fcl_peer.h"
#include "input/read_mesh.h"
#include "measuring.h"
#include "medial_vk/prepare.h"
#include "medial_vk/proximity.h"

namespace {

using namespace medial_vk;
using bench::FclPeer;
using bench::longest_side;
using bench::median;
using bench::or_exit;
using bench::processor_microseconds_each;

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

/// `Answer` is DistanceBounds or Distance.
template <class Answer>
struct Query {
  Pose pose;
  Answer before;  // of a pose nearby
};

/// Of random poses those in which the solids are proved to be apart, and to be no farther apart than `side`. `ask`
/// gives the answer for a pose.
template <class Answer>
std::vector<Query<Answer>> queries(const std::function<Answer(const Pose&)>& ask, double side, std::size_t count) {
  Random random(1);
  std::uniform_real_distribution<> sides(0, 2), turn(0, 3.14159265358979);
  std::vector<Query<Answer>> out;
  while (out.size() < count) {
    // Rotations that are uniform in axis and angle only: they cover all directions of approach.
    Query<Answer> query;
    query.pose = turned(direction(random), turn(random));
    const Point to = direction(random);
    const double by = sides(random) * side;
    query.pose.shift = {by * to[0], by * to[1], by * to[2]};
    const Answer answer = ask(query.pose);
    if (answer.collision() != Collision::kFree || answer.upper > side) continue;
    Pose step = turned(direction(random), 0.0174533);
    const Point aside = direction(random);
    step.shift = {0.01 * side * aside[0], 0.01 * side * aside[1], 0.01 * side * aside[2]};
    query.before = ask(step * query.pose);
    out.push_back(query);
  }
  return out;
}

/// The median of the repeats of FCL's microseconds; 0 without FCL. It is asked for few poses, as it takes long.
class FclTimes {
 public:
  explicit FclTimes(const FclPeer& peer) : peer_(peer) {}

  template <class Queries>
  void measure(const Queries& all) {
    if (!FclPeer::is_there()) return;
    const std::size_t few = std::min<std::size_t>(all.size(), 200);
    times_.push_back(processor_microseconds_each(few, [&] {
      for (std::size_t i = 0; i < few; ++i) sum_ += peer_.distance(all[i].pose);
    }));
  }
  double median_time() const { return times_.empty() ? 0 : median(times_); }
  double sum() const { return sum_; }

 private:
  const FclPeer& peer_;
  std::vector<double> times_;
  double sum_ = 0;  // keeps the results in use
};

std::string times_as_long(double fcl, double cold, double warm) {
  return fcl > 0 ? fmt::format("{:.0f} | {:.0f} / {:.0f}", fcl, fcl / cold, fcl / warm) : " | ";
}

/// Cold and warm times of `ask(pose, start)` beside those of FCL.
template <class Answer, class Ask>
std::string times_of(const std::vector<Query<Answer>>& all, const Ask& ask, const FclPeer& peer, int repeats) {
  double sum = 0;  // keeps the results in use
  std::vector<double> cold, warm;
  FclTimes fcl(peer);
  for (int repeat = 0; repeat < repeats; ++repeat) {
    cold.push_back(processor_microseconds_each(all.size(), [&] {
      for (const auto& query : all) sum += ask(query.pose, Answer()).lower;
    }));
    warm.push_back(processor_microseconds_each(all.size(), [&] {
      for (const auto& query : all) sum += ask(query.pose, query.before).lower;
    }));
    fcl.measure(all);
  }
  if (sum + fcl.sum() < 0) std::puts("distances are not negative");
  return fmt::format("{:.2f} | {:.2f} | {}", median(cold), median(warm),
                     times_as_long(fcl.median_time(), median(cold), median(warm)));
}

void measure_bounds(const std::string& name, const Mesh& mesh, const Body& body, std::size_t poses, int repeats) {
  const double side = longest_side(mesh);
  const FclPeer peer(mesh);
  const auto ask = [&](const Pose& pose, const DistanceBounds& start) {
    return distance_bounds(body, body, pose, start);
  };
  const auto all = queries<DistanceBounds>([&](const Pose& pose) { return ask(pose, {}); }, side, poses);
  double mean_width = 0, greatest_width = 0, middle_error = 0, estimate_error = 0;
  std::size_t wrong = 0;
  const double share = 100 / side / static_cast<double>(all.size());
  for (const auto& query : all) {
    const DistanceBounds bounds = ask(query.pose, {});
    mean_width += share * (bounds.upper - bounds.lower);
    greatest_width = std::max(greatest_width, 100 * (bounds.upper - bounds.lower) / side);
    if (!FclPeer::is_there()) continue;
    const double exact = peer.distance(query.pose);
    middle_error += share * std::abs(exact - (bounds.lower + bounds.upper) / 2);
    estimate_error += share * std::abs(exact - estimated_distance(body, body, bounds));
    wrong += !(bounds.lower <= exact && exact <= bounds.upper);
  }
  fmt::print("| {} | {} | {} / {} | {:.2f} / {:.2f} | {} | {} |\n", name, mesh.triangles.size(), body.inside().size(),
             body.cover().size(), mean_width, greatest_width, times_of(all, ask, peer, repeats),
             FclPeer::is_there() ? fmt::format("{:.3f} | {:.3f} | {}", estimate_error, middle_error, wrong) : " | | ");
}

void measure_exact(const std::string& name, const Mesh& mesh, std::size_t poses, int repeats) {
  const double side = longest_side(mesh);
  const FclPeer peer(mesh);
  const IndexedMesh indexed = or_exit(IndexedMesh::build(or_exit(prepare_mesh(mesh))));
  Body body = or_exit(Body::create(indexed));
  const double building =
      1e-6 * processor_microseconds_each(1, [&] { body = or_exit(Body::create(indexed, {}, {}, {1})); });
  DistanceOptions options;
  const auto ask = [&](const Pose& pose, const Distance& start) {
    return or_exit(distance(body, body, pose, options, start));
  };
  const auto all = queries<Distance>([&](const Pose& pose) { return ask(pose, {}); }, side, poses);
  double error = 0, width = 0;
  for (const auto& query : all) {
    const Distance found = ask(query.pose, {});
    width = std::max(width, (found.upper - found.lower) / side);
    if (!FclPeer::is_there()) continue;
    const double exact = peer.distance(query.pose);
    error = std::max({error, (found.lower - exact) / side, (exact - found.upper) / side});
  }
  const std::string exact = times_of(all, ask, peer, repeats);
  options.tolerance = 1e-3 * side;
  fmt::print("| {} | {} | {:.2f} | {} | {} | {:.1e} | {:.1e} |\n", name, mesh.triangles.size(), building, exact,
             times_of(all, ask, peer, repeats), width, error);
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t poses = 2000;
  int repeats = 7;
  std::string file;
  CLI::App app("Distances of a solid and its copy in random poses, and those of FCL.");
  app.add_option("--poses", poses, "poses of the copy")->check(CLI::PositiveNumber);
  app.add_option("--repeats", repeats, "runs, of which the median counts")->check(CLI::PositiveNumber);
  app.add_option("file", file, "a mesh or a body file")->required();
  CLI11_PARSE(app, argc, argv);

  const std::size_t slash = file.rfind('/') + 1;
  const std::string name = file.substr(slash, file.find('.', slash) - slash);
  if (!is_body_file(file)) {
    measure_exact(name, or_exit(read_mesh(file)), poses, repeats);
    return 0;
  }
  const BodyFile read = or_exit(read_body_file(file));
  const IndexedMesh indexed = or_exit(
      IndexedMesh::build(or_exit(prepare_mesh(read.mesh, {.keep_inner_faces = true, .keep_outer_faces = true}))));
  measure_bounds(name, read.mesh, or_exit(Body::create(indexed, read.inside, read.cover)), poses, repeats);
}
