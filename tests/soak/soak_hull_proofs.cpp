// Proofs of hulls of balls against what is known without them: soak_hull_proofs FIRST COUNT. COUNT solids, for the
// seeds from FIRST on; for each 250 hulls that stick out, none of which may be proved, and 250 that lie inside. Prints
// a line for every fault, and a summary. The exit code is 1 if a hull that sticks out is proved, or if fewer than 99.9
// % of those inside are.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include "medial_vk/hull_proofs.h"
#include "medial_vk/prepare.h"
#include "support/hulls/known_hulls.h"
#include "support/indexed.h"

int main(int argc, char** argv) {
  using namespace medial_vk;
  if (argc != 3) {
    fmt::print(stderr, "usage: soak_hull_proofs FIRST COUNT\n");
    return 2;
  }
  constexpr int kHulls = 250;
  const std::uint64_t from = std::strtoull(argv[1], nullptr, 10), count = std::strtoull(argv[2], nullptr, 10);
  std::uint64_t outside = 0, proved_outside = 0, inside = 0, not_proved = 0, triangles = 0, planes = 0;
  double greatest_lack = 0;
  for (std::uint64_t seed = from; seed < from + count; ++seed) {
    const test::KnownSolid solid(seed);
    const IndexedMesh mesh = test::indexed(prepare_mesh(solid.mesh()).value());
    std::mt19937_64 random(~seed);
    triangles += solid.mesh().triangles.size();
    std::vector<BallHull> out, in;
    for (int i = 0; i < kHulls; ++i) {
      out.push_back(solid.outside(random));
      in.push_back(solid.inside(random));
    }
    const HullProof refused = prove_hulls(mesh, out).value(), proof = prove_hulls(mesh, in).value();
    outside += refused.tested;
    inside += proof.tested;
    planes += proof.planes;
    not_proved += proof.failed;
    proved_outside += refused.tested - refused.failed;
    greatest_lack = std::max(greatest_lack, proof.greatest_lack / mesh.longest_side());
    if (refused.failed != refused.tested) {
      for (std::size_t i = 0; i < out.size(); ++i) {
        if (prove_hulls(mesh, {&out[i], 1}).value().proved()) fmt::print("fault: seed {}, hull {}\n", seed, i);
      }
    }
    if (!proof.proved()) {
      fmt::print("not proved: seed {}: {}, first hull {}, lack {:.3g} of the longest side\n", seed, proof.failed,
                 proof.first_failure, proof.greatest_lack / mesh.longest_side());
    }
  }
  fmt::print(
      "{} solids of {:.0f} triangles on average\n"
      "{} hulls that stick out by {:g} of the longest side or more: {} proved\n"
      "{} hulls inside with that distance or more: {} not proved, by a lack of at most {:.3g}; {:.1f} planes a hull\n",
      count, static_cast<double>(triangles) / static_cast<double>(count), outside, test::KnownSolid::kLeast,
      proved_outside, inside, not_proved, greatest_lack, static_cast<double>(planes) / static_cast<double>(inside));
  return proved_outside == 0 && static_cast<double>(not_proved) <= 1e-3 * static_cast<double>(inside) ? 0 : 1;
}
