// Variants of kernels whose constants the build has set (cmake/EmbedShaders.cmake): an extraction requests them, and
// they compute the same as the kernels whose constants the driver sets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>

#include "device/context_impl.h"
#include "device/embedded_shaders.h"
#include "extraction/certified/certified_pipeline.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr std::string_view kMark = "_with_";

const EmbeddedShader& general_of(const EmbeddedShader& frozen) {
  const std::string_view name = frozen.name.substr(0, frozen.name.find(kMark));
  for (const EmbeddedShader& shader : embedded_shaders())
    if (shader.name == name) return shader;
  ADD_FAILURE() << "there is no " << name;
  return frozen;
}

std::vector<EmbeddedShader> frozen_shaders() {
  std::vector<EmbeddedShader> frozen;
  for (const EmbeddedShader& shader : embedded_shaders())
    if (shader.name.find(kMark) != std::string_view::npos) frozen.push_back(shader);
  return frozen;
}

// The requests of an extraction from a mesh with trusted normals only, in the names of the frozen variants.
std::set<std::string> names_requested(ContextImpl& context, const IndexedMesh& mesh, const ExtractionOptions& options) {
  Result<DeviceMesh> device = DeviceMesh::create(context, mesh, true);
  EXPECT_TRUE(device.ok() && device.value().finish_uploads().ok());
  Result<StopWord> stop = StopWord::create(context);
  EXPECT_TRUE(stop.ok());
  const std::uint32_t n = options.resolution;
  auto pipeline = CertifiedPipeline::create(context, device.value(), options, {n, n, n}, stop.value());
  EXPECT_TRUE(pipeline.ok());
  Recorder rehearsal(context);
  EXPECT_TRUE(pipeline.value().record(rehearsal, 0, 1).ok());
  std::set<std::string> names;
  for (const ProgramKey& key : rehearsal.programs()) {
    std::string name = key.shader + std::string(kMark) + std::to_string(key.workgroup_size);
    for (const std::uint32_t value : key.constants) name += "_" + std::to_string(value);
    names.insert(name);
  }
  return names;
}

class FrozenShadersTest : public testing::Test {
 protected:
  FrozenShadersTest() : mesh_(test::prepare(test::make_torus(1.0, 0.4, 24, 48, 0.5))) { options_.resolution = 40; }

  PreparedMesh mesh_;
  ExtractionOptions options_;
};

TEST_F(FrozenShadersTest, AreRequested) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Context context = test::make_context();
  if (!Internals::of(context).has_lockstep_lanes) GTEST_SKIP() << "this device takes the general kernels";
  const IndexedMesh mesh = test::indexed(mesh_);
  std::set<std::string> requested = names_requested(Internals::of(context), mesh, options_);
  requested.merge(names_requested(Internals::of(context), mesh.on_side({}).value(), options_));
  ASSERT_THAT(frozen_shaders(), testing::Not(testing::IsEmpty()));
  for (const EmbeddedShader& frozen : frozen_shaders()) {
    EXPECT_TRUE(requested.contains(std::string(frozen.name))) << frozen.name << " is never used";
  }
}

TEST_F(FrozenShadersTest, ComputeTheSame) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Context context = test::make_context(), other_context = test::make_context();
  std::vector<EmbeddedShader> general = frozen_shaders();
  for (EmbeddedShader& shader : general) shader.words = general_of(shader).words;
  Internals::of(other_context).extra_shaders = general;
  const auto frozen = test::extract_on_device(context, mesh_, options_).extraction;
  const auto other = test::extract_on_device(other_context, mesh_, options_).extraction;
  ASSERT_GT(frozen.spheres.size(), 500u);
  ASSERT_EQ(frozen.spheres.size(), other.spheres.size());
  EXPECT_EQ(std::memcmp(frozen.spheres.data(), other.spheres.data(), frozen.spheres.size() * sizeof(MedialSphere)), 0);
  ASSERT_EQ(frozen.undecided.size(), other.undecided.size());
  for (std::size_t i = 0; i < frozen.undecided.size(); ++i) {
    EXPECT_EQ(frozen.undecided[i].voxel, other.undecided[i].voxel);
    EXPECT_EQ(frozen.undecided[i].kind, other.undecided[i].kind);
    EXPECT_EQ(frozen.undecided[i].width, other.undecided[i].width);
  }
}

// The constants that are left to the driver.
std::set<std::uint32_t> specialization_ids(const EmbeddedShader& shader) {
  constexpr std::uint32_t kHeaderWords = 5, kOpDecorate = 71, kSpecId = 1;
  std::set<std::uint32_t> ids;
  for (std::size_t i = kHeaderWords; i < shader.words.size(); i += shader.words[i] >> 16) {
    if ((shader.words[i] & 0xffffu) == kOpDecorate && shader.words[i + 2] == kSpecId) ids.insert(shader.words[i + 3]);
  }
  return ids;
}

TEST(FrozenShaders, LeaveNoConstantToTheDriver) {
  for (const EmbeddedShader& frozen : frozen_shaders()) {
    EXPECT_TRUE(specialization_ids(frozen).empty()) << frozen.name;
    // As many values as there are constants.
    const std::string_view values = frozen.name.substr(frozen.name.find(kMark) + kMark.size());
    EXPECT_EQ(specialization_ids(general_of(frozen)).size(),
              static_cast<std::size_t>(std::count(values.begin(), values.end(), '_')) + 1)
        << frozen.name;
  }
}

}  // namespace
}  // namespace medial_vk
