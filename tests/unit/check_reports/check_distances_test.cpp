// The check of distances by the reference: right intervals pass, and each kind of wrong one fails its condition.
#include "reference_bridge/check_distances.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "medial_vk/pose.h"
#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

/// Two unit boxes at 0, the second one moved along x.
class CheckDistances : public testing::Test {
 protected:
  CheckDistances() : box_(prepare_mesh(test::make_box({1, 1, 1}), {}).value()) {}

  static Pose moved(double x) {
    Pose pose;
    pose.shift[0] = x;
    return pose;
  }

  /// The conditions that fail, as a word of the first letters of lower, upper, free, hit, points, apart.
  static std::string failures_of(const CheckReport& report) {
    std::string failed;
    for (std::size_t i = 0; i < report.lines.size(); ++i) {
      if (report.lines[i].failed > 0) failed += "lufhpa"[i];
    }
    EXPECT_EQ(report.passed(), failed.empty());
    return failed;
  }

  std::string failures(double x, const Distance& distance, const DistanceOptions& options = {}) const {
    const Pose pose = moved(x);
    return failures_of(check_distances(box_, box_, {&pose, 1}, {&distance, 1}, options, [](std::size_t) {}));
  }

  std::string failures(double x, const DistanceBounds& bounds) const {
    const Pose pose = moved(x);
    return failures_of(check_distance_bounds(box_, box_, {&pose, 1}, {&bounds, 1}, [](std::size_t) {}));
  }

  /// An interval, with points on the right face of the first box and the left face of the second one.
  static Distance between(double lower, double upper, double left_face) {
    Distance distance;
    distance.lower = lower;
    distance.upper = upper;
    distance.on_a = {1, 0.5, 0.5};
    distance.on_b = {left_face, 0.5, 0.5};
    return distance;
  }

  PreparedMesh box_;
};

TEST_F(CheckDistances, RightIntervalsPass) {
  EXPECT_EQ(failures(3, between(2, 2, 3)), "");
  EXPECT_EQ(failures(3, between(1.5, 2.5, 3)), "");
  EXPECT_EQ(failures(1, between(0, 1e-15, 1)), "");
  EXPECT_EQ(failures(0.5, between(0, 0, 1)), "");
  EXPECT_EQ(failures(3, DistanceBounds{1.5, 2.5, {}, {}}), "");
  EXPECT_EQ(failures(3, DistanceBounds{1.5, std::numeric_limits<double>::infinity(), {}, {}}), "");
  EXPECT_EQ(failures(0.5, DistanceBounds{0, 0, {}, {}}), "");
}

TEST_F(CheckDistances, WrongOnesFail) {
  EXPECT_EQ(failures(3, between(2.1, 2.2, 3)), "l");
  EXPECT_EQ(failures(3, between(1.7, 1.9, 3)), "ua");  // nor can its points be right
  EXPECT_EQ(failures(0.5, between(0.1, 0.5, 0.5)), "lf");
  EXPECT_EQ(failures(3, between(0, 0, 3)), "h");
  EXPECT_EQ(failures(3, DistanceBounds{2.1, 2.2, {}, {}}), "l");
  EXPECT_EQ(failures(3, DistanceBounds{1.7, 1.9, {}, {}}), "u");
  EXPECT_EQ(failures(0.5, DistanceBounds{0.1, 0.2, {}, {}}), "lf");
  EXPECT_EQ(failures(3, DistanceBounds{0, 0, {}, {}}), "h");
}

/// By little, but far above rounding.
TEST_F(CheckDistances, SlightlyWrongOnesFail) {
  EXPECT_EQ(failures(3, between(2 + 1e-11, 2 + 2e-11, 3)), "l");
  EXPECT_EQ(failures(3, DistanceBounds{1.9, 2 - 1e-11, {}, {}}), "u");
  EXPECT_EQ(failures(1 + 1e-11, DistanceBounds{0, 0, {}, {}}), "h");
}

/// With a limit of 0 the lower end is little above 0.
TEST_F(CheckDistances, FreeOfALimitOfZeroIsTested) {
  DistanceOptions options;
  options.limit = 0;
  EXPECT_EQ(failures(3, between(1e-14, 2.5, 3), options), "");
  EXPECT_EQ(failures(0.5, between(1e-14, 0.5, 0.5), options), "f");
  EXPECT_EQ(failures(1, between(1e-14, 1e-13, 1), options), "");  // they touch: a matter of rounding
}

TEST_F(CheckDistances, WrongPointsFail) {
  Distance off_a = between(2, 2, 3), off_b = between(2, 2, 3), apart = between(2, 2, 3);
  off_a.on_a[0] = 1.01;
  off_b.on_b[0] = 2.99;
  apart.on_b[1] = 0.9;
  EXPECT_EQ(failures(3, off_a), "p");
  EXPECT_EQ(failures(3, off_b), "p");
  EXPECT_EQ(failures(3, apart), "a");
}

/// A box in a larger one is at distance 0 from it, and its surface is not.
TEST_F(CheckDistances, OfSurfacesASolidInsideIsApart) {
  const PreparedMesh inner = prepare_mesh(test::make_box({0.2, 0.2, 0.2}), {}).value();
  Pose pose;
  pose.shift = {0.3, 0.4, 0.4};
  Distance distance;
  distance.lower = distance.upper = 0.3;
  distance.on_a = {0, 0.5, 0.5};
  distance.on_b = {0.3, 0.5, 0.5};
  const auto failed = [&](bool surfaces_only) {
    DistanceOptions options;
    options.surfaces_only = surfaces_only;
    return failures_of(check_distances(box_, inner, {&pose, 1}, {&distance, 1}, options, [](std::size_t) {}));
  };
  EXPECT_EQ(failed(true), "");
  EXPECT_EQ(failed(false), "lf");
}

}  // namespace
}  // namespace medial_vk
