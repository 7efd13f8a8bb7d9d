// Sets of balls for distances, and the probes for which they are chosen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "medial_vk/ball_union.h"
#include "medial_vk/prepare.h"
#include "medial_vk/sphere_fits.h"
#include "reference_bridge/reference_extractor.h"
#include "solid/probes.h"
#include "sphere_fits/quality/nearest_ball_tree.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"
#include "unit/sphere_fits/shape.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

Mesh turned_plate() {
  Mesh mesh = test::make_plate_with_hole(3, 0.4, 1.2);
  test::rotate(mesh, {1, 2, 3}, 0.4);
  return mesh;
}

TEST(Probes, LeadFromTheClosestPointToOneOutside) {
  const Shape shape(turned_plate());
  const reference::Tree tree(test::to_reference(shape.mesh));
  const std::vector<Probe> probes = probes_around(shape.solid, 600, 1);
  ASSERT_EQ(probes.size(), 600u);
  const Point size = shape.mesh.report.upper - shape.mesh.report.lower;
  const double side = *std::max_element(size.begin(), size.end());
  std::size_t near = 0, far = 0;
  for (const Probe& probe : probes) {
    const Point outside = probe.outside();
    const Eigen::Vector3d at(outside.data());
    EXPECT_NEAR(length(probe.direction), 1, 1e-12);
    EXPECT_GT(probe.distance, 0);
    EXPECT_LE(probe.distance, side);
    EXPECT_FALSE(reference::is_inside(tree, at));
    // The closest point is the same from all of the way to it. One point in a million of the side has a direction of
    // less than 1e-9, by the rounding of a difference.
    EXPECT_NEAR(tree.closest(at).distance, probe.distance, 1e-9 * side);
    near += probe.distance < 0.1 * side;
    far += probe.distance > 0.5 * side;
  }
  EXPECT_GT(near, 60u);
  EXPECT_GT(far, 60u);
}

TEST(Probes, DependOnTheirNumberOnlyByItsPrefix) {
  const Shape shape(turned_plate());
  const std::vector<Probe> many = probes_around(shape.solid, 500, 4), few = probes_around(shape.solid, 77, 1);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].at, many[i].at);
    EXPECT_EQ(few[i].direction, many[i].direction);
    EXPECT_EQ(few[i].distance, many[i].distance);
  }
}

class SetsForDistances : public testing::Test {
 protected:
  SphereFit fit(SphereContract contract, bool for_distances, unsigned threads = 0) const {
    SphereFitOptions options;
    options.contract = contract;
    options.count = kCount;
    options.for_distances = for_distances;
    options.resolution = 24;  // the reference takes long
    options.threads = threads;
    return fit_spheres(test::indexed(shape_.mesh), options, reference_extractor()).value();
  }

  /// The mean difference of the distances of points outside from the balls and from the solid. The points are others
  /// than those that the balls are chosen for.
  double mean_difference(const std::vector<Ball>& balls) const {
    const NearestBallTree tree(balls);
    const std::vector<Probe> all = probes_around(shape_.solid, 4000, 0);
    double sum = 0;
    for (std::size_t i = 2000; i < all.size(); ++i) {
      sum += std::fabs(tree.nearest(all[i].outside()).distance - all[i].distance);
    }
    return sum / 2000;
  }

  static constexpr std::size_t kCount = 40;
  Shape shape_{turned_plate()};
};

TEST_F(SetsForDistances, AreNearerAndProved) {
  const SphereFit by_volume = fit(SphereContract::kInside, false), inside = fit(SphereContract::kInside, true);
  EXPECT_TRUE(inside.measures.inside.proved());
  EXPECT_EQ(inside.levels.back().size(), kCount);
  EXPECT_LT(mean_difference(inside.levels.back()), 0.75 * mean_difference(by_volume.levels.back()));
  EXPECT_LT(inside.measures.volume.balls, by_volume.measures.volume.balls);
  // Three quarters of the balls stay, those that are best for the volume.
  const std::span<const Ball> kept = std::span(by_volume.levels.back()).first(kCount - kCount / 4);
  EXPECT_GE(inside.measures.volume.balls, (1 - 1e-9) * measure_ball_union(kept).value().volume);

  const SphereFit cover = fit(SphereContract::kCover, true);
  EXPECT_TRUE(cover.measures.cover.proved());
  EXPECT_LE(cover.levels.back().size(), kCount);
}

