// Devices may round roots and divisions differently from lavapipe, and need not support denormal numbers, infinities,
// NaN and signed zeros. The kernel of bodies, with SPIR-V that is rewritten so, still proves what it answers, within
// its errors (docs/theory.md, "Many poses on a device").
#include <gtest/gtest.h>

#include <algorithm>

#include "device/context_impl.h"
#include "support/device/bodies_on_device.h"
#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/device/other_kernels.h"
#include "support/extraction.h"
#include "support/other_rounding.h"
#include "support/other_specials.h"

namespace medial_vk {
namespace {

using test::PosedBodies;

bool are_same(const test::DeviceAnswers& a, const test::DeviceAnswers& b) {
  const auto same = [](const DistanceBounds& one, const DistanceBounds& other) {
    return one.lower == other.lower && one.upper == other.upper;
  };
  return a.verdicts == b.verdicts && std::ranges::equal(a.bounds, b.bounds, same);
}

/// Answers of the rewritten kernels are proved. True if they are those of the original ones.
bool answers_agree(const test::Rewrite& rewrite, std::span<const double> sizes) {
  const test::OtherKernels kernels(rewrite);
  Context other = test::make_context();
  Internals::of(other).extra_shaders = kernels.shaders();
  bool is_same = true;
  test::Random random(41);
  for (const double size : sizes) {
    SCOPED_TRACE(testing::Message() << "size " << size);
    for (const PosedBodies& of : {test::bodies_at_random(random, size), test::balls_that_almost_touch(random, size)}) {
      const test::DeviceAnswers found = test::expect_answers(other, of);
      is_same &= are_same(found, test::expect_answers(test::quick_device(), of));
    }
  }
  return is_same;
}

class OtherRoundingOfBodies : public testing::TestWithParam<float> {};

TEST_P(OtherRoundingOfBodies, ProvesItsAnswers) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  // Division: 2.5 units in the last place. Roots: those of 1 / inversesqrt, 2 more.
  const test::OtherRounding rounding = {GetParam() * 2.4e-7f, GetParam() * 4e-7f, 0};
  const auto rewrite = [&](auto words) { return test::round_otherwise(words, rounding); };
  const double sizes[] = {1e-6, 1, 1e6};
  EXPECT_FALSE(answers_agree(rewrite, sizes)) << "the kernel rounds as it did";
}

INSTANTIATE_TEST_SUITE_P(BothWays, OtherRoundingOfBodies, testing::Values(1.0f, -1.0f),
                         [](const auto& sign) { return sign.param > 0 ? "larger" : "smaller"; });

class OtherSpecialsOfBodies : public testing::TestWithParam<test::OtherSpecials> {};

// Squares of the smallest and of the largest lengths are beyond the range of float.
TEST_P(OtherSpecialsOfBodies, ProvesItsAnswers) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  const auto rewrite = [&](auto words) { return test::replace_specials(words, GetParam()); };
  const double sizes[] = {1e-20, 1, 1e17};
  answers_agree(rewrite, sizes);
}

INSTANTIATE_TEST_SUITE_P(, OtherSpecialsOfBodies, testing::ValuesIn(test::kOtherSpecials),
                         [](const auto& specials) { return test::name_of(specials.param); });

}  // namespace
}  // namespace medial_vk
