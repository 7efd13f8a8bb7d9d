// Theorem 4.1 on random circles in random shapes: whatever Algorithm 4 misses satisfies one of its conditions, and the
// tighter ones of docs/theory.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <vector>

#include "base/parallel.h"
#include "support/plane_thesis/circle_trials.h"
#include "support/plane_thesis/random_shapes.h"

namespace {

using medial_vk::test::TrialCounts;
using medial_vk::test::TrialShape;

constexpr std::uint64_t kCirclesPerShape = 200;
constexpr std::uint64_t kStepsPerShape = 50;  // for each of the statements

TrialCounts try_shape(unsigned family, std::uint64_t seed) {
  TrialCounts counts;
  const TrialShape shape(family, seed);
  if (!shape.is_usable()) return counts;
  counts.shapes = 1;
  shape.try_circles(kCirclesPerShape, kStepsPerShape, counts);
  return counts;
}

void print_row(const std::string& name, const TrialCounts& c) {
  fmt::print("| {} | {} | {} | {} | {} | {} |", name, c.circles, c.undetermined, c.missing, c.points,
             c.against_the_flow);
  for (const auto& worst : c.worst) fmt::print(" {:.4f} |", worst.share);
  fmt::print("\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t circles = 1000000, seed = 1;
  unsigned threads = 1;
  bool shows_worst = false;
  CLI::App app("Theorem 4.1 on random circles in random shapes");
  app.add_option("--circles", circles);
  app.add_option("--seed", seed);
  app.add_option("--threads", threads);
  app.add_flag("--show-worst", shows_worst);
  CLI11_PARSE(app, argc, argv);

  constexpr unsigned kFamilies = medial_vk::test::kShapeFamilies;
  const std::uint64_t shapes = (circles + kCirclesPerShape - 1) / kCirclesPerShape;
  std::vector<TrialCounts> counts(shapes);
  medial_vk::parallel_for(shapes, 1, threads, [&](std::size_t i) {
    counts[i] = try_shape(static_cast<unsigned>(i % kFamilies), (seed << 32) + i / kFamilies);
  });
  std::array<TrialCounts, kFamilies> by_family;
  for (std::uint64_t i = 0; i < shapes; ++i) by_family[i % kFamilies].add(counts[i]);
  TrialCounts all;
  fmt::print(
      "| shapes | circles | undetermined | with missed points | missed points | with a spoke against the flow | "
      "Theorem "
      "4.1 | corollary | with the flow | against the flow |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (unsigned family = 0; family < kFamilies; ++family) {
    print_row(medial_vk::test::family_name(family), by_family[family]);
    all.add(by_family[family]);
  }
  print_row("all", all);
  if (shows_worst) {
    for (const auto& worst : all.worst) fmt::print("{:.6f} at {}\n", worst.share, worst.where);
  }
  fmt::print(
      "\ncounterexamples: {} to Theorem 4.1, {} to the corollary, {} and {} to the theorem on strips; {} points at "
      "which rounding decided about a sample\n",
      all.counterexamples[0], all.counterexamples[1], all.counterexamples[2], all.counterexamples[3], all.not_combed);
  for (const std::string& report : all.reports) fmt::print("counterexample to {}\n", report);
  return all.reports.empty() ? 0 : 1;
}
