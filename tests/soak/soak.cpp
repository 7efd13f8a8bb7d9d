// Mutations without end: soak FIRST COUNT [SECONDS]. Prints a line for every fault and a summary; scripts/soak runs it.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "support/extraction.h"
#include "support/solids/mutation_check.h"

int main(int argc, char** argv) {
  using namespace medial_vk;
  if (argc < 3) {
    std::fputs("usage: soak FIRST COUNT [SECONDS]\n", stderr);
    return 2;
  }
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10), count = std::strtoull(argv[2], nullptr, 10);
  const double seconds = argc > 3 ? std::strtod(argv[3], nullptr) : 1e30;
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  Context context = test::make_context();
  std::uint64_t run = 0, rejected = 0, closed = 0, points = 0, undecided = 0, faulty = 0;
  for (; run < count && elapsed() < seconds; ++run) {
    const test::MutationOutcome outcome = test::check_mutation(context, first + run);
    rejected += outcome.rejected ? 1 : 0;
    closed += outcome.closed ? 1 : 0;
    points += outcome.points;
    undecided += outcome.undecided;
    faulty += outcome.faults.empty() ? 0 : 1;
    for (const std::string& fault : outcome.faults) fmt::print("{}: {}\n", outcome.description, fault);
    std::fflush(stdout);
  }
  fmt::print(
      "{} meshes from seed {}: {} refused as enclosing nothing or broken, {} closed and compared with the reference, "
      "{} points certified, {} voxels undecided, {} meshes with a fault, {:.0f} s\n",
      run, first, rejected, closed, points, undecided, faulty, elapsed());
  return faulty == 0 ? 0 : 1;
}
