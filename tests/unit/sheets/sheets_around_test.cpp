// The contributions of points to the sheets around them, against plain sums over all points.
#include "sheets/sheets_around.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Clusters on a grid of step 1, of negligible size, of one sheet or of several. A node that is no wider than a quarter
/// of a reach below 4 is all of one cluster.
class Clusters {
 public:
  Clusters(std::uint32_t seed, int sheets) : sheets_(sheets) {
    std::mt19937 random(seed);
    std::normal_distribution<double> aside(0, 1e-12);
    for (int x = 0; x < 6; ++x) {
      for (int y = 0; y < 6; ++y) {
        const auto points = static_cast<int>(1 + random() % 40);
        const auto own = static_cast<std::int32_t>(random() % static_cast<unsigned>(sheets));
        const bool mixed = random() % 2 == 0;
        for (int i = 0; i < points; ++i) {
          balls_.push_back({{x + aside(random), y + aside(random), aside(random)}, 0.1});
          weights_.push_back(0.5 * static_cast<double>(random() % 5));
          sheet_of_.push_back(mixed ? static_cast<std::int32_t>(random() % static_cast<unsigned>(sheets)) : own);
        }
      }
    }
  }

  const std::vector<Ball>& balls() const { return balls_; }
  std::int32_t sheet_of(std::size_t ball) const { return sheet_of_[ball]; }
  double weight_of(std::size_t ball) const { return weights_[ball]; }

  SheetsAround around() const {
    std::vector<std::uint32_t> order(balls_.size());
    std::iota(order.begin(), order.end(), 0u);
    return {balls_, sheet_of_, weights_, static_cast<std::size_t>(sheets_), order};
  }

  bool others_near(const Point& at, double reach, std::int32_t sheet) const {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      if (weights_[i] > 0 && sheet_of_[i] != sheet && length(balls_[i].centre - at) < reach) return true;
    }
    return false;
  }

  void divide(double amount, const Point& at, double reach, std::vector<double>& sheets) const {
    std::vector<double> weights;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      weights.push_back(weights_[i] * std::max(0.0, 1 - length(balls_[i].centre - at) / reach));
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      sheets[static_cast<std::size_t>(sheet_of_[i])] += amount * weights[i] / sum;
    }
  }

 private:
  int sheets_;
  std::vector<Ball> balls_;
  std::vector<std::int32_t> sheet_of_;
  std::vector<double> weights_;
};

// Against sums over all points, with balls of many reaches at once. A cluster is less than 20 deviations wide, so the
// error of its nearness is at most 2e-11 over the reach; no more than 36 x 40 points have a weight, of 2 at most, and
// their sum is at least 1/2, as the queried point has one.
TEST(SheetsAround, DividesAmongAllPointsWithinReach) {
  for (const int sheets : {2, 5, 300}) {
    SCOPED_TRACE(sheets);
    const Clusters clusters(static_cast<std::uint32_t>(sheets), sheets);
    const SheetsAround around = clusters.around();
    SheetsAround::Given given = around.nothing(), twice = around.nothing();
    std::vector<double> expected(static_cast<std::size_t>(sheets));
    double total = 0;
    for (std::size_t i = 0; i < clusters.balls().size(); i += 7) {
      if (clusters.weight_of(i) == 0) continue;
      const Point& at = clusters.balls()[i].centre;
      const std::array<double, 5> reaches = {0.3, 1.5, 2.2, 3.1, 3.9};
      const double reach = reaches[i % 5], amount = 1 + static_cast<double>(i % 3);
      EXPECT_EQ(around.others_near(at, reach, clusters.sheet_of(i)),
                clusters.others_near(at, reach, clusters.sheet_of(i)));
      EXPECT_TRUE(around.divide(amount, at, reach, i % 2 == 0 ? given : twice));
      clusters.divide(amount, at, reach, expected);
      total += amount;
    }
    given.add(twice);
    const std::vector<double> found = around.by_sheet(given);
    for (std::size_t k = 0; k < found.size(); ++k)
      EXPECT_NEAR(found[k], expected[k], 2 * total * 36 * 40 * 2 * 2e-11 / 0.3 / 0.5);
    EXPECT_NEAR(std::accumulate(found.begin(), found.end(), 0.0), total, 1e-12 * total);
  }
}

// Twelve points lie around the origin. At a distance of 3 two groups of six lie 1 apart and form a node of width 1. It
// counts as a whole from a reach of 4 on if it is all of one sheet, otherwise from 8 on.
TEST(SheetsAround, TakesNodesWholeThatAreSmallForTheReach) {
  std::vector<Ball> balls(12, {{0, 0, 0}, 1});
  for (int i = 0; i < 12; ++i) balls.push_back({{3, i < 6 ? -0.5 : 0.5, 0}, 1});
  std::vector<std::uint32_t> order(balls.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto share_of_the_near = [&](double reach, std::int32_t other_sheet) {
    std::vector<std::int32_t> sheet_of(24, 0);
    std::fill(sheet_of.begin(), sheet_of.begin() + 12, 1);
    std::fill(sheet_of.begin() + 18, sheet_of.end(), other_sheet);
    const std::vector<double> weights(24, 1);
    const SheetsAround around(balls, sheet_of, weights, 3, order);
    SheetsAround::Given given = around.nothing();
    EXPECT_TRUE(around.divide(1, {0, 0, 0}, reach, given));
    return around.by_sheet(given)[1];
  };
  const auto expected = [](double distance, double reach) { return 1 / (1 + (1 - distance / reach)); };
  const double apart = std::hypot(3, 0.5);
  EXPECT_NEAR(share_of_the_near(3.9, 0), expected(apart, 3.9), 1e-14);
  EXPECT_NEAR(share_of_the_near(4.1, 0), expected(3, 4.1), 1e-14);
  EXPECT_NEAR(share_of_the_near(7.9, 2), expected(apart, 7.9), 1e-14);
  EXPECT_NEAR(share_of_the_near(8.1, 2), expected(3, 8.1), 1e-14);
}

}  // namespace
}  // namespace medial_vk
