// Figures of many overlapping and open parts, as artists make them: extracted in bounded time and memory, certified,
// with few undecided voxels.
#include <gtest/gtest.h>

#include "support/device/device.h"
#include "support/extraction.h"
#include "support/solids/assembly.h"

namespace medial_vk {
namespace {

/// Undecided voxels over those that are found or undecided.
double undecided_share(const Extraction& extraction) {
  const double undecided = static_cast<double>(extraction.undecided.size());
  return undecided / (undecided + static_cast<double>(extraction.spheres.size()));
}

struct Outcome {
  PreparedMesh mesh;
  CertifiedExtraction result;
};

Outcome extract(const test::AssemblyOptions& assembly, std::uint32_t resolution) {
  Outcome outcome;
  outcome.mesh = test::prepare(test::make_assembly(assembly));
  ExtractionOptions options;
  options.resolution = resolution;
  Context context = test::make_context();
  outcome.result = test::extract_on_device(context, outcome.mesh, options);
  EXPECT_TRUE(test::passes_certificate(outcome.mesh, outcome.result.extraction, options));
  return outcome;
}

TEST(Assembly, IsCutToOneBoundary) {
  const PreparedMesh mesh = test::prepare(test::make_assembly({.fineness = 0.3}));
  const MeshReport& report = mesh.report;
  EXPECT_GT(report.cut_faces, 1000u);
  EXPECT_GT(report.inner_faces, report.triangles / 4);
  EXPECT_LT(report.faces_within + report.faces_without, report.triangles / 20);
  EXPECT_LT(report.components, 44u / 2);
  EXPECT_EQ(report.hidden_open_edges, 2u * 15u);  // of the right sleeve
  EXPECT_GT(report.trusted_triangles, report.triangles * 9 / 10);
}

TEST(Assembly, HasFewUndecidedVoxels) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Outcome outcome = extract({.fineness = 0.3}, 80);
  EXPECT_GT(outcome.result.extraction.spheres.size(), 3000u);
  EXPECT_LT(undecided_share(outcome.result.extraction), 0.02);
}

TEST(Assembly, OfSheetsExtracts) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const Outcome outcome = extract({.fineness = 0.3, .has_sheets = true}, 24);
  EXPECT_GT(outcome.mesh.report.open_edges, 500u);
  EXPECT_GT(outcome.result.extraction.spheres.size(), 300u);
}

TEST(Assembly, OfHalfAMillionTrianglesExtracts) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const test::AssemblyOptions assembly = {.fineness = 1.72};
  ASSERT_GT(test::make_assembly(assembly).triangles.size(), 500'000u);
  EXPECT_GT(extract(assembly, 100).result.extraction.spheres.size(), 3000u);
}

}  // namespace
}  // namespace medial_vk
