// ExtractionOptions::memory_budget: the device memory that an extraction holds at any time stays below it.
#include <cstdint>

#include "fault_test.h"
#include "support/indexed.h"

namespace medial_vk::test {
namespace {

class MemoryBudget : public FaultTest {
 protected:
  static PreparedMesh torus(std::uint32_t around, std::uint32_t along) {
    return prepare(make_torus(1.0, 0.3, around, along, 0.5));
  }

  static void expect_within(std::uint64_t mebibytes, const PreparedMesh& mesh, Mode mode, std::uint32_t resolution) {
    SCOPED_TRACE(testing::Message() << mebibytes << " MiB, resolution " << resolution);
    Result<Context> context = open();
    ASSERT_TRUE(context.ok()) << context.error().message;
    ExtractionOptions options;
    options.mode = mode;
    options.resolution = resolution;
    options.memory_budget = mebibytes << 20;
    vulkan().clear_usage();
    const auto extraction = test::extract_spheres(context.value(), mesh.view(), options);
    ASSERT_TRUE(extraction.ok()) << extraction.error().message;
    EXPECT_GT(extraction.value().spheres.size(), 200u);
    EXPECT_LE(vulkan().usage().memory_bytes, options.memory_budget);
    // The budget is used: a search in smaller chunks than memory allows would take longer.
    if (mode == Mode::kCertified) {
      EXPECT_GE(vulkan().usage().memory_bytes, options.memory_budget * 3 / 4);
    }
  }
};

TEST_F(MemoryBudget, HoldsForTheCertifiedSearch) {
  const PreparedMesh mesh = torus(100, 200);
  for (const std::uint64_t mebibytes : {64, 256, 1024}) expect_within(mebibytes, mesh, Mode::kCertified, 160);
  expect_within(256, mesh, Mode::kCertified, 400);
}

TEST_F(MemoryBudget, HoldsForThePublishedSearch) {
  const PreparedMesh mesh = torus(100, 200);
  for (const std::uint64_t mebibytes : {64, 256}) expect_within(mebibytes, mesh, Mode::kThesis, 24);
}

TEST_F(MemoryBudget, CountsTheMesh) { expect_within(256, torus(200, 900), Mode::kCertified, 80); }

TEST_F(MemoryBudget, CountsWhatCopiesPassThrough) {
  DeviceProfile discrete;
  discrete.split_memory = true;
  vulkan().set_profile(discrete);
  for (const std::uint64_t mebibytes : {64, 256}) expect_within(mebibytes, torus(100, 200), Mode::kCertified, 160);
}

}  // namespace
}  // namespace medial_vk::test
