// Faulty meshes: seeded mutations of clean solids. scripts/soak continues with other seeds for an arbitrary time.
#include <gtest/gtest.h>

#include "support/device/device.h"
#include "support/extraction.h"
#include "support/solids/mutation_check.h"
#include "support/solids/mutations.h"

namespace medial_vk {
namespace {

// The seeds form groups that run in parallel. All 17 mutations come first in turn, with a dozen solids each.
constexpr std::uint64_t kGroups = 4, kPerGroup = 51;

class Mutations : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Mutations, AreRefusedOrCertifiedAndAgreeWithTheReference) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Context context = test::make_context();
  std::uint64_t rejected = 0, points = 0;
  for (std::uint64_t seed = GetParam() * kPerGroup; seed < (GetParam() + 1) * kPerGroup; ++seed) {
    const test::MutationOutcome outcome = test::check_mutation(context, seed);
    for (const std::string& fault : outcome.faults) ADD_FAILURE() << outcome.description << ": " << fault;
    rejected += outcome.rejected ? 1 : 0;
    points += outcome.points;
  }
  // The generator makes meshes that enclose something, nearly always.
  EXPECT_LT(rejected, kPerGroup / 4);
  EXPECT_GT(points, kPerGroup * 10);
}

INSTANTIATE_TEST_SUITE_P(, Mutations, testing::Range(std::uint64_t{0}, kGroups));

TEST(MutationGenerator, GoesThroughAllMutationsAndIsSeeded) {
  for (std::uint64_t seed = 0; seed < test::mutation_count(); ++seed) {
    const test::Mutation a = test::make_mutation(seed), b = test::make_mutation(seed);
    EXPECT_EQ(a.description, b.description);
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  }
}

}  // namespace
}  // namespace medial_vk
