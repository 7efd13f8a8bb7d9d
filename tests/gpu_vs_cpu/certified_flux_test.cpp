// The flux that certified mode stores with every point, against the reference at the same samples in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cpu_reference/queries.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr int kFluxSamples = 48;  // as in shaders/shared/types/gpu_types.h

// The samples of shaders/shared/certified/flux_samples.glsl, written again: the golden angle, heights at the middles of
// N equal parts.
std::vector<Eigen::Vector3d> golden_spiral() {
  std::vector<Eigen::Vector3d> directions;
  const double golden_angle = std::acos(-1.0) * (3 - std::sqrt(5.0));
  for (int k = 0; k < kFluxSamples; ++k) {
    const double h = (2.0 * k + 1) / kFluxSamples - 1;
    const double r = std::sqrt(1 - h * h);
    directions.emplace_back(r * std::cos(k * golden_angle), r * std::sin(k * golden_angle), h);
  }
  return directions;
}

void expect_flux_agrees(Mesh solid, std::uint32_t resolution = 33, std::uint64_t memory_budget = 1ull << 30) {
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  const PreparedMesh mesh = test::prepare(std::move(solid));
  ExtractionOptions options;
  options.resolution = resolution;
  options.memory_budget = memory_budget;
  Context& context = test::quick_device();
  const Extraction extraction = test::extract_on_device(context, mesh, options).extraction;
  ASSERT_FALSE(extraction.spheres.empty());
  const reference::Tree tree(test::to_reference(mesh.mesh));
  const std::vector<Eigen::Vector3d> directions = golden_spiral();
  // A sample whose direction is accurate to 1e-3 (float, near-ties of neighbouring features) changes the average by no
  // more than that. A sample within rounding of the medial surface, or of the edge of a fan, may see the other side: it
  // changes the sum by at most 2, and the number of samples by one. This concerns few samples of few voxels.
  const double same = 1e-3, one_sample = 3.0 / kFluxSamples;
  std::size_t off = 0;
  for (const MedialSphere& s : extraction.spheres) {
    Eigen::Vector3d centre;
    for (int a = 0; a < 3; ++a) centre[a] = extraction.grid.origin[a] + (s.voxel[a] + 0.5) * extraction.grid.voxel_size;
    const reference::Flux flux =
        reference::outward_flux(tree, centre, extraction.grid.voxel_size, directions, std::sqrt(2e-6));
    const double difference = std::abs(flux.average - static_cast<double>(s.flux));
    off += difference > same ? 1 : 0;
    EXPECT_LE(difference, 4 * one_sample);
  }
  EXPECT_LE(off, extraction.spheres.size() / 20) << "of " << extraction.spheres.size();
}

TEST(CertifiedFlux, OfABox) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_flux_agrees(test::make_box({1, 0.8, 0.6}));
}

// Flux is measured block by block: with this little memory a block has some 1,400 points, and there are 5,143. The
// inner wall of a cup is hollow, so that opposites are queried there.
TEST(CertifiedFlux, OfSeveralBlocks) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_flux_agrees(test::make_cup(0.5, 0.12, 1.0, 32), 40, 40ull << 20);
}

TEST(CertifiedFlux, OfAnEllipsoid) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_flux_agrees(test::make_ellipsoid({1, 1, 0.5}, 40));
}

}  // namespace
}  // namespace medial_vk
