// The distribution of a number of balls among curves.
#include "part_fits/distribute_balls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace medial_vk {
namespace {

using testing::ElementsAre;

TEST(ShareOut, GivesWhereItCoversMost) {
  const NeedCurve large = {{8, 4, 2, 1, 0.5}, false}, small = {{0.8, 0.4, 0.2, 0.1, 0.05}, false}, ball = {{}, true};
  const std::vector<NeedCurve> curves = {small, ball, large};
  EXPECT_THAT(distribute_balls(curves, 3), ElementsAre(1, 1, 1));
  EXPECT_THAT(distribute_balls(curves, 4), ElementsAre(1, 1, 2));
  EXPECT_THAT(distribute_balls(curves, 6), ElementsAre(1, 1, 4));
  const std::vector<std::size_t> many = distribute_balls(curves, 100);
  EXPECT_EQ(many[1], 1u);
  EXPECT_EQ(many[0] + many[2], 99u);
  EXPECT_GT(many[2], many[0]);
  EXPECT_GT(many[0], 10u);
}

TEST(ShareOut, LooksBeyondABallThatDoesNotPayByItself) {
  const NeedCurve late = {{10, 10, 0}, false}, early = {{10, 9, 8}, false};
  EXPECT_THAT(distribute_balls(std::vector<NeedCurve>{early, late}, 4), ElementsAre(1, 3));
  const NeedCurve ball = {{}, true};
  EXPECT_THAT(distribute_balls(std::vector<NeedCurve>{ball, ball}, 9), ElementsAre(1, 1));
  const NeedCurve ends = {{3, 2, 1}, false, true};
  EXPECT_THAT(distribute_balls(std::vector<NeedCurve>{ends, early}, 12), ElementsAre(3, 9));
}

TEST(ShareOut, ByGapTheWidestGapIsAsNarrowAsItCanBe) {
  const auto with_gaps = [](std::vector<double> gaps, bool ends) {
    NeedCurve curve;
    curve.gaps = std::move(gaps);
    curve.ends = ends;
    return curve;
  };
  NeedCurve ball;
  ball.is_ball = true;
  const std::vector<NeedCurve> curves = {with_gaps({5, 3, 3, 2, 1}, false), ball,
                                         with_gaps({4, 4, 2.5, 1, 0.5}, false)};
  EXPECT_THAT(distribute_by_gap(curves, 3), ElementsAre(1, 1, 1));
  EXPECT_THAT(distribute_by_gap(curves, 4), ElementsAre(2, 1, 1));  // widest: 4
  EXPECT_THAT(distribute_by_gap(curves, 6), ElementsAre(2, 1, 3));  // widest: 3
  EXPECT_THAT(distribute_by_gap(curves, 8), ElementsAre(4, 1, 3));  // widest: 2.5
  // Beyond their ends, 1 and 0.5 fall by the root of the number: four times as many balls of the first one.
  const std::vector<std::size_t> many = distribute_by_gap(curves, 1001);
  EXPECT_NEAR(static_cast<double>(many[0]), 800, 2);
  EXPECT_THAT(distribute_by_gap(std::vector<NeedCurve>{with_gaps({5, 5}, true), with_gaps({1}, false)}, 9),
              ElementsAre(2, 7));
}

TEST(ShareOut, MoreInTotalGivesNoPartFewer) {
  // Bumpy curves, without smoothing.
  std::vector<NeedCurve> curves(4);
  for (std::size_t part = 0; part < curves.size(); ++part) {
    double error = 3.0 + 5.0 * static_cast<double>(part);
    for (std::size_t k = 1; k <= 400; ++k) {
      curves[part].uncovered.push_back(error);
      const double share = 0.9 / static_cast<double>(k) * ((k * 7 + part * 3) % 5 == 0 ? 1.9 : 0.4);
      error *= 1 - share;
    }
  }
  std::vector<std::size_t> before(curves.size(), 0);
  for (std::size_t total = curves.size(); total < 600; ++total) {
    const std::vector<std::size_t> counts = distribute_balls(curves, total);
    std::size_t sum = 0;
    for (std::size_t part = 0; part < counts.size(); ++part) {
      EXPECT_GE(counts[part], before[part]) << total;
      sum += counts[part];
    }
    EXPECT_EQ(sum, total);
    before = counts;
  }
}

}  // namespace
}  // namespace medial_vk
