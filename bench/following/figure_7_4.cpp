// The experiment of the source's Figure 7-4 on generated sequences: rows of a table.
//   bench_figure_7_4 [--resolution N] [--repeats N] [--threads N] [--write FOLDER]
// All medial spheres of a rest pose are updated to three poses, from the rest pose each time. For the published rule
// and for the default one: the time of the update as a share of that of the extraction at rest, and the range of the
// volume error, in percent of the solid's volume; the default rule's balls are inside, so that it has one number.
// --write: the meshes, as FOLDER/NAME-POSE.obj.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "../helpers.h"
#include "medial_vk/certify.h"
#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/follower.h"
#include "medial_vk/prepare.h"
#include "sequences.h"
#include "share_outside.h"
#include "support/solids/mesh_files.h"

namespace {

using namespace medial_vk;
using namespace medial_vk::bench;

template <class Work>
double milliseconds(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

struct Spheres {
  std::vector<Ball> balls;
  double ms;  ///< Of a search; the first, in which a driver translates the programs, does not count.
};
Spheres spheres_of(const IndexedMesh& mesh, int resolution, int repeats, Context& context) {
  ExtractionOptions options;
  options.resolution = resolution;
  Spheres result;
  for (const MedialSphere& s : or_exit(extract_and_certify(mesh, options, context)).extraction.spheres) {
    result.balls.push_back({s.centre, s.radius});
  }
  std::vector<double> times;
  for (int i = 0; i < repeats; ++i) {
    times.push_back(milliseconds([&] { or_exit(extract_medial_spheres(mesh, options, context)); }));
  }
  result.ms = median(times);
  return result;
}

/// To a pose; errors in percent of the solid's volume.
struct Update {
  double ms, least_error, greatest_error;
  double outside;  ///< The share outside the solid, from samples.
};
std::vector<Update> updates(const IndexedMesh& mesh, const Sequence& sequence, const std::vector<Ball>& balls,
                            const FollowerOptions& options, int repeats) {
  Follower follower = or_exit(Follower::create(mesh, balls, options));
  std::vector<std::vector<Point>> poses = {sequence.rest.vertices};
  poses.insert(poses.end(), sequence.poses.begin(), sequence.poses.end());
  std::vector<Update> result;
  for (const std::vector<Point>& pose : poses) {
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) {
      exit_unless(follower.reset());
      times.push_back(milliseconds([&] { exit_unless(follower.update(pose)); }));
    }
    const FollowMeasures measures = or_exit(follower.measure());
    const double percent = 100 / measures.solid_volume, uncovered = measures.uncovered();
    const bool may_reach_out = options.rule == FollowRule::kPublished;
    const double protrusion = options.protrusion * mesh.longest_side();
    const double outside = may_reach_out ? share_outside(mesh, pose, follower.balls(), protrusion).percent : 0;
    // Lemmas 7.1 and 7.3.
    result.push_back(
        {median(times), percent * std::fabs(uncovered), percent * (uncovered + 2 * measures.outside_bound), outside});
  }
  return result;
}

/// Volumes are those of the solid only where no triangles cross.
void expect_no_crossings(const Sequence& sequence) {
  Mesh mesh = sequence.rest;
  for (const std::vector<Point>& pose : sequence.poses) {
    mesh.vertices = pose;
    const PreparedMesh prepared = or_exit(prepare_mesh(Mesh(mesh)));
    if (prepared.report.closed && prepared.report.cut_faces == 0) continue;
    std::fprintf(stderr, "%s: a pose with triangles that cross\n", sequence.name.c_str());
    std::exit(1);
  }
}

void run(const Sequence& sequence, int resolution, int repeats, unsigned threads, Context& context) {
  const IndexedMesh mesh = or_exit(IndexedMesh::build(or_exit(prepare_mesh(Mesh(sequence.rest)))));
  if (mesh.view().vertices.size() != sequence.rest.vertices.size()) {
    std::fprintf(stderr, "%s: a vertex is unused or there twice\n", sequence.name.c_str());
    std::exit(1);
  }
  expect_no_crossings(sequence);
  const Spheres spheres = spheres_of(mesh, resolution, repeats, context);
  FollowerOptions published, tangent;
  published.rule = FollowRule::kPublished;
  tangent.steps = 0;  // one frame from the rest pose, as the source has it
  published.threads = tangent.threads = threads;
  const std::vector<Update> before = updates(mesh, sequence, spheres.balls, published, repeats);
  const std::vector<Update> now = updates(mesh, sequence, spheres.balls, tangent, repeats);
  for (std::size_t i = 0; i < now.size(); ++i) {
    fmt::print("| {} | {} | {} | {:.0f} | {} | {:.2f} | {:.2f} to {:.2f} | {:.3f} | {:.2f} | {:.2f} |\n", sequence.name,
               mesh.view().triangles.size(), spheres.balls.size(), spheres.ms, i, 100 * before[i].ms / spheres.ms,
               before[i].least_error, before[i].greatest_error, before[i].outside, 100 * now[i].ms / spheres.ms,
               now[i].least_error);
    std::fflush(stdout);
  }
}

void write(const Sequence& sequence, const std::string& folder) {
  Mesh mesh = sequence.rest;
  for (std::size_t i = 0; i <= sequence.poses.size(); ++i) {
    if (i > 0) mesh.vertices = sequence.poses[i - 1];
    std::ofstream(fmt::format("{}/{}-{}.obj", folder, sequence.name, i)) << test::to_obj(mesh);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"The experiment of Figure 7-4"};
  int resolution = 60, repeats = 5;
  unsigned threads = 0;
  std::string folder;
  app.add_option("--resolution", resolution)->check(CLI::PositiveNumber);
  app.add_option("--repeats", repeats)->check(CLI::PositiveNumber);
  app.add_option("--threads", threads);
  app.add_option("--write", folder)->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  Context context = or_exit(Context::create());
  for (const Sequence& sequence : {horse(), knot(), octopus()}) {
    if (!folder.empty()) write(sequence, folder);
    run(sequence, resolution, repeats, threads, context);
  }
}
