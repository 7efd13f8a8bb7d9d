// Medial axes of seeded shapes in the plane against Voronoi diagrams by Boost.Polygon and CGAL: a markdown table, and
// each disagreement.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "support/plane_axis/other_diagram.h"
#include "support/plane_axis/seeded_shapes.h"

#ifdef MEDIAL_VK_HAVE_CGAL
#include "cgal/segment_graph.h"
#endif

namespace medial_vk::bench {
namespace {

using test::ComparisonCounts, test::kSeededFamilies, test::OtherDiagram, test::SeededShape;

std::optional<OtherDiagram> diagram_of(const SeededShape& shape, bool by_cgal) {
  if (!by_cgal) return test::boost_diagram(shape.integral);
#ifdef MEDIAL_VK_HAVE_CGAL
  return test::cgal_diagram(shape.integral);
#else
  return {};
#endif
}

struct Trial {
  ComparisonCounts counts;
  std::vector<std::string> words;
  bool is_compared = false;
};

/// Whether nothing disagrees.
bool print_table(const char* name, std::uint64_t shapes, bool by_cgal, double object_angle, unsigned threads) {
  std::vector<Trial> trials(shapes);
  parallel_for(shapes, 1, threads, [&](std::size_t seed) {
    const auto shape = test::seeded_shape(seed);
    if (!shape) return;
    const auto other = diagram_of(*shape, by_cgal);
    if (!other) return;
    trials[seed].is_compared = true;
    trials[seed].counts = test::compare(shape->scaled, *other, shape->scale, object_angle, trials[seed].words);
  });
  std::array<ComparisonCounts, kSeededFamilies + 1> rows;
  for (std::uint64_t seed = 0; seed < shapes; ++seed) {
    rows[seed % kSeededFamilies].add(trials[seed].counts);
    rows[kSeededFamilies].add(trials[seed].counts);
    for (const std::string& word : trials[seed].words) fmt::print(stderr, "{}, seed {}: {}\n", name, seed, word);
  }
  if (rows.back().shapes == 0) return fmt::print("{} is not installed\n\n", name), true;
  fmt::print(
      "| {} | shapes | segments | nodes | arcs | vertices compared | edges compared | left to rounding | missed | "
      "not there | farthest |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
      name);
  for (std::uint64_t family = 0; family < rows.size(); ++family) {
    const ComparisonCounts& c = rows[family];
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {:.1e} |\n",
               family == kSeededFamilies ? "all" : test::seeded_family(family), c.shapes, c.segments, c.nodes, c.arcs,
               c.vertices, c.edges, c.slides, c.missed_vertices + c.missed_edges + c.missed_nodes,
               c.unknown_nodes + c.wrong_arcs, c.farthest);
  }
  fmt::print("\nvertices and edges of {} that something is nearer to: {}\n\n", name, rows.back().other_is_wrong);
  return rows.back().disagreements() == 0;
}

int run(int count, char** arguments) {
  std::uint64_t shapes = 10000;
  unsigned threads = 0;
  double object_angle = 0.1;
  CLI::App app("Medial axes of seeded shapes in the plane against Boost.Polygon and CGAL.");
  app.add_option("--shapes", shapes);
  app.add_option("--threads", threads);
  app.add_option("--object-angle", object_angle, "radians");
  CLI11_PARSE(app, count, arguments);
  const bool boost = print_table("Boost.Polygon", shapes, false, object_angle, threads);
  const bool cgal = print_table("CGAL", shapes, true, object_angle, threads);
  return boost && cgal ? 0 : 1;
}

}  // namespace
}  // namespace medial_vk::bench

int main(int count, char** arguments) { return medial_vk::bench::run(count, arguments); }
