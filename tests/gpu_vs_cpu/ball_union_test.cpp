// Unions of balls on the device against the host's in double precision: every number within its bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "medial_vk/ball_union.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/solids/ball_families.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

constexpr double kPi = std::numbers::pi;

class BallUnionOnDevice : public test::DeviceTest {
 protected:
  DeviceBallUnion measure(const std::vector<Ball>& balls, const DeviceBallUnionOptions& options = {}) {
    auto result = measure_ball_union(balls, options, *context_);
    EXPECT_TRUE(result.ok()) << result.error().message;
    return std::move(result).value();
  }
  /// Compares with the host; the host may measure at most `redone` balls itself. Records the largest error relative to
  /// its bound.
  DeviceBallUnion expect_within_bounds(const std::vector<Ball>& balls, std::size_t redone);
};

std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> out(a.size());
  std::transform(a.begin(), a.end(), b.begin(), out.begin(), [](double x, double y) { return std::abs(x - y); });
  return out;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

double largest_ratio(const std::vector<double>& errors, const std::vector<double>& bounds) {
  double largest = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_LE(errors[i], bounds[i]) << "ball " << i;
    if (bounds[i] > 0) largest = std::max(largest, errors[i] / bounds[i]);
  }
  return largest;
}

DeviceBallUnion BallUnionOnDevice::expect_within_bounds(const std::vector<Ball>& balls, std::size_t redone) {
  const DeviceBallUnion device = measure(balls);
  const BallUnion host = measure_ball_union(balls).value();
  EXPECT_EQ(device.volumes.size(), balls.size());
  const std::vector<double> volume_errors = differences(device.volumes, host.volumes);
  const std::vector<double> area_errors = differences(device.areas, host.areas);
  const double worst_volume = largest_ratio(volume_errors, device.volume_bounds);
  const double worst_area = largest_ratio(area_errors, device.area_bounds);
  EXPECT_LE(std::abs(device.volume - host.volume), device.volume_bound);
  EXPECT_LE(std::abs(device.area - host.area), device.area_bound);
  EXPECT_NEAR(device.volume_bound, sum(device.volume_bounds), 1e-9 * device.volume_bound);
  for (const std::uint32_t i : device.redone) {
    const double radius = balls[i].radius;
    EXPECT_NEAR(device.volumes[i], host.volumes[i], 1e-11 * radius * radius * radius) << "ball " << i;
  }
  EXPECT_LE(device.redone.size(), redone);
  const auto text = [](double x) { return std::to_string(1e9 * x); };
  RecordProperty("redone", static_cast<int>(device.redone.size()));
  RecordProperty("worst_volume_by_bound", std::to_string(worst_volume));
  RecordProperty("worst_area_by_bound", std::to_string(worst_area));
  if (host.volume > 0) {
    RecordProperty("volume_error_e9", text(std::abs(device.volume - host.volume) / host.volume));
    RecordProperty("volume_bound_e9", text(device.volume_bound / host.volume));
    RecordProperty("area_error_e9", text(std::abs(device.area - host.area) / std::max(host.area, 1e-300)));
    RecordProperty("area_bound_e9", text(device.area_bound / std::max(host.area, 1e-300)));
  }
  return device;
}

using test::random_balls;

std::vector<Ball> grid(int nx, int ny, int nz, double radius) {
  std::vector<Ball> balls;
  for (int i = 0; i < nx * ny * nz; ++i) {
    balls.push_back(
        {{static_cast<double>(i % nx), static_cast<double>(i / nx % ny), static_cast<double>(i / nx / ny)}, radius});
  }
  return balls;
}

TEST_F(BallUnionOnDevice, OfNone) {
  const DeviceBallUnion found = measure({});
  EXPECT_EQ(found.volume, 0);
  EXPECT_EQ(found.volume_bound, 0);
  EXPECT_TRUE(found.volumes.empty());
}

TEST_F(BallUnionOnDevice, OfOne) {
  const DeviceBallUnion found = expect_within_bounds({{{3, -2, 5}, 0.7}}, 0);
  EXPECT_NEAR(found.volume, 4 * kPi / 3 * 0.343, 1e-6);
  EXPECT_NEAR(found.area, 4 * kPi * 0.49, 1e-6);
}

TEST_F(BallUnionOnDevice, OfFewAtRandom) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    expect_within_bounds(random_balls(2 + seed, seed, 0.2, 0.6), 1);
  }
}

TEST_F(BallUnionOnDevice, OfManyAtRandom) { expect_within_bounds(random_balls(5000, 1, 0.02, 0.08), 50); }

TEST_F(BallUnionOnDevice, OfManyThatHardlyTouch) { expect_within_bounds(random_balls(3000, 2, 0.01, 0.03), 30); }

TEST_F(BallUnionOnDevice, OfGrids) {
  for (const double radius : {0.4, 0.5, 0.6, 0.75, 0.9, 1.5}) {
    SCOPED_TRACE(radius);
    expect_within_bounds(grid(9, 8, 7, radius), 0);
  }
}

std::vector<Ball> turned(std::vector<Ball> balls) {
  for (Ball& ball : balls) {
    const Point p = ball.centre;
    ball.centre = {0.36 * p[0] + 0.48 * p[1] - 0.8 * p[2], -0.8 * p[0] + 0.6 * p[1],
                   0.48 * p[0] + 0.64 * p[1] + 0.6 * p[2]};
  }
  return balls;
}

TEST_F(BallUnionOnDevice, OfTurnedGrids) {
  for (const double radius : {0.6, 0.75, 0.85, 0.9, 1.3}) {
    SCOPED_TRACE(radius);
    expect_within_bounds(turned(grid(9, 8, 7, radius)), 5);
  }
}

