// Devices may round divisions, roots and angles otherwise than lavapipe. Kernels whose SPIR-V is rewritten so that
// these are off by what Vulkan allows still prove and find the same: slacks are made for that (docs/theory.md,
// "Rounding").
#include "support/other_rounding.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "context_impl.h"
#include "embedded_shaders.h"
#include "support/device.h"
#include "support/extraction.h"
#include "support/solids.h"

namespace medial_vk {
namespace {

// All kernels of the runtime, rewritten.
class OtherKernels {
 public:
  explicit OtherKernels(const test::OtherRounding& rounding) {
    for (const EmbeddedShader& shader : embedded_shaders())
      words_.push_back(test::round_otherwise(shader.words, rounding));
    for (std::size_t i = 0; i < words_.size(); ++i) shaders_.push_back({embedded_shaders()[i].name, words_[i]});
  }
  std::span<const EmbeddedShader> shaders() const { return shaders_; }

 private:
  std::vector<std::vector<std::uint32_t>> words_;
  std::vector<EmbeddedShader> shaders_;
};

// Clearly salient points of `here` in voxels that `there` has dismissed. (A point nearer to a face, or to the
// threshold, may stand for a medial point in the next voxel, or for one below the threshold.)
std::size_t count_lost(const Extraction& here, const Extraction& there, const ExtractionParameters& parameters) {
  std::set<std::array<std::uint32_t, 3>> kept;
  for (const MedialSphere& s : there.spheres) kept.insert(s.voxel);
  for (const UndecidedVoxel& u : there.undecided) kept.insert(u.voxel);
  std::size_t lost = 0;
  for (const MedialSphere& s : here.spheres) {
    const bool clear = static_cast<double>(s.object_angle) >= parameters.object_angle + 0.05 &&
                       test::depth_in_voxel(here.grid, test::to_eigen(s.centre)) >= 0.05;
    lost += clear && !kept.contains(s.voxel);
  }
  return lost;
}

bool same_bytes(const Extraction& a, const Extraction& b) {
  return a.spheres.size() == b.spheres.size() &&
         std::memcmp(a.spheres.data(), b.spheres.data(), a.spheres.size() * sizeof(MedialSphere)) == 0;
}

class OtherRoundingTest : public testing::TestWithParam<float> {
 protected:
  // Division: 2.5 units in the last place. Roots: those of 1 / inversesqrt, 2 more. Angles: 4,096.
  test::OtherRounding rounding() const { return {GetParam() * 2.4e-7f, GetParam() * 4e-7f, GetParam() * 2.4e-4f}; }

  void expect_the_same(Mesh solid, std::uint32_t resolution) {
    const PreparedMesh mesh = test::prepare(std::move(solid));
    ExtractionParameters parameters;
    parameters.resolution = resolution;
    Context context = test::make_context();
    const Extraction plain = test::extract_on_device(context, mesh, parameters).extraction;
    const OtherKernels kernels(rounding());
    Context other_context = test::make_context();
    other_context.impl().extra_shaders = kernels.shaders();
    const CertifiedExtraction other = test::extract_on_device(other_context, mesh, parameters);
    EXPECT_GT(plain.spheres.size(), 500u);
    EXPECT_FALSE(same_bytes(plain, other.extraction)) << "the kernels round as they did";
    EXPECT_TRUE(test::passes_certificate(mesh, other.extraction, parameters));
    EXPECT_LE(other.certify.rejected, plain.spheres.size() / 100);
    EXPECT_EQ(count_lost(plain, other.extraction, parameters), 0u);
    EXPECT_EQ(count_lost(other.extraction, plain, parameters), 0u);
    // No more voxels stay undecided than a handful at thresholds.
    EXPECT_LE(other.extraction.undecided.size(), plain.undecided.size() + plain.spheres.size() / 100);
  }
};

TEST_P(OtherRoundingTest, ASolidWithCorners) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh solid = test::make_l_shape(1.0, 0.4, 0.5);
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  expect_the_same(std::move(solid), 30);
}

TEST_P(OtherRoundingTest, ARoundSolidOfSmallTriangles) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh solid = test::make_torus(1.0, 0.4, 80, 160, 0.5);
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  expect_the_same(std::move(solid), 65);
}

TEST_P(OtherRoundingTest, AnOpenMesh) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh solid = test::make_torus(1.0, 0.4, 24, 48, 0.5);
  solid.triangles.resize(solid.triangles.size() - 40);
  expect_the_same(std::move(solid), 33);
}

INSTANTIATE_TEST_SUITE_P(BothWays, OtherRoundingTest, testing::Values(1.0f, -1.0f),
                         [](const auto& sign) { return sign.param > 0 ? "larger" : "smaller"; });

}  // namespace
}  // namespace medial_vk
