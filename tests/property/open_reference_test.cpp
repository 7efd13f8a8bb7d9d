// The reference on meshes with holes: sides of balls and boxes by bounds on the change of the winding number.
#include <gtest/gtest.h>

#include <cmath>

#include "reference_bridge/reference_extractor.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

TEST(OpenReference, ATorusWithAHoleKeepsItsCircleElsewhere) {
  Mesh mesh = test::make_torus(0.7, 0.25, 24, 48);
  // A hole at x > 0.85 of about a tenth of the circle.
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    for (const std::uint32_t v : t) {
      if (mesh.vertices[v][0] < 0.85 || std::abs(mesh.vertices[v][1]) > 0.2) return false;
    }
    return true;
  });
  const PreparedMesh prepared = test::prepare(mesh);
  ASSERT_FALSE(prepared.report.closed);
  ExtractionOptions options;
  options.resolution = 16;
  options.extra_levels = 2;
  const auto result = extract_and_certify(test::indexed(prepared), options, reference_extractor());
  ASSERT_TRUE(result.ok()) << result.error().message;
  const Extraction& extraction = result.value().extraction;
  EXPECT_TRUE(test::passes_certificate(prepared, extraction, options));
  // Away from the hole the medial surface is the circle as before: it crosses more voxels than fit its half.
  std::size_t on_circle = 0;
  for (const MedialSphere& s : extraction.spheres) {
    if (s.centre[0] > 0) continue;
    EXPECT_LT(std::hypot(std::hypot(s.centre[0], s.centre[1]) - 0.7, s.centre[2]), 0.02);
    ++on_circle;
  }
  EXPECT_GT(static_cast<double>(on_circle), 3.14 * 0.7 / (std::sqrt(3) * extraction.grid.voxel_size));
}

}  // namespace
}  // namespace medial_vk
