// Balls that follow a motion for as long as a program runs.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

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

// A block of 32 bytes, the least, that stays behind in each of 9,000 frames would be more than that.
TEST(LongMotion, TenThousandFramesTakeNoMoreMemory) {
  const IndexedMesh mesh = indexed(prepare(make_torus(1.0, 0.4, 16, 8)));
  std::vector<Ball> balls;
  for (int i = 0; i < 20; ++i) balls.push_back({{std::cos(0.3 * i), std::sin(0.3 * i), 0}, 0.25});
  FollowerOptions options;
  options.steps = 1;
  options.threads = 1;
  Follower follower = Follower::create(mesh, balls, options).value();
  std::vector<Point> bent(mesh.view().vertices.size());
  constexpr int kFrames = 10'000, kWarmUp = 1'000;
  std::size_t before = 0;
  double greatest = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    if (frame == kWarmUp) before = bytes_in_use();
    for (std::size_t i = 0; i < bent.size(); ++i) {
      bent[i] = mesh.view().vertices[i];
      bent[i][2] += 0.2 * std::sin(0.01 * frame) * bent[i][0] * bent[i][0];
    }
    ASSERT_TRUE(follower.update(bent).ok());
    greatest = std::max(greatest, std::fabs(follower.balls().front().centre[2]));
  }
  const std::size_t after = bytes_in_use();
  std::cout << "bytes in use after " << kWarmUp << " frames: " << before << ", after " << kFrames << ": " << after
            << "\n";
  EXPECT_GT(greatest, 0.05);  // they did move
  EXPECT_LE(after, before + kKept);
}

}  // namespace
}  // namespace medial_vk::test
