// What the command says of a motion.
#include "cli/follow/follow_summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "unit/output/motion_example.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Of two frames after the rest pose.
std::string summary(const FollowOptions& options, const MotionRecord& record, double update_seconds = 0.01) {
  return follow_summary(options, record, true, {}, {}, update_seconds, {}, {});
}

TEST(FollowSummary, TimesOfFramesAreMillisecondsOrSeconds) {
  const MotionRecord record = test::motion_example();
  EXPECT_THAT(summary({}, record, 0.0134), HasSubstr("each      6.7 ms a frame\n"));
  EXPECT_THAT(summary({}, record, 1.998), HasSubstr("each      999 ms a frame\n"));
  EXPECT_THAT(summary({}, record, 2), HasSubstr("each      1.00 s a frame\n"));
  EXPECT_THAT(summary({}, record, 13.46), HasSubstr("each      6.73 s a frame\n"));
  EXPECT_THAT(summary({}, record, 300), HasSubstr("each      2 min 30 s a frame\n"));
}

TEST(FollowSummary, WhatIsOutsideIsABoundAndAnEstimate) {
  MotionRecord record = test::motion_example();
  FollowOptions options;
  EXPECT_THAT(summary(options, record), Not(HasSubstr("outside")));
  options.follower.rule = FollowRule::kPublished;
  EXPECT_THAT(summary(options, record), HasSubstr("outside   at most 1.25 % of the solid, in any frame\n"));
  record.frames[0].outside = OutsideEstimate{0.002, 0.001};   // of 8
  record.frames[1].outside = OutsideEstimate{0.005, 0.0004};  // of 10
  EXPECT_THAT(summary(options, record),
              HasSubstr("at most 1.25 % of the solid, in any frame; in the worst one 0.05 % by "
                        "samples (standard error 0.004 %)\n"));
}

TEST(FollowSummary, BallsAreChosenAnewForRegionsToo) {
  MotionRecord record = test::motion_example();
  record.renews = true;
  for (FollowedFrame& frame : record.frames) frame.origins.assign(2, FollowOrigin::kFollowed);
  EXPECT_THAT(summary({}, record),
              HasSubstr("no ball; beyond 1.5 times what is uncovered at rest, in a region or in all\n"));
}

}  // namespace
}  // namespace medial_vk::cli
