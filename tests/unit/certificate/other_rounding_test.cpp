// Devices may round divisions, roots and angles differently from lavapipe, and need not support denormal numbers,
// infinities, NaN and signed zeros. Kernels whose SPIR-V is rewritten so that results have the errors that Vulkan
// allows, or so that these numbers do not occur, still prove and find the same: slacks account for the former
// (docs/theory.md, "Rounding"), and nothing may depend on the latter.
#include "support/other_rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "device/context_impl.h"
#include "device/embedded_shaders.h"
#include "device_commands/commands.h"
#include "device_commands/recorder.h"
#include "make_specials_spirv.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/device/other_kernels.h"
#include "support/extraction.h"
#include "support/other_specials.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using test::OtherKernels;
using test::Rewrite;

// Clearly salient points of `here` in voxels that `there` has dismissed. (A point nearer to a face, or to the
// threshold, may represent a medial point in the next voxel, or one below the threshold.)
std::size_t count_lost(const Extraction& here, const Extraction& there, const ExtractionOptions& options) {
  std::set<std::array<std::uint32_t, 3>> kept;
  for (const MedialSphere& s : there.spheres) kept.insert(s.voxel);
  for (const UndecidedVoxel& u : there.undecided) kept.insert(u.voxel);
  std::size_t lost = 0;
  for (const MedialSphere& s : here.spheres) {
    const bool clear = static_cast<double>(s.object_angle) >= options.object_angle + 0.05 &&
                       test::depth_in_voxel(here.grid, test::to_eigen(s.centre)) >= 0.05;
    lost += clear && !kept.contains(s.voxel);
  }
  return lost;
}

bool same_bytes(const Extraction& a, const Extraction& b) {
  return a.spheres.size() == b.spheres.size() &&
         std::memcmp(a.spheres.data(), b.spheres.data(), a.spheres.size() * sizeof(MedialSphere)) == 0;
}

// Extracts with the original and the rewritten kernels. True if both gave the same bytes.
bool agree(Mesh solid, const ExtractionOptions& options, const Rewrite& rewrite) {
  const PreparedMesh mesh = test::prepare(std::move(solid));
  Context context = test::make_context();
  const Extraction plain = test::extract_on_device(context, mesh, options).extraction;
  const OtherKernels kernels(rewrite);
  Context other_context = test::make_context();
  Internals::of(other_context).extra_shaders = kernels.shaders();
  const CertifiedExtraction other = test::extract_on_device(other_context, mesh, options);
  EXPECT_GT(plain.spheres.size(), 500u);
  EXPECT_TRUE(test::passes_certificate(mesh, other.extraction, options));
  EXPECT_LE(other.certificate.rejected, plain.spheres.size() / 100);
  EXPECT_EQ(count_lost(plain, other.extraction, options), 0u);
  EXPECT_EQ(count_lost(other.extraction, plain, options), 0u);
  // The number of undecided voxels does not grow, except for a few at thresholds.
  EXPECT_LE(other.extraction.undecided.size(), plain.undecided.size() + plain.spheres.size() / 100);
  return same_bytes(plain, other.extraction);
}

Mesh turned(Mesh solid) {
  test::rotate(solid, {0.3, 0.5, 0.8}, 0.7);
  return solid;
}

Mesh open_torus() {
  Mesh solid = test::make_torus(1.0, 0.4, 24, 48, 0.5);
  solid.triangles.resize(solid.triangles.size() - 40);
  return solid;
}

class OtherRoundingTest : public testing::TestWithParam<float> {
 protected:
  // Division: 2.5 units in the last place. Roots: those of 1 / inversesqrt, 2 more. Angles: 4,096.
  test::OtherRounding rounding() const { return {GetParam() * 2.4e-7f, GetParam() * 4e-7f, GetParam() * 2.4e-4f}; }

  void expect_the_same(Mesh solid, std::uint32_t resolution) {
    ExtractionOptions options;
    options.resolution = resolution;
    const Rewrite rewrite = [&](auto words) { return test::round_otherwise(words, rounding()); };
    EXPECT_FALSE(agree(std::move(solid), options, rewrite)) << "the kernels round as they did";
  }
};

TEST_P(OtherRoundingTest, ASolidWithCorners) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(turned(test::make_l_shape(1.0, 0.4, 0.5)), 30);
}

