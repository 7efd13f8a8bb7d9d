// Thickness at all vertices: widths of the intervals and times, beside methods without a bound. Prints rows of a
// markdown table; bench/run_thickness runs it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "../helpers.h"
#include "base/stopwatch.h"
#include "input/read_mesh.h"
#include "medial_vk/prepare.h"
#include "medial_vk/thickness.h"
#include "thickness_peers.h"

namespace {

using namespace medial_vk;
using bench::or_exit;

/// By the clock, and of the processor.
struct Times {
  std::vector<double> clock, processor;

  template <class Work>
  void add(const Work& work) {
    Stopwatch watch;
    const std::clock_t begin = std::clock();
    work();
    clock.push_back(watch.lap());
    processor.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
};

struct Widths {
  double median = 0;   // percent of the lower end
  double useless = 0;  // percent of the vertices, with an interval wider than a tenth
};

Widths widths_of(const std::vector<Thickness>& found) {
  std::vector<double> widths;
  widths.reserve(found.size());
  for (const Thickness& at : found) {
    widths.push_back(at.diameter.lower > 0 ? 100 * (at.diameter.upper / at.diameter.lower - 1) : 100);
  }
  const auto useless = std::ranges::count_if(widths, [](double width) { return width > 10; });
  return {bench::median(widths), 100 * static_cast<double>(useless) / static_cast<double>(widths.size())};
}

std::string cell(const std::vector<double>& seconds) {
  return seconds.empty() ? "" : fmt::format("{:.2f}", bench::median(seconds));
}

void print_row(const std::string& file, const ThicknessOptions& options, int repeats) {
  const IndexedMesh mesh = or_exit(IndexedMesh::build(or_exit(prepare_mesh(or_exit(read_mesh(file))))));
  const std::vector<Point>& vertices = mesh.prepared().mesh.vertices;
  std::vector<Thickness> found;
  Times ours, shrinking, shape;
  bool has_shape = false;
  for (int i = 0; i < repeats; ++i) {
    ours.add([&] { found = or_exit(measure_thickness(mesh, vertices, options)); });
    shrinking.add([&] { bench::shrinking_balls(mesh); });
    shape.add([&] { has_shape = !bench::shape_diameters(mesh).empty(); });
  }
  const Widths widths = widths_of(found);
  fmt::print("| {} | {} | {} | {:.1f} | {:.1f} | {} | {} | {} | {} |\n", file.substr(file.rfind('/') + 1),
             mesh.prepared().mesh.triangles.size(), vertices.size(), widths.median, widths.useless, cell(ours.clock),
             cell(ours.processor), cell(shrinking.processor), has_shape ? cell(shape.processor) : "");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Thickness at all vertices of meshes: widths and times, beside shrinking balls and shape diameters.");
  ThicknessOptions options;
  std::vector<std::string> files;
  int repeats = 3;
  bool gaps = false;
  app.add_option("--width", options.width, "of the intervals, relative");
  app.add_option("--delta", options.delta, "how close balls come, in mesh units; 0: by default");
  app.add_option("--threads", options.threads, "of the host, 0: all");
  app.add_option("--repeats", repeats, "runs, of which the median counts")->check(CLI::PositiveNumber);
  app.add_flag("--gaps", gaps, "gaps outside instead of walls");
  app.add_option("file", files, "meshes")->required();
  CLI11_PARSE(app, argc, argv);
  if (gaps) options.side = ThicknessSide::kGaps;
  fmt::print(
      "| mesh | triangles | vertices | width, % | wider than a tenth, % | s | of the processor, s | shrinking balls, s "
      "| "
      "CGAL's shape diameters, s |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& file : files) print_row(file, options, repeats);
}
