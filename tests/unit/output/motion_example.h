// Records of two balls in three frames, made up.
#pragma once

#include "output/motion_files/motion_record.h"
#include "support/solids/solids.h"

namespace medial_vk::test {

/// A cube, which grows; one of the balls is flat in the second frame, and both are small or lost in the third.
inline MotionRecord motion_example() {
  MotionRecord record;
  record.version = "1";
  record.name = "cube.obj";
  record.rule = "tangent";
  record.frames_per_second = 2;
  record.has_volume = true;
  const Mesh cube = make_box({1, 1, 1});
  record.triangles = cube.triangles;
  const auto frame = [&](const char* name, double time, double size) {
    FollowedFrame made;
    made.name = made.short_name = name;
    made.time = time;
    for (const Point& p : cube.vertices) {
      made.vertices.push_back(
          {static_cast<float>(size * p[0]), static_cast<float>(size * p[1]), static_cast<float>(size * p[2])});
    }
    return made;
  };
  FollowedFrame rest = frame("rest", 0, 1);
  rest.balls = {{{0.1, 0.3, 0.7}, 0.1}, {{0.6, 0.6, 0.6}, 0.4}};
  rest.states = {FollowState::kMedial, FollowState::kMedial};
  rest.measures = {8, 6, 0};
  rest.gap = Bounds{0.5, 0.75};
  FollowedFrame middle = frame("a.obj", 0.5, 1.1);
  middle.balls = {{{0.11, 0.31, 0.71}, 0.11}, {{0.7, 0.6, 0.6}, 0.3}};
  middle.states = {FollowState::kMedial, FollowState::kFlat};
  middle.measures = {10, 5, 0.125};
  middle.gap = Bounds{1, 1.25};
  FollowedFrame last = frame("the \"last\", bent.obj", 1, 1.25);
  last.balls = {{{0.2, 0.2, 0.2}, 0.05}, {{0.7, 0.6, 0.6}, 0}};
  last.states = {FollowState::kShrunk, FollowState::kLost};
  last.measures = {16, 0, 0};
  record.frames = {rest, middle, last};
  return record;
}

/// The same cube in a cover: a ball has grown in the second frame, and the other is unused in the third, of which only
/// the surface is proved to be covered.
inline MotionRecord cover_motion_example() {
  MotionRecord record = motion_example();
  record.rule = "cover";
  record.covers = true;
  using enum CoverBallState;
  const std::vector<CoverBallState> states[] = {{kSteady, kSteady}, {kGrown, kSteady}, {kGrown, kUnused}};
  const CoverFollowMeasures measures[] = {{8, 10}, {10, 15}, {16, 24}};
  for (std::size_t i = 0; i < record.frames.size(); ++i) {
    FollowedFrame& frame = record.frames[i];
    frame.states.clear();
    frame.measures = {};
    frame.gap.reset();
    frame.cover = CoveredFrame{i < 2 ? CoverState::kSolid : CoverState::kSurface, states[i], measures[i], {}};
    if (i < 2) frame.cover->reach_out_bound = i == 0 ? 0.25 : 0.5;
  }
  return record;
}

}  // namespace medial_vk::test