TEST_P(OtherRoundingTest, ARoundSolidOfSmallTriangles) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(turned(test::make_torus(1.0, 0.4, 80, 160, 0.5)), 65);
}

TEST_P(OtherRoundingTest, AnOpenMesh) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(open_torus(), 33);
}

INSTANTIATE_TEST_SUITE_P(BothWays, OtherRoundingTest, testing::Values(1.0f, -1.0f),
                         [](const auto& sign) { return sign.param > 0 ? "larger" : "smaller"; });

// ---- Numbers that devices need not support

using MakeSpecials = test::DeviceTest;

std::vector<float> make_specials(ContextImpl& context, std::span<const std::uint32_t> words) {
  const EmbeddedShader shader = {"make_specials", words};
  context.extra_shaders = {&shader, 1};
  constexpr std::uint32_t kCount = 12;
  Arena arena(context);
  const Buffer output = arena.create_buffer(kCount * sizeof(float), MemoryKind::kReadback, "a test").value();
  const ProgramKey program = {.shader = "make_specials",
                              .storage_buffers = 1,
                              .texel_buffers = 0,
                              .push_constant_bytes = 4 * sizeof(float),
                              .workgroup_size = 1,
                              .constants = {}};
  const auto ran = run_commands(context, [&](Recorder& recorder) {
    const BufferRange buffers[] = {output.range()};
    const float numbers[] = {0.0f, 0x1p-126f, 0x1p126f, 0.0f};
    recorder.dispatch(program, buffers, {}, bytes_of(numbers), 1);
    recorder.barrier_to_host();
    return recorder.status();
  });
  EXPECT_TRUE(ran.ok());
  const auto* values = static_cast<const float*>(output.mapped);
  return {values, values + kCount};
}

TEST_F(MakeSpecials, AreThereAndAreReplaced) {
  use_own_context();
  const std::vector<float> plain = make_specials(Internals::of(*context_), kMakeSpecialsSpirv);
  EXPECT_TRUE(std::isinf(plain[0]));
  EXPECT_TRUE(std::isnan(plain[1]));
  EXPECT_TRUE(std::isinf(plain[10]));
  Context other = test::make_context();
  const std::vector<std::uint32_t> words = test::replace_specials(kMakeSpecialsSpirv, {-0.0f, 7.0f});
  const std::vector<float> found = make_specials(Internals::of(other), words);
  const std::vector<float> expected = {7, 7, 7, 7, 0, 0, 0x1p125f, 0x1p126f, 0x1p-126f, 1, 7, 7};
  EXPECT_EQ(found, expected);
  for (const std::size_t zero : {4, 5}) EXPECT_TRUE(std::signbit(found[zero]));
}

class OtherSpecialsTest : public testing::TestWithParam<test::OtherSpecials> {
 protected:
  void expect_the_same(Mesh solid, std::uint32_t resolution, Mode mode = Mode::kCertified) {
    ExtractionOptions options;
    options.resolution = resolution;
    options.mode = mode;
    const Rewrite rewrite = [&](auto words) { return test::replace_specials(words, GetParam()); };
    agree(std::move(solid), options, rewrite);
  }
};

TEST_P(OtherSpecialsTest, ASolidAlongTheAxes) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(test::make_l_shape(1.0, 0.4, 0.5), 22);
}

TEST_P(OtherSpecialsTest, ASolidWithCorners) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(turned(test::make_l_shape(1.0, 0.4, 0.5)), 30);
}

TEST_P(OtherSpecialsTest, ARoundSolidOfSmallTriangles) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(turned(test::make_torus(1.0, 0.4, 40, 80, 0.5)), 50);
}

TEST_P(OtherSpecialsTest, AnOpenMesh) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(open_torus(), 33);
}

TEST_P(OtherSpecialsTest, ThePublishedSearch) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  expect_the_same(test::make_l_shape(1.0, 0.4, 0.5), 24, Mode::kThesis);
}

INSTANTIATE_TEST_SUITE_P(, OtherSpecialsTest, testing::ValuesIn(test::kOtherSpecials),
                         [](const auto& specials) { return test::name_of(specials.param); });

}  // namespace
}  // namespace medial_vk
