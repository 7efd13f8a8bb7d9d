// Next to the reflex edge of an L, a face and an edge lie almost in one plane as seen from the middle sheet: the
// device's float selected the wrong one as the second contact, the certificate dropped the ball, and a voxel whose
// sheet has an object angle of 1.54 stayed without a point. Such balls are narrowed again in double.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/device/device.h"
#include "support/extraction.h"
#include "support/solids/solid_catalogue.h"

namespace medial_vk {
namespace {

TEST(MendedBall, VoxelNextToAReflexEdgeKeepsItsPoint) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const auto& solids = test::analytic_solids();
  const auto solid = std::find_if(solids.begin(), solids.end(), [](const auto& s) { return s.name == "l-shape"; });
  ASSERT_NE(solid, solids.end());
  const PreparedMesh mesh = test::prepare(solid->make());
  ExtractionOptions options;
  options.resolution = 160;
  options.object_angle = 0.9;
  Context context = test::make_context();
  const CertifiedExtraction result = test::extract_on_device(context, mesh, options);
  EXPECT_EQ(result.certificate.rejected, 0u);
  const std::array<std::uint32_t, 3> voxel = {61, 44, 59};
  const auto& spheres = result.extraction.spheres;
  EXPECT_TRUE(std::any_of(spheres.begin(), spheres.end(), [&](const MedialSphere& s) { return s.voxel == voxel; }));
  EXPECT_TRUE(test::passes_certificate(mesh, result.extraction, options));
}

}  // namespace
}  // namespace medial_vk
