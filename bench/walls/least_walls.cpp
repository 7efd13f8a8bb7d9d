// Least walls of meshes, or of generated solids: intervals, cells and times. Prints rows of a markdown table;
// bench/run_least_walls runs it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include "../helpers.h"
#include "base/point_ops.h"
#include "base/stopwatch.h"
#include "input/read_mesh.h"
#include "medial_vk/least_wall.h"
#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace {

using namespace medial_vk;
using bench::or_exit;

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

/// Axis z, from 0 to `length`: the radii are those of the corners of regular polygons.
Mesh make_pipe(double outer, double inner, double length, std::uint32_t sides) {
  Mesh mesh;
  mesh.vertices.reserve(std::size_t{4} * sides);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double turn = 2 * std::numbers::pi * i / sides, x = std::cos(turn), y = std::sin(turn);
    for (const double z : {0.0, length}) {
      for (const double radius : {outer, inner}) mesh.vertices.push_back({radius * x, radius * y, z});
    }
  }
  // A strip of quadrangles between two corners of the section and the next ones around.
  constexpr std::array<std::array<std::uint32_t, 2>, 4> kStrips = {{{0, 2}, {2, 3}, {3, 1}, {1, 0}}};
  mesh.triangles.reserve(std::size_t{8} * sides);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t here = 4 * i, next = 4 * ((i + 1) % sides);
    for (const auto& [a, b] : kStrips) {
      mesh.triangles.push_back({here + a, next + a, next + b});
      mesh.triangles.push_back({here + a, next + b, here + b});
    }
  }
  return mesh;
}

Mesh turned(Mesh mesh) {
  test::rotate(mesh, {1, 2, 3}, 0.7);
  return mesh;
}

/// Turned, so that no face is parallel to the cells.
std::vector<NamedMesh> generated_solids() {
  return {{"plate", turned(test::make_box({1, 0.02, 0.5}))},
          {"plate with a hole", turned(test::make_plate_with_hole(1, 0.05, 0.3))},
          {"L", turned(test::make_l_shape(1, 0.1, 0.3))},
          {"cup, 24 sides", turned(test::make_cup(0.5, 0.05, 0.4, 24))},
          {"pipe, 24 sides", turned(make_pipe(0.5, 0.45, 1, 24))},
          {"torus", test::make_turned_torus(60, 30)},
          {"flat ellipsoid", turned(test::make_ellipsoid({1, 0.8, 0.2}, 60))}};
}

/// Four digits of an end of an interval: no number above x for a step of -1, none below it for 1.
std::string rounded_outward(double x, int step) {
  std::string nearest = fmt::format("{:.4g}", x);
  const double read = std::strtod(nearest.c_str(), nullptr);
  if (step * read >= step * x) return nearest;
  return fmt::format("{:.4g}", read + step * std::pow(10, std::floor(std::log10(x)) - 3));
}

void print_row(const NamedMesh& solid, const LeastWallOptions& options, int repeats) {
  const IndexedMesh mesh = or_exit(IndexedMesh::build(or_exit(prepare_mesh(solid.mesh))));
  std::vector<double> seconds, of_processor;
  seconds.reserve(static_cast<std::size_t>(repeats));
  of_processor.reserve(static_cast<std::size_t>(repeats));
  LeastWall wall;
  for (int i = 0; i < repeats; ++i) {
    Stopwatch watch;
    const std::clock_t begin = std::clock();
    wall = or_exit(measure_least_wall(mesh, options));
    seconds.push_back(watch.lap());
    of_processor.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  const Bounds& diameter = wall.diameter;
  fmt::print("| {} | {} | {:.3f} | {} to {} | {:.2f} | {} | {:.2f} | {:.2f} |\n", solid.name,
             mesh.prepared().mesh.triangles.size(), mesh.longest_side(), rounded_outward(diameter.lower, -1),
             rounded_outward(diameter.upper, 1), 100 * (diameter.upper / diameter.lower - 1), wall.cells,
             bench::median(seconds), bench::median(of_processor));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Least walls: intervals, cells and times. Without a mesh, of generated solids.");
  LeastWallOptions options;
  std::vector<std::string> files;
  int repeats = 1;
  bool gaps = false;
  app.add_option("--object-angle", options.object_angle, "of the balls, radians, at least");
  app.add_option("--width", options.width, "of the intervals, relative");
  app.add_option("--limit", options.limit, "thicker walls are not searched for; 0: the longest side");
  app.add_option("--cells", options.cells, "that may be examined");
  app.add_option("--threads", options.threads, "of the host, 0: all");
  app.add_option("--repeats", repeats, "runs, of which the median counts")->check(CLI::PositiveNumber);
  app.add_flag("--gaps", gaps, "the narrowest gap outside instead");
  app.add_option("file", files, "meshes");
  CLI11_PARSE(app, argc, argv);
  if (gaps) options.side = ThicknessSide::kGaps;
  std::vector<NamedMesh> solids;
  if (files.empty()) solids = generated_solids();
  solids.reserve(solids.size() + files.size());
  for (const std::string& file : files) solids.push_back({file.substr(file.rfind('/') + 1), or_exit(read_mesh(file))});
  fmt::print(
      "| mesh | triangles | longest side | {} | width, % | cells | s | of the processor, s "
      "|\n|---|---|---|---|---|---|---|---|\n",
      gaps ? "least gap" : "least wall");
  for (const NamedMesh& solid : solids) print_row(solid, options, repeats);
}