TEST_F(BallUnionOnDevice, OfCoplanarBalls) {
  expect_within_bounds(grid(30, 30, 1, 1.7), 9);
  expect_within_bounds(grid(200, 1, 1, 3.3), 2);
  expect_within_bounds(turned(grid(20, 20, 1, 2.5)), 40);
}

TEST_F(BallUnionOnDevice, OfNestedBalls) {
  const std::vector<Ball> balls = {{{0, 0, 0}, 0.2}, {{0.1, 0, 0}, 1}, {{0.1, 0, 0}, 0.5}, {{0.6, 0, 0}, 0.5}};
  const DeviceBallUnion found = expect_within_bounds(balls, 0);
  EXPECT_NEAR(found.volume, 4 * kPi / 3, 1e-5);
}

TEST_F(BallUnionOnDevice, OfDuplicatesCountsTheFirst) {
  auto balls = random_balls(300, 7, 0.1, 0.3);
  const auto again = balls;
  for (int times = 0; times < 3; ++times) balls.insert(balls.end(), again.begin(), again.end());
  const DeviceBallUnion found = expect_within_bounds(balls, 10);
  for (std::size_t i = 300; i < balls.size(); ++i) EXPECT_EQ(found.volumes[i], 0);
}

/// The large one has more neighbours than a cell can hold; the small ones are cut by it.
TEST_F(BallUnionOnDevice, OfOneLargeAmongThousands) {
  auto balls = random_balls(4000, 8, 0.005, 0.02);
  for (Ball& ball : balls) {
    const Point d = {ball.centre[0] - 0.5, ball.centre[1] - 0.5, ball.centre[2] - 0.5};
    const double size = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; ++k) ball.centre[k] = 0.5 + d[k] / size;
  }
  balls.push_back({{0.5, 0.5, 0.5}, 1});
  const DeviceBallUnion found = expect_within_bounds(balls, 100);
  EXPECT_TRUE(std::binary_search(found.redone.begin(), found.redone.end(), 4000u));
}

TEST_F(BallUnionOnDevice, OfBallsFarAway) {
  auto balls = random_balls(2000, 9, 0.03, 0.1);
  for (Ball& ball : balls) {
    ball.centre = {1e-3 * ball.centre[0] + 5, 1e-3 * ball.centre[1] - 3, 1e-3 * ball.centre[2] + 4};
    ball.radius *= 1e-3;
  }
  expect_within_bounds(balls, 40);
}

TEST_F(BallUnionOnDevice, OfAnySize) {
  for (const double unit : {1e-30, 1e30}) {
    auto balls = random_balls(200, 10, 0.1, 0.3);
    for (auto& [centre, radius] : balls) {
      for (double& x : centre) x *= unit;
      radius *= unit;
    }
    expect_within_bounds(balls, 2);
  }
}

/// Points, a ball too small for the device, numbers that three floats cannot represent.
TEST_F(BallUnionOnDevice, OfWhatIsLeftToTheHost) {
  auto balls = random_balls(100, 11, 0.1, 0.3);
  balls.push_back({{0.5, 0.5, 0.5}, 0});
  balls.push_back({{2, 2, 2}, 1e-9});
  expect_within_bounds(balls, 3);
  balls.push_back({{1e-45, 2, 2}, 0.1});
  expect_within_bounds(balls, balls.size());
}

TEST_F(BallUnionOnDevice, OfMedialBalls) {
  Mesh torus = test::make_torus(1, 0.3, 60, 30);
  test::rotate(torus, {1, 2, 3}, 0.7);
  for (const Mesh& solid : {test::make_box({1, 0.8, 0.5}), torus, test::make_l_shape(2, 0.5, 1)}) {
    ExtractionOptions options;
    options.resolution = 40;
    const Extraction found = test::extract_on_device(*context_, test::prepare(solid), options).extraction;
    std::vector<Ball> balls;
    for (const MedialSphere& sphere : found.spheres) balls.push_back({sphere.centre, sphere.radius});
    ASSERT_GT(balls.size(), 100u);
    expect_within_bounds(balls, balls.size() / 10);
  }
}

TEST_F(BallUnionOnDevice, IsTheSameEveryTime) {
  const auto balls = random_balls(3000, 12, 0.02, 0.1);
  const DeviceBallUnion once = measure(balls, {.threads = 1}), again = measure(balls, {.threads = 3});
  EXPECT_EQ(once.volumes, again.volumes);
  EXPECT_EQ(once.areas, again.areas);
  EXPECT_EQ(once.volume_bounds, again.volume_bounds);
  EXPECT_EQ(once.redone, again.redone);
  EXPECT_EQ(once.volume, again.volume);
}

TEST_F(BallUnionOnDevice, HostMeasuresWhatIsNotGoodEnough) {
  const auto balls = random_balls(500, 13, 0.1, 0.2);
  const DeviceBallUnion found = measure(balls, {.tolerance = 1e-30});
  EXPECT_GT(found.redone.size(), 100u);
  const BallUnion host = measure_ball_union(balls).value();
  EXPECT_NEAR(found.volume, host.volume, 1e-12 * host.volume);
}

TEST_F(BallUnionOnDevice, RefusesWhatCannotBeMeasured) {
  EXPECT_EQ(measure_ball_union(std::vector<Ball>{{{0, 0, 0}, -1}}, {}, *context_).error().code, ErrorCode::kUsage);
  EXPECT_EQ(measure_ball_union(std::vector<Ball>{{{0, 0, 0}, 1}}, {.tolerance = 0}, *context_).error().code,
            ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk
