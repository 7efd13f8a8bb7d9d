// Meshes of half a million and of five million triangles, from bytes to certified points.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "input/read_mesh.h"
#include "medial_vk/scene.h"
#include "support/device/device.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/mesh_files.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// A prepared torus that has passed through the reader.
PreparedMesh read_torus(std::uint32_t around, std::uint32_t along) {
  Result<Mesh> read = parse_mesh(test::to_binary_ply(test::make_torus(0.7, 0.2, around, along), false), "torus.ply");
  EXPECT_TRUE(read.ok()) << read.error().message;
  PreparedMesh mesh = test::prepare(std::move(read).value());
  EXPECT_EQ(mesh.report.triangles, 2 * around * along);
  EXPECT_EQ(mesh.report.trusted_triangles, mesh.report.triangles);
  return mesh;
}

/// Finds that the medial surface is the circle in its middle. The certified points.
CertifiedExtraction expect_circle(const PreparedMesh& mesh, const ExtractionOptions& options) {
  Context context = test::make_context();
  CertifiedExtraction result = test::extract_on_device(context, mesh, options);
  EXPECT_EQ(result.certificate.rejected, 0u);
  // Its length over the diagonal of a voxel: it crosses more than that.
  const VoxelGrid& grid = result.extraction.grid;
  EXPECT_GT(result.extraction.spheres.size(), 2 * std::numbers::pi * 0.7 / (std::sqrt(3) * grid.voxel_size));
  for (const MedialSphere& s : result.extraction.spheres) {
    const double from_axis = std::hypot(s.centre[0], s.centre[1]);
    EXPECT_LT(std::hypot(from_axis - 0.7, s.centre[2]), 0.02 * grid.voxel_size + 1e-4);
    EXPECT_NEAR(s.radius, 0.2, 0.02 * grid.voxel_size + 1e-4);
  }
  return result;
}

TEST(LargeMesh, TheCircleInATorusOfHalfAMillionTriangles) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const PreparedMesh mesh = read_torus(350, 716);
  ExtractionOptions options;
  options.resolution = 20;
  const CertifiedExtraction result = expect_circle(mesh, options);
  EXPECT_TRUE(test::passes_certificate(mesh, result.extraction, options));
}

// Everything but the extraction, so that it can run with all other tests: bytes, preparation, tree, queries.
TEST(LargeMesh, DistancesToATorusOfFiveMillionTriangles) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const PreparedMesh mesh = read_torus(1250, 2000);
  Context context = test::make_context();
  Result<Scene> scene = test::make_scene(context, mesh.view());
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  std::vector<Point> points;
  for (int i = 0; i < 1000; ++i) points.push_back({std::sin(0.37 * i), std::cos(0.61 * i), 0.4 * std::sin(0.83 * i)});
  const auto nearest = scene.value().closest_points(points);
  const auto winding = scene.value().winding_numbers(points);
  ASSERT_TRUE(nearest.ok() && winding.ok());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [x, y, z] = points[i];
    const double depth = 0.2 - std::hypot(std::hypot(x, y) - 0.7, z);
    // Facets of 0.004 by 0.001 sag by 2e-6 of a circle of 0.9; floats in the unit box are 2e-6 of 1.8 off.
    EXPECT_NEAR(nearest.value()[i].distance, std::fabs(depth), 1e-5);
    if (std::fabs(depth) > 1e-3) {
      EXPECT_NEAR(winding.value()[i], depth > 0 ? 1 : 0, 0.05);  // as documented
    }
  }
}

// Minutes, so it has the label `full`. (At a low resolution the lists of triangles are long: slower, not faster.)
TEST(LargeMesh, TheCircleInATorusOfFiveMillionTriangles) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  ExtractionOptions options;
  options.resolution = 80;
  expect_circle(read_torus(1250, 2000), options);
}

}  // namespace
}  // namespace medial_vk
