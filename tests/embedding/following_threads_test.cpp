// Frames of a motion in parallel, each from the rest pose, by a follower for each thread: the balls are those of one
// follower that takes frame after frame. The ThreadSanitizer runs these tests (scripts/test --tsan).
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "medial_vk/cover_follower.h"
#include "medial_vk/follower.h"
#include "medial_vk/prepare.h"
#include "support/indexed.h"

namespace medial_vk::test {
namespace {

constexpr std::size_t kFollowingThreads = 4, kFrameCount = 12, kBallCount = 40;

/// A torus of radii 1 and 0.4 about the z axis.
Mesh ring() {
  constexpr std::uint32_t kAround = 16, kAlong = 40;
  Mesh mesh;
  for (std::uint32_t i = 0; i < kAlong; ++i) {
    for (std::uint32_t j = 0; j < kAround; ++j) {
      const double u = 2 * std::numbers::pi * i / kAlong, v = 2 * std::numbers::pi * j / kAround;
      const double radius = 1 + 0.4 * std::cos(v);
      mesh.vertices.push_back({radius * std::cos(u), radius * std::sin(u), 0.4 * std::sin(v)});
      const std::uint32_t next_i = (i + 1) % kAlong, next_j = (j + 1) % kAround;
      const std::uint32_t a = i * kAround + j, b = next_i * kAround + j, c = next_i * kAround + next_j;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, i * kAround + next_j});
    }
  }
  return mesh;
}

/// The ring, and frames that twist, squash and bend it more and more.
struct Moving {
  IndexedMesh mesh = indexed(prepare_mesh(ring()).value());
  std::vector<std::vector<Point>> frames;

  Moving() {
    for (std::size_t i = 1; i <= kFrameCount; ++i) {
      const double share = static_cast<double>(i) / kFrameCount;
      std::vector<Point> frame(mesh.view().vertices.begin(), mesh.view().vertices.end());
      for (Point& p : frame) {
        const double c = std::cos(0.5 * share * p[0]), s = std::sin(0.5 * share * p[0]);
        p = {p[0] * (1 - 0.2 * share), c * p[1] - s * p[2], s * p[1] + c * p[2] + 0.3 * share * p[0] * p[0]};
      }
      frames.push_back(std::move(frame));
    }
  }
};

std::vector<Ball> balls_on_the_axis(double radius) {
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < kBallCount; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kBallCount;
    balls.push_back({{std::cos(angle), std::sin(angle), 0}, radius});
  }
  return balls;
}

using BallsOfFrames = std::vector<std::vector<Ball>>;

/// The balls of all frames, which as many threads take one by one, each with a follower of its own.
template <class Make>
BallsOfFrames follow_on_threads(const Moving& moving, std::size_t threads, const Make& make) {
  BallsOfFrames results(moving.frames.size());
  std::atomic<std::size_t> next = 0, failures = 0;
  const auto work = [&] {
    auto follower = make();
    for (std::size_t i = next++; i < moving.frames.size(); i = next++) {
      if (!follower.reset() || !follower.update(moving.frames[i])) ++failures;
      results[i].assign(follower.balls().begin(), follower.balls().end());
    }
  };
  std::vector<std::thread> running;
  running.reserve(threads);
  for (std::size_t t = 0; t < threads; ++t) running.emplace_back(work);
  for (std::thread& thread : running) thread.join();
  EXPECT_EQ(failures, 0u);
  return results;
}

void expect_same_bytes(const BallsOfFrames& a, const BallsOfFrames& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].size(), kBallCount);
    ASSERT_EQ(b[i].size(), kBallCount);
    EXPECT_EQ(std::memcmp(a[i].data(), b[i].data(), a[i].size() * sizeof(Ball)), 0) << "frame " << i;
  }
}

template <class Make>
void expect_same_in_parallel(const Moving& moving, const Make& make) {
  const BallsOfFrames one_by_one = follow_on_threads(moving, 1, make);
  expect_same_bytes(follow_on_threads(moving, kFollowingThreads, make), one_by_one);
  EXPECT_NE(std::memcmp(one_by_one[0].data(), one_by_one[1].data(), kBallCount * sizeof(Ball)), 0);
}

TEST(FollowingThreads, FramesFromRestAreTheSameInParallel) {
  const Moving moving;
  const std::vector<Ball> balls = balls_on_the_axis(0.35);
  FollowerOptions options;
  options.steps = 1;
  options.threads = 1;
  expect_same_in_parallel(moving, [&] { return Follower::create(moving.mesh, balls, options).value(); });
}

TEST(FollowingThreads, CoversAreTheSameInParallel) {
  const Moving moving;
  const std::vector<Ball> balls = balls_on_the_axis(0.45);
  CoverFollowerOptions options;
  options.steps = 1;
  options.threads = 1;
  expect_same_in_parallel(moving, [&] { return CoverFollower::create(moving.mesh, balls, options).value(); });
}

}  // namespace
}  // namespace medial_vk::test
