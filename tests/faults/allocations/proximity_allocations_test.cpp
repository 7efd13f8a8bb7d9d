// Queries of distances allocate nothing, so that a control loop may call them. No device is needed.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <new>
#include <span>
#include <vector>

#include "faults/failing_new.h"
#include "medial_vk/body_group.h"
#include "medial_vk/collisions.h"
#include "medial_vk/proximity.h"
#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

/// A torus with balls along its circle, in it and around it.
Body torus_body() {
  const IndexedMesh mesh = indexed(prepare(make_torus(1.0, 0.4, 48, 24)));
  std::vector<Ball> inside, cover;
  for (int i = 0; i < 120; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 120;
    const Point centre = {std::cos(angle), std::sin(angle), 0};
    inside.push_back({centre, 0.38});
    cover.push_back({centre, 0.45});
  }
  return Body::create(mesh, inside, cover).value();
}

/// Far, near, linked like rings, touching and deep in each other.
std::vector<Pose> poses_of_tori() {
  std::vector<Pose> poses;
  for (int i = 0; i < 60; ++i) poses.push_back(make_pose({6 - 0.1 * i, 0.005 * i, 0.01 * i}, {0.1 * i, 0.02 * i, 0.3}));
  poses.push_back(make_pose({1, 0, 0}, {1.5707963, 0, 0}));
  poses.push_back(make_pose({2.8, 0, 0}, {0, 0, 0}));
  poses.push_back(Pose());
  return poses;
}

/// That the call makes no allocation on this thread: the first one would fail.
void expect_no_allocation(const char* what, const std::function<void()>& query) {
  fail_new(1);
  in_runtime([&] {
    try {
      query();
    } catch (const std::bad_alloc&) {
    }
  });
  EXPECT_FALSE(stop_failing_new()) << what;
}

class ProximityAllocations : public testing::Test {
 protected:
  const Body body_ = torus_body();
  const std::vector<Pose> poses_ = poses_of_tori();
};

/// What is made once allocates, and this program sees it.
TEST_F(ProximityAllocations, OfABodyAreSeen) {
  fail_new(1);
  const Result<Body> made = in_runtime([&] { return Body::create(body_.inside(), body_.cover()); });
  EXPECT_TRUE(stop_failing_new());
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().code, ErrorCode::kOutOfMemory);
}

TEST_F(ProximityAllocations, OfSingleQueriesAreNone) {
  const std::array<DistanceOptions, 4> options = {DistanceOptions{}, DistanceOptions{.tolerance = 0.01},
                                                  DistanceOptions{.limit = 0.5, .surfaces_only = true},
                                                  DistanceOptions{.most_comparisons = 5}};
  Distance last;
  DistanceBounds last_bounds;
  std::size_t free = 0, hit = 0;
  for (const Pose& pose : poses_) {
    expect_no_allocation("bounds", [&] { last_bounds = distance_bounds(body_, body_, pose); });
    expect_no_allocation("bounds from the last",
                         [&] { last_bounds = distance_bounds(body_, body_, pose, last_bounds); });
    expect_no_allocation("estimate", [&] { (void)estimated_distance(body_, body_, last_bounds); });
    expect_no_allocation("collide", [&] { (void)collide(body_, body_, pose); });
    for (const DistanceOptions& of_query : options) {
      expect_no_allocation("distance", [&] { last = distance(body_, body_, pose, of_query).value(); });
      expect_no_allocation("distance from the last",
                           [&] { last = distance(body_, body_, pose, of_query, last).value(); });
    }
    const Collision collision = collide(body_, body_, pose);
    free += collision == Collision::kFree ? 1 : 0;
    hit += collision == Collision::kHit ? 1 : 0;
  }
  EXPECT_GT(free, 10u);
  EXPECT_GT(hit, 10u);
}

/// On the calling thread; further threads are allocations of the system.
TEST_F(ProximityAllocations, OfBatchesAreNone) {
  std::vector<Distance> found(poses_.size());
  std::vector<DistanceBounds> bounds(poses_.size());
  std::vector<Collision> verdicts(poses_.size());
  std::vector<PosedPair> pairs;
  pairs.reserve(poses_.size());
  for (const Pose& pose : poses_) pairs.push_back({pose, 0, 1});
  const std::vector<Body> bodies = {body_, body_};
  expect_no_allocation("distances", [&] { (void)distances(body_, body_, poses_, found, {}, {1}).ok(); });
  expect_no_allocation("bounds", [&] { distance_bounds(body_, body_, poses_, bounds, {1}); });
  expect_no_allocation("bounds of pairs", [&] { distance_bounds(bodies, pairs, bounds, {1}); });
  expect_no_allocation("verdicts", [&] { collide_by_balls(body_, body_, poses_, verdicts, {1}); });
  expect_no_allocation("verdicts of pairs", [&] { collide_by_balls(bodies, pairs, verdicts, {1}); });
  EXPECT_GT(found.front().lower, 0);
  EXPECT_EQ(found.back().upper, 0);
  EXPECT_EQ(verdicts.front(), Collision::kFree);
  EXPECT_EQ(verdicts.back(), Collision::kHit);
}

TEST_F(ProximityAllocations, OfMotionsAndGroupsAreNone) {
  const std::vector<GroupPart> parts = {{body_, 0}, {body_, 1}, {body_, 2}};
  const std::vector<LinkPair> pairs = {{0, 1}, {0, 2}, {1, 2}};
  const BodyGroup group = BodyGroup::create(parts, 3, pairs).value();
  FirstContact contact;
  expect_no_allocation("first contact", [&] {
    contact = first_contact(body_, body_, {poses_[0], poses_[59], {0, 0, 0}}).value();
  });
  EXPECT_GT(contact.free_until, 0);
  EXPECT_LE(contact.contact_at, 1);
  std::vector<Pose> of_links;
  for (const Pose& pose : poses_) {
    of_links.insert(of_links.end(), {Pose(), pose, make_pose({-9 + pose.shift[0], 1, 0}, {0, 0, 1})});
  }
  LeastDistance last;
  for (const bool exact : {false, true}) {
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const std::span<const Pose> links = std::span<const Pose>(of_links).subspan(3 * i, 3);
      expect_no_allocation("least distance",
                           [&] { last = least_distance(group, links, {.exact = exact}, last).value(); });
    }
    std::vector<LeastDistance> least(poses_.size());
    expect_no_allocation("least distances",
                         [&] { (void)least_distances(group, of_links, least, {.exact = exact}, {1}).ok(); });
    EXPECT_GT(least.front().lower, 0);
    EXPECT_EQ(least.back().upper, 0);
  }
}

}  // namespace
}  // namespace medial_vk::test
