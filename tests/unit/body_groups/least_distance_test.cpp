// Least distances of groups against all pairs of balls, in more than double, and against all pairs of parts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/body_group.h"
#include "medial_vk/prepare.h"
#include "support/indexed.h"
#include "support/random_poses.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

using LongPoint = std::array<long double, 3>;

LongPoint mapped(const Pose& pose, const LongPoint& p) {
  LongPoint out;
  for (std::size_t i = 0; i < 3; ++i) {
    out[i] = pose.shift[i];
    for (std::size_t j = 0; j < 3; ++j) out[i] += static_cast<long double>(pose.rotation[i][j]) * p[j];
  }
  return out;
}

LongPoint in_common_frame(const GroupPart& part, std::span<const Pose> poses, const Point& p) {
  return mapped(poses[part.link], mapped(part.pose, {p[0], p[1], p[2]}));
}

/// The least separation of two sets of balls of two parts; 0 if some overlap.
long double separation_of_sets(const GroupPart& a, std::span<const Ball> of_a, const GroupPart& b,
                               std::span<const Ball> of_b, std::span<const Pose> poses) {
  long double least = std::numeric_limits<double>::infinity();
  for (const Ball& p : of_a) {
    const LongPoint at = in_common_frame(a, poses, p.centre);
    for (const Ball& q : of_b) {
      const LongPoint other = in_common_frame(b, poses, q.centre);
      const long double x = at[0] - other[0], y = at[1] - other[1], z = at[2] - other[2];
      least = std::min(least, std::sqrt(x * x + y * y + z * z) - p.radius - q.radius);
    }
  }
  return std::max(0.0L, least);
}

struct Ends {
  long double lower = std::numeric_limits<double>::infinity(), upper = lower;
};

/// All parts of all compared links.
Ends all_pairs(const BodyGroup& group, std::span<const Pose> poses) {
  Ends ends;
  for (const LinkPair& links : group.pairs()) {
    for (const GroupPart& a : group.parts()) {
      if (a.link != links.a) continue;
      for (const GroupPart& b : group.parts()) {
        if (b.link != links.b) continue;
        ends.lower = std::min(ends.lower, separation_of_sets(a, a.body.cover(), b, b.body.cover(), poses));
        ends.upper = std::min(ends.upper, separation_of_sets(a, a.body.inside(), b, b.body.inside(), poses));
      }
    }
  }
  return ends;
}

/// Balls of random sizes, and the same balls with larger radii as their cover.
Body random_body(Random& random, std::size_t count, double size) {
  std::vector<Ball> inside, cover;
  for (std::size_t i = 0; i < count; ++i) {
    inside.push_back({point_in_cube(random, size), uniform(random, 0, 0.3 * size)});
    cover.push_back({inside.back().centre, 1.4 * inside.back().radius});
  }
  return Body::create(inside, cover).value();
}

constexpr std::size_t kLinks = 6;

/// Links 0 to 4 have up to three parts each, link 5 has forty: a scene. Links 1 and 2 are not compared.
BodyGroup random_group(Random& random, double part_shift) {
  std::vector<GroupPart> parts;
  for (std::uint32_t link = 0; link < kLinks; ++link) {
    const std::size_t count = link + 1 == kLinks ? 40 : random() % 4;
    for (std::size_t i = 0; i < count; ++i) {
      const double shift = link + 1 == kLinks ? 3 : part_shift;
      const Pose pose = i == 0 ? Pose() : any_pose(random, point_in_cube(random, shift));
      parts.push_back({random_body(random, 1 + random() % 20, 0.4), link, pose});
    }
  }
  std::vector<LinkPair> pairs;
  for (std::uint32_t a = 0; a < kLinks; ++a) {
    for (std::uint32_t b = a + 1; b < kLinks; ++b) {
      if (a != 1 || b != 2) pairs.push_back(random() % 2 == 0 ? LinkPair{a, b} : LinkPair{b, a});
    }
  }
  return BodyGroup::create(parts, kLinks, pairs).value();
}

