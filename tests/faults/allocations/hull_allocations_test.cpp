// Host memory that runs out in proofs and fits of hulls. No device is needed: the medial points are made once.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "faults/failing_new.h"
#include "faults/fault_test.h"
#include "medial_vk/hull_fits.h"
#include "medial_vk/prepare.h"
#include "reference_bridge/reference_extractor.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

void append_hulls(std::string& out, const std::vector<BallHull>& hulls) {
  for (const BallHull& hull : hulls) {
    for (const Ball& ball : hull.balls()) append_bytes(out, ball);
  }
}

/// One allocation per run fails: the first ones, every one, and then of so many that `runs` runs reach the end. The job
/// then ends with the error, or is as without a fault.
void fail_allocations(const char* name, const std::function<Answer()>& job, std::uint64_t runs) {
  const Answer expected = job();
  ASSERT_TRUE(expected.ok()) << expected.error().message;
  std::uint64_t last = 1;  // a power of two with fewer allocations than the job
  for (bool failed = true; failed; last *= 2) {
    fail_new(last);
    static_cast<void>(job());
    failed = stop_failing_new();
  }
  std::uint64_t errors = 0, survived = 0;
  const std::uint64_t stride = std::max<std::uint64_t>(1, last / (4 * runs));
  for (std::uint64_t k = 1; k < last && !testing::Test::HasFailure(); k += k < 40 ? 1 : stride * fault_stride()) {
    fail_new(k);
    const Answer answer = job();
    const bool failed = stop_failing_new();
    SCOPED_TRACE(std::string(name) + ", allocation " + std::to_string(k));
    if (answer.ok()) {
      EXPECT_TRUE(answer.value() == expected.value());
    } else {
      EXPECT_TRUE(failed);
      EXPECT_EQ(answer.error().code, ErrorCode::kOutOfMemory) << answer.error().message;
      EXPECT_NE(answer.error().message, "");
    }
    if (!failed) break;
    ++(answer.ok() ? survived : errors);
  }
  EXPECT_GT(errors, 20u);
  std::cout << name << ": " << errors << " errors, " << survived << " survived\n";
}

TEST(HullAllocations, RunOutInProofs) {
  const BallHull in = hull_of(Ball{{0.5, 0.4, 0.2}, 0.1}, Ball{{0.6, 0.4, 0.2}, 0.15});
  const std::vector<BallHull> hulls = {in, hull_of(Ball{{2, 0, 0}, 1}), in};
  Mesh open = make_box({1, 0.7, 0.45});
  open.triangles.pop_back();
  for (const Mesh& mesh : {make_box({1, 0.7, 0.45}), open}) {
    const IndexedMesh made = indexed(prepare_mesh(mesh).value());
    fail_allocations(
        "proofs of hulls",
        [&]() -> Answer {
          const auto proof = in_runtime([&] { return prove_hulls(made, hulls, {.threads = 1}); });
          if (!proof.ok()) return proof.error();
          std::string out;
          append_bytes(out, proof.value().failed);
          append_bytes(out, proof.value().planes);
          append_bytes(out, proof.value().greatest_lack);
          return out;
        },
        100);
  }
}

TEST(HullAllocations, RunOutInFits) {
  const IndexedMesh mesh = indexed(prepare_mesh(make_box({1, 0.7, 0.45})).value());
  ExtractionOptions coarse;
  coarse.resolution = 8;
  const Extraction found = reference_extractor()(mesh, coarse, {}, {}).value();
  const Extractor extractor = [&](const IndexedMesh&, const ExtractionOptions&, const ProgressCallback&,
                                  const std::stop_token&) -> Result<Extraction> {
    return catch_out_of_memory("a copy", [&]() -> Result<Extraction> { return Extraction(found); });
  };
  for (const HullChoice choice : {HullChoice::kCapsules, HullChoice::kBalls}) {
    fail_allocations(
        choice == HullChoice::kBalls ? "a fit of balls" : "a fit of capsules",
        [&]() -> Answer {
          const HullFitOptions options = {.choice = choice, .count = 1, .width = 0.01, .resolution = 8, .threads = 1};
          const auto fit = in_runtime([&] { return fit_hulls(mesh, options, extractor); });
          if (!fit.ok()) return fit.error();
          std::string out;
          append_hulls(out, fit.value().hulls);
          append_bytes(out, fit.value().covered);
          append_bytes(out, fit.value().gap);
          return out;
        },
        12);
  }
}

}  // namespace
}  // namespace medial_vk::test
