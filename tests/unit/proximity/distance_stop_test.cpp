// Stops of exact distances.
#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "medial_vk/prepare.h"
#include "medial_vk/proximity.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// A tiny sphere in the middle of another one: all pairs of triangles are about as far apart, so that hardly any is
/// ruled out.
struct Spheres {
  explicit Spheres(std::uint32_t triangles) : outer(body_of(1, triangles)), inner(body_of(1e-6, triangles)) {}

  static Body body_of(double radius, std::uint32_t triangles) {
    return Body::create(test::indexed(prepare_mesh(test::make_sphere(radius, triangles)).value())).value();
  }

  Body outer, inner;
};

constexpr DistanceOptions kSurfaces = {.surfaces_only = true};

TEST(StoppedDistances, EndWithAnErrorAndLeaveResultsAsTheyAre) {
  const Spheres spheres(200);
  std::stop_source source;
  const std::stop_token stop = source.get_token();
  EXPECT_TRUE(distance(spheres.outer, spheres.inner, Pose(), kSurfaces, {}, stop).ok());
  source.request_stop();
  const Result<Distance> one = distance(spheres.outer, spheres.inner, Pose(), kSurfaces, {}, stop);
  ASSERT_FALSE(one.ok());
  EXPECT_EQ(one.error().code, ErrorCode::kInterrupted);
  for (const unsigned threads : {1u, 3u}) {
    const std::vector<Pose> poses(300);
    std::vector<Distance> results(poses.size(), Distance{.lower = 3, .upper = 4});
    const Status status = distances(spheres.outer, spheres.inner, poses, results, kSurfaces, {threads}, stop);
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().code, ErrorCode::kInterrupted);
    for (const Distance& result : results) EXPECT_EQ(result.upper, 4);
  }
}

// One pose takes seconds, far more than the time between the start of the search and the request.
TEST(StoppedDistances, EndWithinAPose) {
  const Spheres spheres(12000);
  std::stop_source source;
  std::atomic<bool> has_begun = false;
  std::optional<Result<Distance>> found;
  std::thread search([&] {
    has_begun = true;
    found = distance(spheres.outer, spheres.inner, Pose(), kSurfaces, {}, source.get_token());
  });
  while (!has_begun) std::this_thread::yield();
  source.request_stop();
  search.join();
  ASSERT_FALSE(found->ok());
  EXPECT_EQ(found->error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
