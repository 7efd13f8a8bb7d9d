// Unions of balls that move keep the memory of those before. No device is needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ball_unions/unions/union_measurer.h"
#include "base/split_mix.h"
#include "faults/failing_new.h"
#include "medial_vk/dynamic_union.h"
#include "threads/worker_pool.h"

namespace medial_vk::test {
namespace {

constexpr int kFewest = 20, kMost = 120;

/// A ball with `neighbours` smaller ones on it; the others of them are far away. The places are not quite regular,
/// since exact arithmetic allocates.
std::vector<Ball> balls_around_one(int neighbours) {
  SplitMix random(3);
  std::vector<Ball> balls = {{{0, 0, 0}, 1}};
  for (int i = 0; i < kMost; ++i) {
    const double z = 1 - (2 * i + 1.0) / neighbours, across = std::sqrt(std::max(0.0, 1 - z * z)), angle = 2.399963 * i;
    Point centre = {across * std::cos(angle), across * std::sin(angle), z};
    if (i >= neighbours) centre = {10 + 0.5 * i, 0, 0};
    for (double& x : centre) x += 0.01 * random.symmetric();
    balls.push_back({centre, 0.3});
  }
  return balls;
}

/// Whether the union needs more memory: the first allocation fails, and then it is measured again.
bool allocates(UnionMeasurer& measurer, const std::vector<Ball>& balls, WorkerPool& pool) {
  const auto measure = [&] { return measurer.measure(balls, false, pool).ok(); };
  fail_new(1);
  const bool is_measured = in_runtime(measure);
  if (!stop_failing_new()) return false;
  EXPECT_FALSE(is_measured);
  EXPECT_TRUE(measure());
  return true;
}

// Room for cells grows with their planes by shares, not one by one.
TEST(UnionAllocations, CellsThatGrowByOnePlaneSeldomAllocate) {
  UnionMeasurer measurer;
  WorkerPool pool(1);
  int unions = 0;
  for (int neighbours = kFewest; neighbours < kMost; ++neighbours) {
    if (allocates(measurer, balls_around_one(neighbours), pool)) ++unions;
  }
  EXPECT_LT(unions, (kMost - kFewest) / 3);
}

/// Of so many balls: of every number, and with a ball that touches all others, the largest cell there is.
TEST(UnionAllocations, WithRoomForThemUnionsAllocateNothing) {
  for (const unsigned threads : {1u, 3u}) {
    UnionMeasurer measurer;
    WorkerPool pool(threads);
    measurer.make_room(kMost + 1, true, pool);
    for (int neighbours = kMost; neighbours > 0; neighbours -= 7) {
      const std::vector<Ball> balls = balls_around_one(neighbours);
      for (const bool complex : {false, true}) {
        fail_new(1);
        EXPECT_TRUE(in_runtime([&] { return measurer.measure(balls, complex, pool); }).ok());
        EXPECT_FALSE(stop_failing_new()) << neighbours;
      }
    }
  }
}

/// A union that is filled again and changed, after make_room().
TEST(UnionAllocations, ADynamicUnionIsChangedInTheMemoryThatItHas) {
  const std::vector<Ball> balls = balls_around_one(60);
  DynamicUnion all = std::move(DynamicUnion::build(kMost + 1, 200)).value();
  for (const Ball& ball : balls) ASSERT_TRUE(all.add(ball).ok());
  ASSERT_TRUE(all.make_room().ok());
  fail_new(1);
  EXPECT_TRUE(in_runtime([&] { return all.clear(200); }).ok());
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    for (std::uint32_t i = 0; i <= kMost; ++i) {
      const Ball& ball = balls[(i + 7 * static_cast<std::uint32_t>(round)) % balls.size()];
      const Status status = in_runtime([&]() -> Status {
        if (round > 0) return all.move(i, ball);
        const Result<std::uint32_t> slot = all.add(ball);
        return slot ? Status{} : Status{slot.error()};
      });
      ASSERT_TRUE(status.ok());
    }
    if (round > 0) in_runtime([&] { all.undo(); });
    EXPECT_TRUE(in_runtime([&] { return all.loss(0); }).ok());
    EXPECT_TRUE(in_runtime([&] { return all.gain({{0.5, 0.5, 0}, 1}); }).ok());
  }
  EXPECT_FALSE(stop_failing_new());
}

}  // namespace
}  // namespace medial_vk::test
