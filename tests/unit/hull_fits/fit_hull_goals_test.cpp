// The goals of fits of hulls: met together, or refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "support/solids/solids.h"
#include "unit/hull_fits/fit_shape.h"

namespace medial_vk {
namespace {

/// Of bounds of volumes that are not compared with others.
constexpr double kWide = 0.01;

double uncovered_share(const HullFit& fit) { return 1 - fit.covered.lower / *fit.solid_volume; }

std::size_t parameters_of_all(const HullFit& fit) {
  std::size_t sum = 0;
  for (const BallHull& hull : fit.hulls) sum += parameters_of(kind_of(hull));
  return sum;
}

TEST(HullGoals, MeetAnError) {
  FitShape shape(test::make_box({1, 0.7, 0.45}));
  const HullFitOptions options = {.choice = HullChoice::kCapsules, .error = 0.45};
  const HullFit fit = shape.fit(options).value();
  EXPECT_LE(uncovered_share(fit), options.error);
  ASSERT_GT(fit.hulls.size(), 1u);
  // One hull fewer does not suffice: found by the same search.
  HullFitOptions fewer = options;
  fewer.count = fit.hulls.size() - 1;
  const Result<HullFit> refused = shape.fit(fewer);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
}

// Balls are sought by another search, with another measure of their volume: by the first two errors they are just
// enough there, but are not by the bounds of the result.
TEST(HullGoals, OfBallsMeetAnErrorByTheirBounds) {
  FitShape shape(test::make_l_shape(1, 0.3, 0.4));
  for (const double error : {0.253, 0.24, 0.3}) {
    const Result<HullFit> fit = shape.fit({.choice = HullChoice::kBalls, .error = error});
    ASSERT_TRUE(fit.ok()) << fit.error().message;
    EXPECT_LE(uncovered_share(fit.value()), error);
  }
  const HullFit near = shape.fit({.choice = HullChoice::kBalls, .max_gap = 0.2}).value();
  EXPECT_LE(near.gap.upper, 0.2);
}

TEST(HullGoals, MeetAGap) {
  FitShape shape(test::make_box({1, 0.7, 0.45}));
  const HullFit fit = shape.fit({.choice = HullChoice::kCones, .max_gap = 0.4, .width = kWide}).value();
  EXPECT_LE(fit.gap.upper, 0.4);
  const HullFit both =
      shape.fit({.choice = HullChoice::kCapsules, .error = 0.55, .max_gap = 0.4, .width = kWide}).value();
  EXPECT_LE(both.gap.upper, 0.4);
  EXPECT_LE(uncovered_share(both), 0.55);
}

TEST(HullGoals, MeetAllGoalsTogether) {
  FitShape shape(test::make_box({1, 0.7, 0.45}));
  const HullFit by_parameters = shape.fit({.choice = HullChoice::kCones, .parameters = 23, .width = kWide}).value();
  EXPECT_EQ(by_parameters.hulls.size(), 2u) << "of 8 each";
  const HullFit by_both =
      shape.fit({.choice = HullChoice::kCones, .count = 1, .parameters = 23, .width = kWide}).value();
  EXPECT_EQ(by_both.hulls.size(), 1u);
  const HullFitOptions goals = {
      .choice = HullChoice::kCones, .count = 4, .parameters = 30, .error = 0.6, .max_gap = 0.5};
  const HullFit all = shape.fit(goals).value();
  EXPECT_LE(all.hulls.size(), 3u);
  EXPECT_LE(uncovered_share(all), 0.6);
  EXPECT_LE(all.gap.upper, 0.5);
}

TEST(HullGoals, RefuseGoalsThatAreNotReached) {
  FitShape shape(test::make_box({1, 0.7, 0.45}));
  const auto refused = [&](const HullFitOptions& options, const char* words) {
    const Result<HullFit> fit = shape.fit(options);
    ASSERT_FALSE(fit.ok()) << words;
    EXPECT_EQ(fit.error().code, ErrorCode::kUsage) << fit.error().message;
    EXPECT_THAT(fit.error().message, testing::HasSubstr(words));
  };
  refused({.choice = HullChoice::kCapsules, .count = 1, .error = 0.01, .width = kWide}, "1 hull leaves");
  refused({.choice = HullChoice::kCapsules, .count = 1, .max_gap = 1e-3, .width = kWide}, "a gap of");
  refused({.choice = HullChoice::kBalls, .count = 1, .error = 0.01}, "");
  refused({.choice = HullChoice::kBalls, .count = 1, .max_gap = 1e-3}, "");
  refused({.choice = HullChoice::kMix, .count = 1, .error = 0.01, .width = kWide}, "");
  for (const HullChoice kind : {HullChoice::kBalls, HullChoice::kCapsules, HullChoice::kMix}) {
    refused({.choice = kind, .parameters = 3}, "`parameters` must be at least");
  }
}

TEST(HullGoals, RefuseOptionsOutOfRange) {
  FitShape shape(test::make_box({1, 0.7, 0.45}));
  const double nan = std::nan(""), infinity = HUGE_VAL;
  const auto refused = [](const Result<HullFit>& fit, const char* words) {
    ASSERT_FALSE(fit.ok()) << words;
    EXPECT_EQ(fit.error().code, ErrorCode::kUsage) << fit.error().message;
    EXPECT_THAT(fit.error().message, testing::HasSubstr(words));
  };
  refused(shape.fit({}), "is required");
  refused(shape.fit({.count = kMostHulls + 1}), "`count`");
  for (const double x : {-0.1, 1.0, nan, infinity}) {
    refused(shape.fit({.count = 1, .error = x}), "`error`");
    refused(shape.fit({.count = 1, .width = x}), "`width`");
  }
  for (const double x : {-0.1, nan, infinity}) refused(shape.fit({.count = 1, .max_gap = x}), "`max_gap`");
  refused(shape.fit({.count = 1, .resolution = 4097}), "`resolution`");
  refused(fit_hulls(shape.mesh.on_side({}).value(), {.count = 1}, shape.extractor()), "");
  Mesh open = test::make_box({1, 0.7, 0.45});
  open.triangles.pop_back();
  FitShape without(open);
  refused(without.fit({.error = 0.5}), "encloses a volume");
}

TEST(HullGoals, AMixIsAtLeastAsGoodAsEachKind) {
  FitShape shape(test::make_box({1, 0.7, 0.45}));
  const HullFit mix =
      shape.fit({.choice = HullChoice::kMix, .parameters = 11, .width = kWide}).value();  // no slab has so few
  std::size_t fewest = kMostHulls;
  for (const HullChoice kind : {HullChoice::kBalls, HullChoice::kCapsules, HullChoice::kCones}) {
    EXPECT_GE(mix.covered.lower, shape.fit({.choice = kind, .parameters = 11, .width = kWide}).value().covered.lower);
    fewest = std::min(fewest, parameters_of_all(shape.fit({.choice = kind, .error = 0.65, .width = kWide}).value()));
  }
  // One slab has more than the fewest.
  ASSERT_LT(fewest, parameters_of(HullKind::kSlab));
  EXPECT_EQ(parameters_of_all(shape.fit({.choice = HullChoice::kMix, .error = 0.65, .width = kWide}).value()), fewest);
}

}  // namespace
}  // namespace medial_vk
