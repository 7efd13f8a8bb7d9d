// Which width of a window is chosen where its differences from others are noise, bias, or those of facets.
#include "curvature/width_choice.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace medial_vk {
namespace {

using Differences = std::array<WidthDifference, 6>;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

Differences of(const std::array<double, 5>& forms) {
  Differences differences = {};
  for (std::size_t i = 0; i < forms.size(); ++i) differences[i + 1] = {forms[i], forms[i] / 2};
  return differences;
}

// The noise of each width is 2^(-3/2) of the next narrower one's, from which it differs by the latter. The widest one's
// difference might be bias.
TEST(WidthChoice, OfNoiseIsTheLastButOne) {
  const double less = std::pow(2, -1.5);
  const WidthChoice choice = choose_width(of({1, less, std::pow(less, 2), std::pow(less, 3), std::pow(less, 4)}));
  EXPECT_EQ(choice.step, 4u);
  EXPECT_DOUBLE_EQ(choice.form_difference, std::pow(less, 3));
  EXPECT_DOUBLE_EQ(choice.angle_difference, std::pow(less, 3) / 2);
}

// The error of the narrowest one is a third of the difference of the next one, which is reported in full.
TEST(WidthChoice, OfBiasIsTheNarrowest) {
  const WidthChoice choice = choose_width(of({1, 4, 16, 64, 256}));
  EXPECT_EQ(choice.step, 1u);
  EXPECT_DOUBLE_EQ(choice.form_difference, 4);
}

// The narrowest window agrees with the next narrower one, since both lie in a facet, and the next wider one shows that
// they are wrong.
TEST(WidthChoice, WithinAFacetIsNotTheOneThatDiffersLeast) {
  const WidthChoice choice = choose_width(of({0.01, 1, 0.3, 0.1, 0.1}));
  EXPECT_EQ(choice.step, 4u);
  EXPECT_DOUBLE_EQ(choice.form_difference, 0.1);
}

// The bias of windows that are far wider counts by the fourth power of their widths.
TEST(WidthChoice, CountsBiasOverWidthsWithoutAResult) {
  const WidthChoice choice = choose_width(of({1, kNothing, 8, kNothing, kNothing}));
  EXPECT_EQ(choice.step, 1u);
  EXPECT_DOUBLE_EQ(choice.form_difference, 2);
}

TEST(WidthChoice, IsNoneWithoutDifferences) {
  EXPECT_EQ(choose_width(of({kNothing, kNothing, kNothing, kNothing, kNothing})).step, 0u);
}

}  // namespace
}  // namespace medial_vk
