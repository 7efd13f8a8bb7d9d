// Frames of balls that follow a mesh allocate nothing, in motions that do not repeat, with steps towards more volume
// and where balls are chosen anew. No device is needed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "faults/failing_new.h"
#include "medial_vk/follower.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

constexpr int kFramesOfMotion = 10'000;

/// A torus that is twisted, bent and rippled, with periods that have no common multiple.
class TorusInMotion {
 public:
  const IndexedMesh& mesh() const { return mesh_; }

  /// Off the middle of the tube, of different sizes.
  static std::vector<Ball> balls(int count) {
    std::vector<Ball> all;
    all.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const double turn = 0.31 * i, away = 1 + 0.15 * std::sin(0.7 * i);
      all.push_back({{away * std::cos(turn), away * std::sin(turn), 0.15 * std::cos(0.7 * i)}, 0.08 + 0.1 * (i % 2)});
    }
    return all;
  }

  const std::vector<Point>& frame(int i) {
    const double twist = std::sin(0.031 * i), bend = 0.3 * std::sin(0.0231 * i), ripple = 0.03 * std::sin(0.0417 * i);
    for (std::size_t k = 0; k < moved_.size(); ++k) {
      const Point& p = mesh_.view().vertices[k];
      const double cosine = std::cos(twist * p[1]), sine = std::sin(twist * p[1]);
      const double across = ripple * std::sin(9 * p[1] + 0.013 * i);
      moved_[k] = {cosine * p[0] - sine * p[2] + across, p[1] + bend * p[0] * p[0], sine * p[0] + cosine * p[2]};
    }
    return moved_;
  }

 private:
  IndexedMesh mesh_ = indexed(prepare(make_torus(1.0, 0.4, 24, 12)));
  std::vector<Point> moved_ = std::vector<Point>(mesh_.view().vertices.size());
};

struct Counts {
  int allocating = 0, with_exchanges = 0;
};

/// The frames that allocate on this thread; such a frame is computed again. Each `of_run` frames start from the rest
/// pose: where balls have been chosen anew, they are again only where more has become uncovered.
Counts follow(const FollowerOptions& options, int balls, int frames, int of_run) {
  TorusInMotion torus;
  Follower follower = Follower::create(torus.mesh(), TorusInMotion::balls(balls), options).value();
  Counts counts;
  for (int i = 0; i < frames; ++i) {
    const std::vector<Point>& frame = torus.frame(i);
    fail_new(1);
    const Status status = in_runtime([&]() -> Status {
      if (i % of_run == 0) {
        if (Status reset = follower.reset(); !reset) return reset;
      }
      return follower.update(frame);
    });
    const bool has_allocated = stop_failing_new();
    EXPECT_NE(status.ok(), has_allocated);
    if (has_allocated) {
      ++counts.allocating;
      EXPECT_TRUE(follower.update(frame).ok());
    }
    counts.with_exchanges += std::ranges::count(follower.origins(), FollowOrigin::kRenewed) > 0 ? 1 : 0;
  }
  return counts;
}

TEST(FollowerAllocations, StepsOfALongMotionAllocateNothingFromTheFirstFrameOn) {
  const Counts counts = follow({.threads = 1}, 24, kFramesOfMotion, kFramesOfMotion);
  EXPECT_EQ(counts.allocating, 0);
}

TEST(FollowerAllocations, BallsChosenAnewAllocateNothingFromTheFirstFrameOn) {
  const Counts counts = follow({.renewed = 4, .renewal_factor = 1, .threads = 1}, 40, 1'000, 10);
  EXPECT_EQ(counts.allocating, 0);
  EXPECT_GT(counts.with_exchanges, 50);
}

/// On the caller's thread; the others have the same room.
TEST(FollowerAllocations, NeitherDoSeveralThreads) {
  const Counts counts = follow({.renewed = 4, .renewal_factor = 1, .threads = 3}, 150, 200, 10);
  EXPECT_EQ(counts.allocating, 0);
  EXPECT_GT(counts.with_exchanges, 10);
}

/// So that counting is known to work: what a follower is made of is allocated.
TEST(FollowerAllocations, OfCreationAreSeen) {
  const TorusInMotion torus;
  const std::vector<Ball> balls = TorusInMotion::balls(9);
  fail_new(1);
  const Result<Follower> made = in_runtime([&] { return Follower::create(torus.mesh(), balls, {.threads = 1}); });
  EXPECT_TRUE(stop_failing_new());
  EXPECT_FALSE(made.ok());
}

}  // namespace
}  // namespace medial_vk::test
