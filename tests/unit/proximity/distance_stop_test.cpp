// Stops of exact distances, of two bodies, of groups and of motions.
#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>
#include <vector>

#include "medial_vk/body_group.h"
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

/// The error of search(stop), which another thread runs, where a stop is requested after it has begun. It takes seconds
/// if it runs to its end, far more than the time between its beginning and the request.
template <class Search>
std::optional<ErrorCode> error_after_stop(const Search& search) {
  std::stop_source source;
  std::atomic<bool> has_begun = false;
  std::optional<ErrorCode> code;
  std::thread thread([&] {
    has_begun = true;
    const auto found = search(source.get_token());
    if (!found.ok()) code = found.error().code;
  });
  while (!has_begun) std::this_thread::yield();
  source.request_stop();
  thread.join();
  return code;
}

BodyGroup group_of(const Body& a, const Body& b) {
  const std::vector<GroupPart> parts = {{a, 0}, {b, 1}};
  const std::vector<LinkPair> pairs = {{0, 1}};
  return BodyGroup::create(parts, 2, pairs).value();
}

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

TEST(StoppedDistances, EndWithinAPose) {
  const Spheres spheres(12000);
  EXPECT_EQ(error_after_stop([&](const std::stop_token& stop) {
              return distance(spheres.outer, spheres.inner, Pose(), kSurfaces, {}, stop);
            }),
            ErrorCode::kInterrupted);
}

TEST(StoppedLeastDistances, EndWithAnErrorAndLeaveResultsAsTheyAre) {
  const std::vector<Ball> ball = {{{0, 0, 0}, 1}};
  const Body round = Body::create(ball, ball).value();
  const Spheres spheres(200);
  const BodyGroup of_balls = group_of(round, round), of_meshes = group_of(spheres.outer, spheres.inner);
  std::stop_source source;
  const std::stop_token stop = source.get_token();
  const std::vector<Pose> poses(2 * 300);
  EXPECT_TRUE(least_distance(of_balls, std::span(poses).first(2), {}, {}, stop).ok());
  source.request_stop();
  for (const bool exact : {false, true}) {
    const BodyGroup& group = exact ? of_meshes : of_balls;
    const GroupOptions options = {.exact = exact};
    const Result<LeastDistance> one = least_distance(group, std::span(poses).first(2), options, {}, stop);
    ASSERT_FALSE(one.ok());
    EXPECT_EQ(one.error().code, ErrorCode::kInterrupted);
    for (const unsigned threads : {1u, 3u}) {
      std::vector<LeastDistance> results(300);
      for (LeastDistance& result : results) result.upper = 4;
      const Status status = least_distances(group, poses, results, options, {threads}, stop);
      ASSERT_FALSE(status.ok());
      EXPECT_EQ(status.error().code, ErrorCode::kInterrupted);
      for (const LeastDistance& result : results) EXPECT_EQ(result.upper, 4);
    }
  }
}

// The tiny sphere is in the middle of a cavity, so that the solids are apart.
TEST(StoppedLeastDistances, EndWithinAConfiguration) {
  const Body shell = Body::create(test::indexed(prepare_mesh(test::make_shell(12000, 12000)).value())).value();
  const BodyGroup group = group_of(shell, Spheres::body_of(1e-6, 12000));
  EXPECT_EQ(error_after_stop([&](const std::stop_token& stop) {
              return least_distance(group, std::vector<Pose>(2), {.exact = true}, {}, stop);
            }),
            ErrorCode::kInterrupted);
}

// Boxes of a side of 1 that pass each other with a gap of 1e-6, so that a motion of 8 needs millions of distances.
TEST(StoppedFirstContact, EndsWithinAMotion) {
  const Body box = Body::create(test::indexed(prepare_mesh(test::make_box({1, 1, 1})).value())).value();
  Motion motion;
  motion.from.shift = {4, 1 + 1e-6, 0};
  motion.to.shift = {-4, 1 + 1e-6, 0};
  const ContactOptions options = {.tolerance = 1e-10};
  EXPECT_EQ(
      error_after_stop([&](const std::stop_token& stop) { return first_contact(box, box, motion, options, stop); }),
      ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
