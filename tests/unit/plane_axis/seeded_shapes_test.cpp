// Medial axes of seeded shapes of many kinds and scales against Boost.Polygon's Voronoi diagrams. The long run is
// bench/plane/run_comparison.
#include <gtest/gtest.h>

#include "support/plane_axis/other_diagram.h"
#include "support/plane_axis/seeded_shapes.h"

namespace medial_vk::test {
namespace {

TEST(SeededShapes, HaveTheAxesThatBoostHas) {
  ComparisonCounts all;
  std::uint64_t left_out = 0;
  for (std::uint64_t seed = 0; seed < 19 * kSeededFamilies; ++seed) {
    SCOPED_TRACE(std::string(seeded_family(seed)) + ", seed " + std::to_string(seed));
    const auto shape = seeded_shape(seed);
    if (!shape) {
      ++left_out;
      continue;
    }
    const auto other = boost_diagram(shape->integral);
    ASSERT_TRUE(other);
    std::vector<std::string> words;
    const ComparisonCounts counts = compare(shape->scaled, *other, shape->scale, 0.1, words);
    EXPECT_EQ(counts.disagreements(), 0u);
    for (const std::string& word : words) ADD_FAILURE() << word;
    all.add(counts);
  }
  EXPECT_LT(left_out, 10u);
  EXPECT_GT(all.vertices, 3000u);
  EXPECT_GT(all.edges, 5000u);
}

}  // namespace
}  // namespace medial_vk::test
