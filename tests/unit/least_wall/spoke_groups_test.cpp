// Caps around cones of directions.
#include "least_wall/spoke_groups.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace medial_vk::test {
namespace {

class RandomCones {
 public:
  explicit RandomCones(std::uint64_t seed) : random_(seed) {}

  double share() { return share_(random_); }

  Point direction() {
    std::normal_distribution<> normal;
    const Point p = {normal(random_), normal(random_), normal(random_)};
    return (1 / length(p)) * p;
  }

  /// Cones within an angle of a direction.
  std::vector<SpokeCone> within(const Point& middle, double angle, int count) {
    std::vector<SpokeCone> cones;
    cones.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const double off = angle * share(), left = angle - off, size = left * share();
      const Point towards = direction();
      const Point across = towards - dot(towards, middle) * middle;
      cones.push_back({std::cos(off) * middle + (std::sin(off) / length(across)) * across, size});
    }
    return cones;
  }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<> share_{0, 1};
};

// Of points in a plane, a circle by k steps is wider than the least one by a share of 1 / sqrt(k) at most (Badoiu and
// Clarkson). Here are eleven steps, and caps are curved no more than that share allows.
TEST(SpokeGroups, ANarrowCapHoldsAllConesAndIsHardlyWiderThanNeeded) {
  RandomCones random(3);
  for (int i = 0; i < 2000; ++i) {
    const double angle = 1.1 * random.share();
    const std::vector<SpokeCone> cones = random.within(random.direction(), angle, 1 + i % 40);
    const SpokeCone cap = narrow_cap(cones, 1.2);
    ASSERT_NEAR(length(cap.axis), 1, 1e-12) << i;
    EXPECT_LE(cap.angle, angle * (1 + 1 / std::sqrt(11.0)) + 2 * kAngleRounding) << i;
    for (const SpokeCone& cone : cones) {
      EXPECT_LE(angle_between(cap.axis, cone.axis) + cone.angle, cap.angle + 1e-12) << i;
    }
  }
}

TEST(SpokeGroups, NoNarrowCapHoldsDirectionsThatAreFarApart) {
  const std::vector<SpokeCone> cones = {
      {{0, 0, 1}, 0}, {{std::sin(1.3), 0, std::cos(1.3)}, 0}, {{-std::sin(1.3), 0, std::cos(1.3)}, 0}};
  EXPECT_GE(narrow_cap(cones, 1.2).angle, 1.2);
  EXPECT_LT(narrow_cap(cones, 1.4).angle, 1.4);
  EXPECT_EQ(narrow_cap({}, 1.2).angle, 0);
  const std::vector<SpokeCone> with_any = {{{0, 0, 1}, 0}, {{0, 0, 0}, 0}};
  EXPECT_EQ(narrow_cap(with_any, 1.2).angle, std::numbers::pi);
}

}  // namespace
}  // namespace medial_vk::test
