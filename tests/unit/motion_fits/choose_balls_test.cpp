// Balls chosen for several frames: as good as theory promises, and never worse than those that were given.
#include "motion_fits/choose_balls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "medial_vk/ball_union.h"

namespace medial_vk {
namespace {

double union_volume(const std::vector<Ball>& balls) {
  std::vector<Ball> present;
  for (const Ball& ball : balls) {
    if (ball.radius > 0) present.push_back(ball);
  }
  return present.empty() ? 0 : measure_ball_union(present).value().volume;
}

/// By unions that are measured anew.
double value_of(const std::vector<CandidateFrame>& frames, const std::vector<std::uint32_t>& chosen) {
  double sum = 0;
  for (const CandidateFrame& frame : frames) {
    std::vector<Ball> balls;
    for (const std::uint32_t c : chosen) balls.push_back(frame.balls[c]);
    sum += frame.weight * union_volume(balls);
  }
  return sum;
}

/// Balls that wander and change from frame to frame; some are lost.
std::vector<CandidateFrame> wandering(std::size_t candidates, std::size_t frames, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double least, double greatest) {
    return least + (greatest - least) * static_cast<double>(random() - random.min()) /
                       static_cast<double>(random.max() - random.min());
  };
  std::vector<CandidateFrame> made(frames);
  for (std::size_t f = 0; f < frames; ++f) made[f].weight = 1.0 + static_cast<double>(f);
  for (std::size_t c = 0; c < candidates; ++c) {
    const Point home = {uniform(0, 3), uniform(0, 2), uniform(0, 2)};
    for (CandidateFrame& frame : made) {
      Ball ball = {home, uniform(0, 5) < 1 ? 0 : uniform(0.2, 0.9)};
      for (double& x : ball.centre) x += uniform(-0.3, 0.3);
      frame.balls.push_back(ball);
    }
  }
  return made;
}

MotionChoice choose(const std::vector<CandidateFrame>& frames, std::size_t count,
                    const std::vector<std::uint32_t>& start = {}, unsigned threads = 1) {
  ChoiceOptions options;
  options.count = count;
  options.threads = threads;
  return choose_balls(frames, start, options).value();
}

/// The greatest value of any three candidates.
double best_of_three(const std::vector<CandidateFrame>& frames) {
  const auto count = static_cast<std::uint32_t>(frames.front().balls.size());
  double best = 0;
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = a + 1; b < count; ++b) {
      for (std::uint32_t c = b + 1; c < count; ++c) best = std::max(best, value_of(frames, {a, b, c}));
    }
  }
  return best;
}

TEST(ChooseBalls, IsAsGoodAsTheBoundOfTheGreedyChoice) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const std::vector<CandidateFrame> frames = wandering(9, 3, seed);
    const MotionChoice choice = choose(frames, 3);
    ASSERT_EQ(choice.chosen.size(), 3u);
    EXPECT_NEAR(choice.value, value_of(frames, choice.chosen), 1e-9 * choice.value) << "as measured anew";
    EXPECT_GE(choice.value, (1 - 1 / std::numbers::e) * best_of_three(frames)) << seed;
  }
}

/// The greatest value after the candidate with the greatest gain has taken the place of a chosen one.
double best_exchange(const std::vector<CandidateFrame>& frames, const MotionChoice& choice) {
  double best = 0;
  std::uint32_t added = 0;
  for (std::uint32_t c = 0; c < frames.front().balls.size(); ++c) {
    if (std::ranges::find(choice.chosen, c) != choice.chosen.end()) continue;
    std::vector<std::uint32_t> with = choice.chosen;
    with.push_back(c);
    const double value = value_of(frames, with);
    if (value <= best) continue;
    best = value;
    added = c;
  }
  double greatest = 0;
  for (std::size_t out = 0; out < choice.chosen.size(); ++out) {
    std::vector<std::uint32_t> other = choice.chosen;
    other[out] = added;
    greatest = std::max(greatest, value_of(frames, other));
  }
  return greatest;
}

TEST(ChooseBalls, EndsWhereNoExchangeOfTheBestOneHelps) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const std::vector<CandidateFrame> frames = wandering(40, 4, seed);
    const MotionChoice choice = choose(frames, 8);
    EXPECT_LE(best_exchange(frames, choice), choice.value * (1 + 2e-6)) << seed;
  }
}

TEST(ChooseBalls, IsNeverWorseThanWhatItIsGiven) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const std::vector<CandidateFrame> frames = wandering(60, 3, seed);
    std::vector<std::uint32_t> start;
    for (std::uint32_t c = 0; c < 10; ++c) start.push_back(6 * c);
    const MotionChoice choice = choose(frames, 10, start);
    EXPECT_EQ(choice.chosen.size(), 10u);
    EXPECT_GT(choice.value, value_of(frames, start)) << "of any ten, some can be exchanged";
    EXPECT_NEAR(choice.value, value_of(frames, choice.chosen), 1e-9 * choice.value);
  }
}

