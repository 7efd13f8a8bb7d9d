// The creation of bodies: progress and stop.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stop_token>
#include <vector>

#include "medial_vk/prepare.h"
#include "medial_vk/proximity.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

TEST(Body, ReportsItsProgress) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_sphere(1, 2000)).value());
  for (const unsigned threads : {1u, 3u}) {
    std::vector<double> seen;
    ASSERT_TRUE(Body::create(mesh, {}, {}, {threads}, [&](double done) { seen.push_back(done); }));
    ASSERT_GT(seen.size(), 10u);
    EXPECT_TRUE(std::ranges::is_sorted(seen));
    EXPECT_GT(seen.front(), 0);
    EXPECT_EQ(seen.back(), 1);
  }
}

TEST(Body, EndsAtAStop) {
  const IndexedMesh mesh = test::indexed(prepare_mesh(test::make_sphere(1, 2000)).value());
  std::stop_source source;
  std::size_t calls = 0;
  const auto stop_early = [&](double) {
    ++calls;
    source.request_stop();
  };
  const Result<Body> body = Body::create(mesh, {}, {}, {2}, stop_early, source.get_token());
  ASSERT_FALSE(body);
  EXPECT_EQ(body.error().code, ErrorCode::kInterrupted);
  EXPECT_LE(calls, 3u);  // a node of each thread may be under way
}

/// The solid of an open mesh is its surface, which no ball lies in: an upper bound from a ball beside it would be
/// wrong.
TEST(Body, AnOpenMeshHasNoBallsInside) {
  Mesh open = test::make_box({2, 2, 2});
  open.triangles.pop_back();
  const IndexedMesh mesh = test::indexed(prepare_mesh(open).value());
  ASSERT_FALSE(mesh.prepared().report.closed);
  const std::vector<Ball> inside = {{{1, 1, 1}, 0.5}}, cover = {{{1, 1, 1}, 2}};
  const Result<Body> refused = Body::create(mesh, inside, cover);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("`inside` a mesh that is not closed"));
  EXPECT_TRUE(Body::create(mesh, {}, cover));
  EXPECT_TRUE(Body::create(test::indexed(prepare_mesh(test::make_box({2, 2, 2})).value()), inside, cover));
}

}  // namespace
}  // namespace medial_vk