std::vector<Pose> random_poses(Random& random, double spread, const Point& far) {
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < kLinks; ++i) poses.push_back(any_pose(random, far + point_in_cube(random, spread)));
  return poses;
}

/// A bound by float trees is this share of all lengths at most away from the distance of the sets, as in
/// distance_bounds_test.cpp; `size` bounds lengths.
constexpr double kAccuracy = 44 * 0x1p-24;

TEST(LeastDistance, ByBallsIsThatOfAllPairs) {
  Random random(1);
  std::array<int, 3> count = {0, 0, 0};
  for (int i = 0; i < 150; ++i) {
    const BodyGroup group = random_group(random, 1);
    const double spread = i % 3 == 0 ? 2 : i % 3 == 1 ? 4 : 20;
    const double far = i % 5 == 0 ? 1e6 : i % 5 == 1 ? 100 : 0;
    const std::vector<Pose> poses = random_poses(random, spread, point_in_cube(random, far));
    SCOPED_TRACE(testing::Message() << "group " << i);
    const Ends ends = all_pairs(group, poses);
    const LeastDistance found = least_distance(group, poses).value();
    EXPECT_LE(found.lower, ends.lower);
    EXPECT_GE(found.upper, ends.upper);
    if (found.upper == 0) {
      EXPECT_EQ(ends.upper, 0);
    } else {  // shifts, and no body reaches farther than 12 from its link; 20 * 2^-24 of it lets candidates pass
      const double size = 2 * (3 * (spread + far) + 24);
      EXPECT_GE(found.lower, static_cast<double>(ends.lower) - kAccuracy * size);
      EXPECT_LE(found.upper, static_cast<double>(ends.upper) + kAccuracy * size);
    }
    GroupOptions collisions;
    collisions.limit = 0;
    const LeastDistance decided = least_distance(group, poses, collisions).value();
    EXPECT_EQ(decided.collision(), found.collision());
    EXPECT_LE(decided.lower, ends.lower);
    ++count[static_cast<std::size_t>(found.collision())];
    // Any start gives bounds of the same accuracy.
    const LeastDistance again = least_distance(group, poses, {}, found).value();
    EXPECT_LE(again.lower, ends.lower);
    EXPECT_GE(again.upper, ends.upper);
    EXPECT_EQ(again.collision(), found.collision());
  }
  EXPECT_THAT(count, testing::Each(testing::Gt(10)));
}

TEST(LeastDistance, OfALimitIsProvedUpToIt) {
  Random random(2);
  for (int i = 0; i < 40; ++i) {
    const BodyGroup group = random_group(random, 1);
    const std::vector<Pose> poses = random_poses(random, 30, {});
    const Ends ends = all_pairs(group, poses);
    GroupOptions options;
    options.limit = uniform(random, 0, 3);
    const LeastDistance found = least_distance(group, poses, options).value();
    EXPECT_LE(found.lower, std::max<long double>(ends.lower, options.limit));
    EXPECT_GE(found.lower, std::min<long double>(ends.lower, options.limit) - 1e-3);
    if (ends.lower < options.limit) {
      EXPECT_LE(found.lower, ends.lower);
    }
    EXPECT_GE(found.upper, ends.upper);
  }
}

Body mesh_body(const Mesh& mesh) { return Body::create(indexed(prepare_mesh(mesh).value())).value(); }