/// Large balls, and small ones that are inside them in some frames: their power cells are empty there.
std::vector<CandidateFrame> nested(std::size_t large, std::size_t small, std::size_t frames, unsigned seed) {
  std::vector<CandidateFrame> made = wandering(large, frames, seed);
  std::mt19937 random(seed + 1000);
  for (std::size_t f = 0; f < frames; ++f) {
    const std::vector<Ball> outer = made[f].balls;
    for (std::size_t i = 0; i < small; ++i) {
      // In half of the frames it is 0.3 of the radius from the centre, and reaches out of the ball in the others.
      const Ball& home = outer[i % large];
      Ball ball = {home.centre, 0.6 * home.radius};
      ball.centre[random() % 3] += (random() % 2 == 0 ? 0.3 : 1.1) * home.radius;
      made[f].balls.push_back(ball);
    }
  }
  return made;
}

// A hidden ball alters no power cell but its own, as it comes and as it goes; what the balls around it add depends on
// it nevertheless. Here the first exchange removes the hidden one. Before, the outer one adds an eighth of its volume,
// and afterwards all of it: it must not be exchanged for the last candidate, which has little more than an eighth.
TEST(ChooseBalls, WhatABallAddsGrowsWhenOneInsideItGoes) {
  const Ball outer = {{0, 0, 0}, 1}, hidden = {{0, 0, 0}, std::cbrt(0.875)};
  const Ball better = {{5, 0, 0}, 0.7}, eighth = {{9, 0, 0}, 0.5 * (1 + 1e-7)};
  const std::vector<CandidateFrame> frames = {{{outer, hidden, better, eighth}, 1}};
  const MotionChoice choice = choose(frames, 2, {0, 1});
  EXPECT_EQ(choice.chosen, (std::vector<std::uint32_t>{0, 2}));
  EXPECT_GE(choice.value, value_of(frames, {0, 1}));
}

// With losses that are too small or too great, exchanges end at once or go on for nothing.
TEST(ChooseBalls, HiddenBallsCount) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const std::vector<CandidateFrame> frames = nested(6, 18, 3, seed);
    std::vector<std::uint32_t> start;
    for (std::uint32_t c = 0; c < 24; c += 3) start.push_back(c);
    const MotionChoice choice = choose(frames, start.size(), start);
    EXPECT_NEAR(choice.value, value_of(frames, choice.chosen), 1e-9 * choice.value) << seed;
    EXPECT_GE(choice.value, value_of(frames, start)) << seed;
    EXPECT_LE(best_exchange(frames, choice), choice.value * (1 + 2e-6)) << seed;
  }
}

// The first is the best one at rest, but nearly vanishes in the other frames.
TEST(ChooseBalls, AllFramesCount) {
  const Ball large = {{0, 0, 0}, 1}, small = {{0, 0, 0}, 0.1}, other = {{5, 0, 0}, 0.9};
  const std::vector<CandidateFrame> frames = {{{large, other}, 1}, {{small, other}, 1}, {{small, other}, 1}};
  EXPECT_EQ(choose(frames, 1).chosen, std::vector<std::uint32_t>{1});
  EXPECT_EQ(choose(frames, 1, {0}).chosen, std::vector<std::uint32_t>{1}) << "by an exchange";
  const std::vector<CandidateFrame> mostly_rest = {{{large, other}, 9}, {{small, other}, 1}};
  EXPECT_EQ(choose(mostly_rest, 1).chosen, std::vector<std::uint32_t>{0}) << "by its weight";
}

TEST(ChooseBalls, WhatAddsNothingIsLeftOut) {
  const Ball outer = {{0, 0, 0}, 1}, inner = {{0.1, 0, 0}, 0.5}, lost = {{9, 9, 9}, 0};
  const std::vector<CandidateFrame> frames = {{{inner, lost, outer}, 1}};
  const MotionChoice choice = choose(frames, 3);
  EXPECT_EQ(choice.chosen, std::vector<std::uint32_t>{2});
  EXPECT_EQ(choose(frames, 100).chosen, std::vector<std::uint32_t>{2}) << "more than there are";
}

TEST(ChooseBalls, ThreadsDoNotMatter) {
  const std::vector<CandidateFrame> frames = wandering(80, 5, 11);
  const MotionChoice one = choose(frames, 12), four = choose(frames, 12, {}, 4);
  EXPECT_EQ(one.chosen, four.chosen);
  EXPECT_EQ(one.value, four.value);
}

TEST(ChooseBalls, Errors) {
  ChoiceOptions options;
  const std::vector<CandidateFrame> frames = wandering(5, 2, 1);
  options.goes_on = [](double) { return false; };
  EXPECT_EQ(choose_balls(frames, {}, options).error().code, ErrorCode::kInterrupted);
  const std::vector<CandidateFrame> none(1);
  EXPECT_EQ(choose_balls(none, {}, ChoiceOptions()).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk
