// The nearest of many bodies against the distances of all.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/nearest_bodies.h"
#include "medial_vk/prepare.h"
#include "support/indexed.h"
#include "support/random_poses.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

Body ball_body(const Ball& ball) { return Body::create(std::vector<Ball>{ball}, std::vector<Ball>{ball}).value(); }

/// What is promised, from the true distances, which are known to within `error`.
void expect_promised(const NearBodies& found, const std::vector<double>& exact, const NearestBodiesOptions& options,
                     double error) {
  std::set<std::size_t> named;
  for (const NearBody& body : found.bodies) {
    EXPECT_TRUE(named.insert(body.index).second) << "body " << body.index << " is named twice";
    EXPECT_LE(body.lower, exact[body.index] + error);
    EXPECT_GE(body.upper, std::min(exact[body.index], options.limit) - error);
  }
  std::vector<double> sorted = exact;
  std::ranges::sort(sorted);
  const double kth = options.count <= sorted.size() ? sorted[options.count - 1] : kInfinite;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (named.contains(i)) continue;
    EXPECT_GE(exact[i], found.others - error) << "body " << i;
    EXPECT_TRUE(exact[i] >= kth - error || exact[i] > options.limit - error) << "body " << i;
  }
  const auto within =
      static_cast<std::size_t>(std::ranges::count_if(exact, [&](double d) { return d <= options.limit - error; }));
  EXPECT_GE(found.bodies.size(), std::min(options.count, within));
  EXPECT_EQ(found.others == kInfinite, named.size() == exact.size());
  EXPECT_TRUE(std::ranges::is_sorted(found.bodies, {}, &NearBody::upper));
}

TEST(NearestBodies, OfBallsAreThoseOfAllDistances) {
  Random random(1);
  for (const std::size_t count : {1, 2, 8, 9, 100, 700}) {
    for (const double size : {1e-6, 1.0, 1e6}) {
      std::vector<PlacedBody> bodies;
      std::vector<Ball> balls;
      for (std::size_t i = 0; i < count; ++i) {
        const Ball ball{point_in_cube(random, size), uniform(random, 0, 0.1 * size)};
        const Pose pose = any_pose(random, point_in_cube(random, 5 * size));
        bodies.push_back({ball_body(ball), pose});
        balls.push_back({pose * ball.centre, ball.radius});
      }
      const PlacedBodies among = PlacedBodies::create(bodies).value();
      for (const std::size_t k : {1, 3, 200}) {
        const Ball ball{point_in_cube(random, size), 0.1 * size};
        const Pose pose = k == 3 ? Pose{} : any_pose(random, point_in_cube(random, 5 * size));
        std::vector<double> exact;
        for (const Ball& other : balls) {
          exact.push_back(std::max(0.0, length(other.centre - pose * ball.centre) - ball.radius - other.radius));
        }
        NearestBodiesOptions options;
        options.count = k;
        if (k == 200) options.limit = 4 * size;
        const NearBodies found = nearest_bodies(among, ball_body(ball), pose, options).value();
        SCOPED_TRACE(testing::Message() << count << " bodies of size " << size << ", k " << k);
        expect_promised(found, exact, options, 1e-14 * 40 * size);
        // One ball a body: bounds are exact but for float, so that few bodies beyond k are near enough to be named.
        if (count > 2 * k && k < 200) {
          EXPECT_LE(found.bodies.size(), 2 * k + 5);
        }
      }
    }
  }
}

TEST(NearestBodies, OfMeshesAreThoseOfTheirTriangles) {
  Random random(2);
  const std::vector<Mesh> meshes = {make_box({1, 0.5, 0.2}), make_sphere(0.4, 80), make_torus(0.5, 0.2, 8, 8)};
  std::vector<Body> shapes;
  for (const Mesh& mesh : meshes) shapes.push_back(Body::create(indexed(prepare_mesh(mesh).value())).value());
  std::vector<PlacedBody> bodies;
  for (int i = 0; i < 80; ++i) {
    bodies.push_back({shapes[static_cast<std::size_t>(i) % 3], any_pose(random, point_in_cube(random, 4))});
  }
  const PlacedBodies among = PlacedBodies::create(bodies).value();
  for (int query = 0; query < 12; ++query) {
    const Body& body = shapes[static_cast<std::size_t>(query) % 3];
    // In the frame of the world, and turned: then distances are those in the frame of the body, up to rounding.
    const Pose pose = query % 2 == 0 ? Pose{} : any_pose(random, point_in_cube(random, 3));
    std::vector<double> exact;
    Pose inverse;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) inverse.rotation[i][j] = pose.rotation[j][i];
    }
    inverse.shift = -1.0 * (Pose{inverse.rotation, {0, 0, 0}} * pose.shift);
    for (const PlacedBody& other : bodies) {
      const Distance apart = distance(body, other.body, inverse * other.pose).value();
      exact.push_back(0.5 * (apart.lower + apart.upper));
    }
    NearestBodiesOptions options;
    options.count = 5;
    const NearBodies found = nearest_bodies(among, body, pose, options).value();
    SCOPED_TRACE(testing::Message() << "query " << query);
    expect_promised(found, exact, options, 1e-12);
    const auto hits = static_cast<std::size_t>(std::ranges::count_if(exact, [](double d) { return d < 1e-12; }));
    EXPECT_EQ(found.bodies.size(), std::max<std::size_t>(5, hits));
    for (const NearBody& near : found.bodies) EXPECT_LE(near.upper - near.lower, 1e-12);
  }
}

TEST(NearestBodies, ThoseThatOverlapAreAllNamed) {
  const Body unit = ball_body({{0, 0, 0}, 1});
  std::vector<PlacedBody> bodies;
  for (int i = 0; i < 6; ++i) bodies.push_back({unit, make_pose({0.1 * i, 0, 0}, {0, 0, 0})});
  bodies.push_back({unit, make_pose({5, 0, 0}, {0, 0, 0})});
  const PlacedBodies among = PlacedBodies::create(bodies).value();
  const NearBodies found = nearest_bodies(among, unit, Pose{}, {.count = 2}).value();
  ASSERT_EQ(found.bodies.size(), 6u);
  for (const NearBody& near : found.bodies) EXPECT_EQ(near.upper, 0);
  EXPECT_GT(found.others, 2.9);
}

// Without a cover nothing is known of how far a body reaches, and without balls inside nothing of how near it is.
TEST(NearestBodies, OfBodiesWithOneSetOnly) {
  const std::vector<Ball> unit = {{{0, 0, 0}, 1}};
  const Body inside = Body::create(unit, {}).value(), cover = Body::create({}, unit).value();
  const std::vector<PlacedBody> bodies = {{inside, make_pose({9, 0, 0}, {0, 0, 0})},
                                          {cover, make_pose({4, 0, 0}, {0, 0, 0})},
                                          {ball_body(unit[0]), make_pose({6, 0, 0}, {0, 0, 0})}};
  const PlacedBodies among = PlacedBodies::create(bodies).value();
  const NearBodies found = nearest_bodies(among, ball_body(unit[0]), Pose{}).value();
  ASSERT_EQ(found.bodies.size(), 3u);
  EXPECT_EQ(found.bodies[0].index, 2u);
  EXPECT_NEAR(found.bodies[0].upper, 4, 1e-4);
  EXPECT_EQ(found.bodies[1].index, 0u);
  EXPECT_EQ(found.bodies[1].lower, 0);
  EXPECT_NEAR(found.bodies[1].upper, 7, 1e-4);
  EXPECT_EQ(found.bodies[2].index, 1u);
  EXPECT_NEAR(found.bodies[2].lower, 2, 1e-4);
  EXPECT_EQ(found.bodies[2].upper, kInfinite);
}

TEST(NearestBodies, OfNoneAndOfWrongOptions) {
  const Body unit = ball_body({{0, 0, 0}, 1});
  const PlacedBodies none = PlacedBodies::create({}).value();
  EXPECT_EQ(none.size(), 0u);
  EXPECT_TRUE(nearest_bodies(none, unit, Pose{}).value().bodies.empty());
  const auto message = [&](const Pose& pose, const NearestBodiesOptions& options) {
    const Result<NearBodies> found = nearest_bodies(none, unit, pose, options);
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
    return found.error().message;
  };
  EXPECT_THAT(message({}, {.count = 0}), testing::HasSubstr("`count`"));
  EXPECT_THAT(message({}, {.limit = -1}), testing::HasSubstr("`limit`"));
  EXPECT_THAT(message({}, {.tolerance = kInfinite}), testing::HasSubstr("`tolerance`"));
  EXPECT_THAT(message(make_pose({1e19, 0, 0}, {0, 0, 0}), {}), testing::HasSubstr("`pose` of the body"));
  const std::vector<PlacedBody> far = {{unit, Pose{}}, {unit, make_pose({std::nan(""), 0, 0}, {0, 0, 0})}};
  EXPECT_THAT(PlacedBodies::create(far).error().message, testing::HasSubstr("`pose` of body 1"));
}

}  // namespace
}  // namespace medial_vk
