// The same input, options and device give the same bytes, for any division of the work into chunks, without messages of
// the validation layer. In both modes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "support/device/device.h"
#include "support/extraction.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

// No padding: comparing memory compares every number.
static_assert(sizeof(MedialSphere) ==
              sizeof(Point) + sizeof(double) + 8 * sizeof(float) + sizeof(std::int32_t) + 3 * sizeof(std::uint32_t));

PreparedMesh torus(std::uint32_t around = 40, std::uint32_t along = 80) {
  Mesh mesh = test::make_torus(1.0, 0.4, around, along, 0.5);
  test::rotate(mesh, {0.3, 0.5, 0.8}, 0.7);
  return test::prepare(std::move(mesh));
}

void expect_same_spheres(const Extraction& a, const Extraction& b) {
  EXPECT_EQ(a.grid.origin, b.grid.origin);
  EXPECT_EQ(a.grid.voxel_size, b.grid.voxel_size);
  EXPECT_EQ(a.grid.size, b.grid.size);
  ASSERT_EQ(a.spheres.size(), b.spheres.size());
  for (std::size_t i = 0; i < a.spheres.size(); ++i) {
    ASSERT_EQ(std::memcmp(&a.spheres[i], &b.spheres[i], sizeof(MedialSphere)), 0) << "sphere " << i;
  }
  EXPECT_EQ(a.measurements.counters.found, b.measurements.counters.found);
  EXPECT_EQ(a.measurements.counters.undecided, b.measurements.counters.undecided);
  EXPECT_EQ(a.measurements.counters.proved_empty, b.measurements.counters.proved_empty);
}

void expect_same_bytes(const Extraction& a, const Extraction& b) {
  expect_same_spheres(a, b);
  ASSERT_EQ(a.measurements.counters.levels.size(), b.measurements.counters.levels.size());
  for (std::size_t i = 0; i < a.measurements.counters.levels.size(); ++i) {
    const ExtractionCounters::Level &x = a.measurements.counters.levels[i], &y = b.measurements.counters.levels[i];
    EXPECT_EQ(x.visited, y.visited) << "level " << i;
    EXPECT_EQ(x.kept, y.kept) << "level " << i;
    EXPECT_EQ(x.contacts, y.contacts) << "level " << i;
    EXPECT_EQ(x.found, y.found) << "level " << i;
  }
}

class BothModes : public testing::TestWithParam<Mode> {
 protected:
  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    options_.mode = GetParam();
    options_.resolution = 24;
  }

  ExtractionOptions options_;
};

TEST_P(BothModes, TwiceTheSameBytes) {
  const PreparedMesh mesh = torus();
  Context context = test::make_context();
  const CertifiedExtraction first = test::extract_on_device(context, mesh, options_);
  const CertifiedExtraction second = test::extract_on_device(context, mesh, options_);
  EXPECT_GT(first.extraction.spheres.size(), 100u);
  expect_same_bytes(first.extraction, second.extraction);
  EXPECT_TRUE(test::passes_certificate(mesh, first.extraction, options_));
}

TEST_P(BothModes, MemoryOnlyCutsTheWork) {
  const PreparedMesh mesh = torus();
  Context context = test::make_context();
  const CertifiedExtraction roomy = test::extract_on_device(context, mesh, options_);
  options_.memory_budget = 64ull << 20;
  const CertifiedExtraction tight = test::extract_on_device(context, mesh, options_);
  expect_same_bytes(roomy.extraction, tight.extraction);
  // The budget falls until chunks overflow and are run again in parts (mode thesis chooses chunks that fit).
  std::uint64_t retries = 0;
  for (std::uint64_t budget = 16ull << 20; retries == 0; budget = budget * 3 / 4) {
    ASSERT_GE(budget, 4ull << 20) << "no chunk has overflowed";
    options_.memory_budget = budget;
    const CertifiedExtraction cut = test::extract_on_device(context, mesh, options_);
    expect_same_bytes(roomy.extraction, cut.extraction);
    if (GetParam() == Mode::kThesis) break;
    retries = cut.extraction.measurements.counters.retries;
  }
  EXPECT_EQ(roomy.extraction.measurements.counters.retries, 0u);
}