/// Exact distances of all pairs of parts, by distance(), whose results all_pairs of triangles confirm elsewhere.
TEST(LeastDistance, ByTrianglesIsTheLeastOfAllPairs) {
  Random random(3);
  const std::vector<Body> bodies = {mesh_body(make_box({0.5, 0.2, 0.3})), mesh_body(make_sphere(0.3, 100)),
                                    mesh_body(make_torus(0.4, 0.1, 12, 16)), mesh_body(make_box({0.05, 0.05, 0.05}))};
  std::array<int, 3> count = {0, 0, 0};
  for (int i = 0; i < 60; ++i) {
    std::vector<GroupPart> parts;
    for (std::uint32_t link = 0; link < 5; ++link) {
      for (int k = 0; k < (link == 4 ? 12 : 1); ++k) {
        parts.push_back(
            {bodies[random() % bodies.size()], link, any_pose(random, point_in_cube(random, link == 4 ? 2 : 0.1))});
      }
    }
    const std::vector<LinkPair> pairs = {{0, 4}, {4, 1}, {2, 4}, {3, 4}, {0, 2}, {1, 3}};
    const BodyGroup group = BodyGroup::create(parts, 5, pairs).value();
    std::vector<Pose> poses;
    for (std::size_t k = 0; k < 5; ++k) poses.push_back(any_pose(random, point_in_cube(random, i % 2 == 0 ? 1.5 : 12)));
    double least = std::numeric_limits<double>::infinity();
    for (const LinkPair& links : pairs) {
      for (const GroupPart& a : parts) {
        for (const GroupPart& b : parts) {
          if (a.link != links.a || b.link != links.b) continue;
          const Pose of_a = poses[a.link] * a.pose, of_b = poses[b.link] * b.pose;
          Pose inverse;
          for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c) inverse.rotation[r][c] = of_a.rotation[c][r];
          }
          inverse.shift = -1.0 * (inverse * of_a.shift);
          least = std::min(least, distance(a.body, b.body, inverse * of_b).value().upper);
        }
      }
    }
    SCOPED_TRACE(testing::Message() << "group " << i);
    GroupOptions options;
    options.exact = true;
    const LeastDistance found = least_distance(group, poses, options).value();
    ++count[static_cast<std::size_t>(found.collision())];
    EXPECT_EQ(found.collision(), least > 0 ? Collision::kFree : Collision::kHit);
    // Lengths are below 100. 192 2^-53 of them as in distance_test.cpp, and 1.1 (3 * 2 * 3 * 8 + 40) 2^-53 * 2^4, which
    // PairQuery multiplies, of poses whose rotations are right to 8 * 2^-53.
    EXPECT_NEAR(found.upper, least, 8192 * 0x1p-53 * 100);
    EXPECT_NEAR(found.lower, least, 8192 * 0x1p-53 * 100);
    options.limit = 0;
    EXPECT_EQ(least_distance(group, poses, options).value().collision(), found.collision());
    options.limit = std::numeric_limits<double>::infinity();
    options.tolerance = 0.1;
    const LeastDistance coarse = least_distance(group, poses, options).value();
    EXPECT_LE(coarse.lower, found.upper);
    EXPECT_GE(coarse.upper, found.lower);
    if (coarse.upper > 0) {
      EXPECT_LE(coarse.upper - coarse.lower, 0.1 + 1e-9);
    }
  }
  EXPECT_GT(count[0], 5);
  EXPECT_GT(count[1], 5);
}

TEST(LeastDistance, OfManyConfigurationsDoesNotDependOnThreads) {
  Random random(4);
  const BodyGroup group = random_group(random, 1);
  constexpr std::size_t kCount = 200;
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::vector<Pose> of_one = random_poses(random, 8, {});
    poses.insert(poses.end(), of_one.begin(), of_one.end());
  }
  std::vector<LeastDistance> one(kCount), three(kCount);
  ASSERT_TRUE(least_distances(group, poses, one, {}, {1}));
  ASSERT_TRUE(least_distances(group, poses, three, {}, {3}));
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(one[i].lower, three[i].lower);
    EXPECT_EQ(one[i].upper, three[i].upper);
    const LeastDistance alone = least_distance(group, std::span(poses).subspan(i * kLinks, kLinks)).value();
    EXPECT_EQ(alone.collision(), one[i].collision());
  }
}

// Rotations of a long chain are not exact; a touch is decided only where it is certain.
TEST(LeastDistance, OfPartsThatTouchHoldsZero) {
  const Body box = mesh_body(make_box({1, 1, 1}));
  const std::vector<GroupPart> parts = {{box, 0, {}}, {box, 1, {}}};
  const BodyGroup group = BodyGroup::create(parts, 2, std::vector<LinkPair>{{0, 1}}).value();
  GroupOptions options;
  options.exact = true;
  const double span = box.has_mesh() ? 1 : 0;
  for (int i = 0; i < 50; ++i) {
    const Pose first = make_pose({0.1 * i, -3, 7}, {0.3 * i, 0.7, -0.2 * i});
    const std::vector<Pose> poses = {first, first * make_pose({span, 0, 0}, {0, 0, 0})};
    const LeastDistance found = least_distance(group, poses, options).value();
    EXPECT_LE(found.lower, 8 * 16 * 0x1p-53);  // what first * shift is wrong by, if anything
    EXPECT_LE(found.upper, 1e-12);
  }
}

