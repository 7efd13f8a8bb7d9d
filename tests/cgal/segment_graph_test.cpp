// Medial axes in the plane against CGAL's segment Delaunay graph. The long run is bench/plane/run_comparison --cgal.
#include "cgal/segment_graph.h"

#include <gtest/gtest.h>

#include "support/plane_axis/seeded_shapes.h"

namespace medial_vk::test {
namespace {

TEST(SegmentGraph, HasTheSameVerticesAndEdges) {
  ComparisonCounts all;
  for (std::uint64_t seed = 0; seed < 19 * kSeededFamilies; ++seed) {
    SCOPED_TRACE(std::string(seeded_family(seed)) + ", seed " + std::to_string(seed));
    const auto shape = seeded_shape(seed);
    if (!shape) continue;
    std::vector<std::string> words;
    const OtherDiagram other = cgal_diagram(shape->integral);
    const ComparisonCounts counts = compare(shape->scaled, other, shape->scale, 0.1, words);
    EXPECT_EQ(counts.disagreements(), 0u);
    for (const std::string& word : words) ADD_FAILURE() << word;
    all.add(counts);
  }
  EXPECT_GT(all.vertices, 3000u);
  EXPECT_GT(all.edges, 5000u);
}

}  // namespace
}  // namespace medial_vk::test