TEST_F(SetsForDistances, DoNotDependOnThreads) {
  const auto is_same = [](const Ball& a, const Ball& b) { return a.centre == b.centre && a.radius == b.radius; };
  for (const SphereContract contract : {SphereContract::kInside, SphereContract::kCover}) {
    const SphereFit one = fit(contract, true, 1), three = fit(contract, true, 3);
    EXPECT_TRUE(std::ranges::equal(one.levels.back(), three.levels.back(), is_same));
  }
}

// A ball holds all that further balls could.
TEST_F(SetsForDistances, OfASphereHaveTheRequestedNumber) {
  const Shape sphere(test::make_sphere(1, 500));
  SphereFitOptions options;
  options.count = 9;
  options.for_distances = true;
  const SphereFit fit = fit_spheres(test::indexed(sphere.mesh), options, reference_extractor()).value();
  EXPECT_TRUE(fit.measures.inside.proved());
  EXPECT_LE(fit.levels.back().size(), 9u);
  EXPECT_GE(fit.levels.back().size(), 1u);
}

// Few probes are near the needle in the cup, and it has little volume.
TEST_F(SetsForDistances, ReachATipThatLittleComesNear) {
  constexpr double kLength = 0.3;
  Mesh mesh = test::make_cup(1, 0.3, 12, 32);
  const Shape cup(mesh);
  double floor = cup.mesh.report.lower[2];  // of the hollow
  while (cup.solid.contains({0, 0, floor + 1e-3})) floor += 1e-3;
  const Point tip = {0, 0, floor + 0.9 * kLength};
  test::append(mesh, test::moved(test::make_box({0.02, 0.02, kLength}), tip - Point{0.01, 0.01, kLength}));

  SphereFitOptions options;
  options.count = 320;
  options.for_distances = true;
  options.resolution = 24;
  const SphereFit fit = fit_spheres(test::indexed(prepare_mesh(mesh).value()), options, reference_extractor()).value();
  EXPECT_TRUE(fit.measures.inside.proved());
  EXPECT_LT(NearestBallTree(fit.levels.back()).nearest(tip).distance, 0.1 * kLength);
}

TEST_F(SetsForDistances, NoFitIsWithoutAGoal) {
  const Result<SphereFit> fit = fit_spheres(test::indexed(shape_.mesh), SphereFitOptions{}, reference_extractor());
  ASSERT_FALSE(fit.ok());
  EXPECT_EQ(fit.error().code, ErrorCode::kUsage);
  EXPECT_THAT(fit.error().message, HasSubstr("no goal"));
}

TEST_F(SetsForDistances, AreForACountAlone) {
  const std::vector<std::function<void(SphereFitOptions&)>> changes = {
      [](SphereFitOptions& options) { options.count = 0; },
      [](SphereFitOptions& options) { options.error = 0.1; },
      [](SphereFitOptions& options) { options.max_gap = 0.1; },
      [](SphereFitOptions& options) { options.levels = true; },
      [](SphereFitOptions& options) { options.method = SphereMethod::kSource; },
      [](SphereFitOptions& options) { options.contract = SphereContract::kBalanced; },
  };
  for (const auto& change : changes) {
    SphereFitOptions options;
    options.count = 4;
    options.for_distances = true;
    change(options);
    const Result<SphereFit> fit = fit_spheres(test::indexed(shape_.mesh), options, reference_extractor());
    ASSERT_FALSE(fit.ok());
    EXPECT_EQ(fit.error().code, ErrorCode::kUsage);
    EXPECT_THAT(fit.error().message, HasSubstr("`for_distances`"));
  }
}

}  // namespace
}  // namespace medial_vk