// Chunks of few top cells, among them some with only cells that are found empty when their lists are written.
TEST(Determinism, SmallChunksGiveTheSame) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const PreparedMesh mesh = torus(80, 160);
  Context context = test::make_context();
  ExtractionOptions options;
  options.resolution = 100;
  const CertifiedExtraction roomy = test::extract_on_device(context, mesh, options);
  options.memory_budget = 6ull << 20;
  const CertifiedExtraction tight = test::extract_on_device(context, mesh, options);
  expect_same_bytes(roomy.extraction, tight.extraction);
}

// A block of voxels counts the cells above it once more.
TEST(Determinism, ATopCellThatDoesNotFitIsSearchedInBlocks) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const PreparedMesh mesh = torus();
  Context context = test::make_context();
  ExtractionOptions options;
  options.resolution = 128;
  const CertifiedExtraction roomy = test::extract_on_device(context, mesh, options);
  const auto visited = [](const CertifiedExtraction& e) {
    return e.extraction.measurements.counters.levels[0].visited;
  };
  options.memory_budget = 3ull << 19;
  CertifiedExtraction tight = roomy;
  while (visited(tight) == visited(roomy)) {
    options.memory_budget = options.memory_budget * 3 / 4;
    ASSERT_GE(options.memory_budget, 1ull << 18) << "every top cell has fitted";
    tight = test::extract_on_device(context, mesh, options);
    expect_same_spheres(roomy.extraction, tight.extraction);
  }
  EXPECT_GT(visited(tight), visited(roomy));
}

// What then stays undecided was found or proved at a level that is left out; all other voxels are as before.
TEST(Determinism, AVoxelThatDoesNotFitIsDividedLess) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const PreparedMesh mesh = torus();
  Context context = test::make_context();
  ExtractionOptions options;
  options.resolution = 100;
  const CertifiedExtraction roomy = test::extract_on_device(context, mesh, options);
  CertifiedExtraction tight = roomy;
  for (options.memory_budget = 9ull << 16; tight.extraction.undecided.size() == roomy.extraction.undecided.size();) {
    options.memory_budget = options.memory_budget * 3 / 4;
    ASSERT_GE(options.memory_budget, 1ull << 12) << "every voxel has fitted";
    tight = test::extract_on_device(context, mesh, options);
  }
  EXPECT_GT(tight.extraction.undecided.size(), roomy.extraction.undecided.size());
  const auto voxel = [](const MedialSphere& s) { return s.voxel; };
  for (const MedialSphere& s : tight.extraction.spheres) {
    const auto same = std::ranges::find(roomy.extraction.spheres, s.voxel, voxel);
    ASSERT_NE(same, roomy.extraction.spheres.end());
    EXPECT_EQ(std::memcmp(&*same, &s, sizeof s), 0);
  }
  EXPECT_TRUE(test::passes_certificate(mesh, tight.extraction, options));
}

TEST_P(BothModes, NoValidationMessages) {
  MEDIAL_VK_SKIP_WITHOUT_VALIDATION();
  Mesh box = test::make_box({1, 0.7, 0.5});
  test::rotate(box, {0.3, 0.5, 0.8}, 0.7);
  const PreparedMesh mesh = test::prepare(std::move(box));
  options_.resolution = 12;
  Context context = test::make_context(true);
  const CertifiedExtraction result = test::extract_on_device(context, mesh, options_);
  EXPECT_GT(result.extraction.spheres.size(), 50u);
  EXPECT_EQ(context.validation_messages(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Modes, BothModes, testing::Values(Mode::kCertified, Mode::kThesis), [](const auto& mode) {
  return std::string(mode.param == Mode::kCertified ? "Certified" : "Thesis");
});

}  // namespace
}  // namespace medial_vk
