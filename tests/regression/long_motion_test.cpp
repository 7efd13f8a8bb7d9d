// Balls that follow a motion for as long as a program runs, by each kind of follower.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

#include "medial_vk/cover_follower.h"
#include "medial_vk/follower.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

std::size_t bytes_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// What glibc keeps of freed memory and counts as used: seven blocks of each of the 64 sizes 24, 40, ... 1,032 bytes,
/// with their headers.
constexpr std::size_t kKept = 7 * 64 * (24 + 1032) / 2 + 7 * 64 * 8;

constexpr int kFrames = 10'000, kWarmUp = 1'000;

struct LongMotion : testing::Test {
  IndexedMesh mesh = indexed(prepare(make_torus(1.0, 0.4, 16, 8)));
  std::vector<Point> bent = std::vector<Point>(mesh.view().vertices.size());
  std::size_t frames_with_exchanges = 0;

  static std::vector<Ball> beads(int count, double radius) {
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) {
      const double turn = 0.3 * i;
      balls.push_back({{std::cos(turn), std::sin(turn), 0}, radius});
    }
    return balls;
  }

  /// Many small balls off the middle of the tube, as medial points of a rough surface are.
  static std::vector<Ball> points(int count) {
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i) {
      const double turn = 0.3 * i, away = 1 + 0.15 * std::sin(0.7 * i);
      balls.push_back({{away * std::cos(turn), away * std::sin(turn), 0.15 * std::cos(0.7 * i)}, 0.1});
    }
    return balls;
  }

  /// A block of 32 bytes, the least, that stays behind in each of 9,000 frames would be more than what is kept.
  template <class AnyFollower>
  void expect_no_growth(AnyFollower& follower) {
    std::size_t before = 0;
    double greatest = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
      if (frame == kWarmUp) before = bytes_in_use();
      for (std::size_t i = 0; i < bent.size(); ++i) {
        bent[i] = mesh.view().vertices[i];
        bent[i][2] += 0.2 * std::sin(0.01 * frame) * bent[i][0] * bent[i][0];
      }
      ASSERT_TRUE(follower.update(bent).ok());
      if constexpr (requires { follower.origins(); }) {
        if (std::ranges::count(follower.origins(), FollowOrigin::kRenewed) > 0) ++frames_with_exchanges;
      }
      greatest = std::max(greatest, std::fabs(follower.balls().front().centre[2]));
    }
    const std::size_t after = bytes_in_use();
    std::cout << "bytes in use after " << kWarmUp << " frames: " << before << ", after " << kFrames << ": " << after
              << "\n";
    EXPECT_GT(greatest, 0.05);  // they did move
    EXPECT_LE(after, before + kKept);
  }
};

TEST_F(LongMotion, BallsTakeNoMoreMemory) {
  Follower follower = Follower::create(mesh, beads(20, 0.25), {.threads = 1}).value();
  expect_no_growth(follower);
}

TEST_F(LongMotion, ManyPointsTakeNoMoreMemory) {
  Follower follower = Follower::create(mesh, points(150), {.steps = 0, .threads = 1}).value();
  expect_no_growth(follower);
}

TEST_F(LongMotion, BallsAsPublishedTakeNoMoreMemory) {
  const FollowerOptions options = {.rule = FollowRule::kPublished, .threads = 1};
  Follower follower = Follower::create(mesh, beads(20, 0.25), options).value();
  expect_no_growth(follower);
}

TEST_F(LongMotion, CoversTakeNoMoreMemory) {
  CoverFollower follower = CoverFollower::create(mesh, beads(20, 0.5), {.steps = 1, .threads = 1}).value();
  expect_no_growth(follower);
}

/// Nor do frames with exchanges.
TEST_F(LongMotion, BallsChosenAnewTakeNoMoreMemory) {
  const FollowerOptions options = {.steps = 0, .renewed = 2, .renewal_factor = 1, .threads = 1};
  Follower follower = Follower::create(mesh, points(50), options).value();
  expect_no_growth(follower);
  EXPECT_GT(frames_with_exchanges, 100u);
}

}  // namespace
}  // namespace medial_vk::test
