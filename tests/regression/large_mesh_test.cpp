// Half a million triangles, from bytes to certified points. Larger ones by hand: docs/reliability.md.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/load_mesh.h"
#include "support/device.h"
#include "support/extraction.h"
#include "support/mesh_files.h"
#include "support/solids.h"

namespace medial_vk {
namespace {

TEST(LargeMesh, TheCircleInATorusOfHalfAMillionTriangles) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Result<Mesh> read = parse_mesh(test::to_binary_ply(test::make_torus(0.7, 0.2, 350, 716), false), "torus.ply");
  ASSERT_TRUE(read.ok()) << read.error().message;
  const PreparedMesh mesh = test::prepare(std::move(read).value());
  EXPECT_EQ(mesh.report.triangles, 501'200u);
  EXPECT_EQ(mesh.report.trusted_triangles, mesh.report.triangles);
  ExtractionParameters parameters;
  parameters.resolution = 20;
  Context context = test::make_context();
  const CertifiedExtraction result = test::extract_on_device(context, mesh, parameters);
  EXPECT_EQ(result.certify.rejected, 0u);
  // The medial surface is the circle. Its length over the diagonal of a voxel: it crosses more than that.
  const VoxelGrid& grid = result.extraction.grid;
  EXPECT_GT(result.extraction.spheres.size(), 2 * std::numbers::pi * 0.7 / (std::sqrt(3) * grid.voxel_size));
  for (const MedialSphere& s : result.extraction.spheres) {
    const double from_axis = std::hypot(s.centre[0], s.centre[1]);
    EXPECT_LT(std::hypot(from_axis - 0.7, s.centre[2]), 0.02 * grid.voxel_size + 1e-4);
    EXPECT_NEAR(s.radius, 0.2, 0.02 * grid.voxel_size + 1e-4);
  }
  EXPECT_TRUE(test::passes_certificate(mesh, result.extraction, parameters));
}

}  // namespace
}  // namespace medial_vk