TEST(LeastDistance, OfNothingIsInfinite) {
  const BodyGroup group = BodyGroup::create({}, 2, std::vector<LinkPair>{{0, 1}}).value();
  const LeastDistance found = least_distance(group, std::vector<Pose>(2)).value();
  EXPECT_EQ(found.collision(), Collision::kFree);
  EXPECT_EQ(found.lower, std::numeric_limits<double>::infinity());
  EXPECT_EQ(found.upper_pair, PartPair{});
}

TEST(LeastDistance, OfPosesOutOfRangeProvesNothing) {
  Random random(5);
  const Body body = random_body(random, 3, 1);
  const std::vector<GroupPart> parts = {{body, 0, {}}, {body, 1, {}}};
  const BodyGroup group = BodyGroup::create(parts, 2, std::vector<LinkPair>{{0, 1}}).value();
  for (const double x : {1e300, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Pose pose;
    pose.shift[1] = x;
    const LeastDistance found = least_distance(group, std::vector<Pose>{Pose(), pose}).value();
    EXPECT_EQ(found.collision(), Collision::kUndecided);
    EXPECT_EQ(found.upper, std::numeric_limits<double>::infinity());
  }
}

TEST(LeastDistance, RejectsWhatItCannotAnswer) {
  Random random(6);
  const Body body = random_body(random, 3, 1);
  const std::vector<Ball> ball = {{{0, 0, 0}, 1}};
  const Body inside_only = Body::create(ball, {}).value();
  const auto fails = [](const Result<BodyGroup>& group) {
    return !group.ok() && group.error().code == ErrorCode::kUsage;
  };
  const std::vector<GroupPart> good = {{body, 0, {}}, {body, 1, {}}};
  Pose mirror;
  mirror.rotation[2][2] = -1;
  Pose stretched;
  stretched.rotation[2][2] = 1.001;
  EXPECT_TRUE(fails(BodyGroup::create(std::vector<GroupPart>{{body, 2, {}}}, 2, {})));
  EXPECT_TRUE(fails(BodyGroup::create(good, 2, std::vector<LinkPair>{{0, 2}})));
  EXPECT_TRUE(fails(BodyGroup::create(good, 2, std::vector<LinkPair>{{1, 1}})));
  EXPECT_TRUE(fails(BodyGroup::create(std::vector<GroupPart>{{inside_only, 0, {}}}, 2, {})));
  EXPECT_TRUE(fails(BodyGroup::create(std::vector<GroupPart>{{body, 0, mirror}}, 2, {})));
  EXPECT_TRUE(fails(BodyGroup::create(std::vector<GroupPart>{{body, 0, stretched}}, 2, {})));
  EXPECT_TRUE(fails(BodyGroup::create(std::vector<GroupPart>{{body, 0, make_pose({2e18, 0, 0}, {0, 0, 0})}}, 2, {})));
  const BodyGroup group = BodyGroup::create(good, 2, std::vector<LinkPair>{{0, 1}}).value();
  GroupOptions exact, negative, no_number;
  exact.exact = true;
  negative.limit = -1;
  no_number.tolerance = std::numeric_limits<double>::quiet_NaN();
  for (const GroupOptions& options : {exact, negative, no_number}) {
    EXPECT_FALSE(least_distance(group, std::vector<Pose>(2), options));
  }
  EXPECT_FALSE(least_distance(group, std::vector<Pose>(3)));
  std::vector<LeastDistance> results(2);
  EXPECT_FALSE(least_distances(group, std::vector<Pose>(3), results));
}

}  // namespace
}  // namespace medial_vk
