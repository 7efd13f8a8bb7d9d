// The creation of bodies: progress and stop.
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

}  // namespace
}  // namespace medial_vk
