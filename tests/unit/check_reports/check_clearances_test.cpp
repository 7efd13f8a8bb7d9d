// The check of least distances by the reference: right intervals pass, and each kind of wrong one fails its condition.
#include "reference_bridge/check_clearances.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// Unit boxes at 0 on each of three links, of which the first two are compared with the third; the third is at x = 3,
/// and the second where `second` says.
class CheckClearances : public testing::Test {
 protected:
  CheckClearances() : mesh_(prepare_mesh(test::make_box({1, 1, 1}), {}).value()) {
    for (std::uint32_t link = 0; link < 3; ++link) solids_.around.push_back({&mesh_, link, {}});
    solids_.inside = solids_.around;
    solids_.are_same = true;
    solids_.pairs = {{0, 2}, {1, 2}};
  }

  /// The conditions that fail, as a word of the first letters of lower, upper, free, hit.
  std::string failures(double second, CheckedInterval interval) const {
    std::vector<Pose> poses(3);
    poses[1].shift[0] = second;
    poses[2].shift[0] = 3;
    const CheckReport report = check_clearances(solids_, poses, 3, {&interval, 1}, [](std::size_t) {});
    std::string failed;
    for (std::size_t i = 0; i < report.lines.size(); ++i) {
      if (report.lines[i].failed > 0) failed += "lufh"[i];
    }
    EXPECT_EQ(report.passed(), failed.empty());
    return failed;
  }

  PreparedMesh mesh_;
  CheckedSolids solids_;
};

TEST_F(CheckClearances, RightIntervalsPass) {
  EXPECT_EQ(failures(0, {2, 2}), "");
  EXPECT_EQ(failures(1, {0.5, 1.5}), "");
  EXPECT_EQ(failures(2.5, {0, 0}), "");
  EXPECT_EQ(failures(2, {0, 1e-15}), "");
  EXPECT_EQ(failures(0, {1, std::numeric_limits<double>::infinity()}), "");
}

TEST_F(CheckClearances, WrongOnesFail) {
  EXPECT_EQ(failures(1, {1.1, 1.2}), "l");
  EXPECT_EQ(failures(1, {0.5, 0.9}), "u");
  EXPECT_EQ(failures(2.5, {0.1, 0.2}), "lf");
  EXPECT_EQ(failures(1, {0, 0}), "h");
}

/// With a limit of 0 the lower end of all free configurations is the least number above 0.
TEST_F(CheckClearances, FreeOfALimitOfZeroIsTested) {
  const CheckedInterval free = {std::numeric_limits<double>::min(), std::numeric_limits<double>::infinity()};
  EXPECT_EQ(failures(1, free), "");
  EXPECT_EQ(failures(2.5, free), "f");
  EXPECT_EQ(failures(2 + 1e-9, free), "f");
  EXPECT_EQ(failures(3, free), "f");  // two links at one place
  EXPECT_EQ(failures(2, free), "");   // they touch: whether there is a common point is a matter of rounding
  const Mesh small = [] {
    Mesh box = test::make_box({0.2, 0.2, 0.2});
    test::translate(box, {0.4, 0.4, 0.4});
    return box;
  }();
  const PreparedMesh inner = prepare_mesh(small, {}).value();
  solids_.around[1].mesh = solids_.inside[1].mesh = &inner;
  EXPECT_EQ(failures(3, free), "f");  // one holds the other
}

/// Lower ends are those of the set around, upper ends those of the set inside.
TEST_F(CheckClearances, TwoSetsHoldEachEnd) {
  Mesh small = test::make_box({0.5, 1, 1});
  test::translate(small, {0.25, 0, 0});
  const PreparedMesh inner = prepare_mesh(small, {}).value();
  for (CheckedSolid& solid : solids_.inside) solid.mesh = &inner;
  solids_.are_same = false;
  EXPECT_EQ(failures(1, {1, 1.5}), "");
  EXPECT_EQ(failures(1, {1.1, 1.5}), "l");
  EXPECT_EQ(failures(1, {1, 1.4}), "u");
  EXPECT_EQ(failures(2.1, {0, 0}), "h");  // the sets around meet, those inside do not
}

TEST_F(CheckClearances, WithoutPairsAllIsFree) {
  solids_.pairs.clear();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(failures(1, {inf, inf}), "");
}

}  // namespace
}  // namespace medial_vk
