// The reported measures of a set of balls: where a formula gives them, and their output.
#include "output/charts_and_tables/measures_output.h"
#include "sphere_fits/quality/measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "support/extraction.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using namespace test;
SphereMeasures measure_in_cube(const std::vector<Ball>& balls, MeasureOptions options = {}) {
  const PreparedMesh mesh = prepare(make_box({2, 2, 2}));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  return measure_spheres(solid, balls, options).value();
}

TEST(SphereMeasures, BallInsideACube) {
  const SphereMeasures m = measure_in_cube({{{1, 1, 1}, 1 - 1e-12}});
  EXPECT_TRUE(m.inside.proved());
  EXPECT_FALSE(m.cover.proved());
  EXPECT_EQ(m.volume.standard_error, 0);
  EXPECT_NEAR(m.volume.normalized(), 1 - std::numbers::pi / 6, 1e-9);
  EXPECT_NEAR(m.volume.normalized_lower_bound(), 1 - std::numbers::pi / 6, 1e-9);
  EXPECT_EQ(m.volume.outside, 0);
  EXPECT_EQ(m.metrics.num_spheres, 1u);
  EXPECT_NEAR(m.metrics.coverage, std::numbers::pi / 6, 1e-9);
  EXPECT_NEAR(m.metrics.volume_ratio, std::numbers::pi / 6, 1e-9);
  EXPECT_EQ(m.metrics.protrusion, 0);
  EXPECT_EQ(m.metrics.protrusion_dist_mean, 0);
  EXPECT_EQ(m.metrics.protrusion_dist_p95, 0);
  EXPECT_GE(m.metrics.max_uncovered_gap, std::sqrt(3.0) - 1);
  EXPECT_NEAR(m.metrics.max_uncovered_gap, std::sqrt(3.0) - 1, 1e-3);
  // The mean of |p| - 1 over a face [-1, 1]^2 at height 1, by the midpoint rule.
  double mean = 0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      mean += std::sqrt(1 + std::pow((i + 0.5) / kSteps, 2) + std::pow((j + 0.5) / kSteps, 2)) - 1;
    }
  }
  mean /= kSteps * kSteps;
  EXPECT_NEAR(m.metrics.surface_gap_mean, mean, 1e-3);
  EXPECT_NEAR(m.histograms.boundary_to_envelope.mean, -mean, 1e-3);
  EXPECT_NEAR(m.histograms.boundary_to_envelope.mean_absolute, mean, 1e-3);
  EXPECT_LE(m.histograms.envelope_to_boundary.greatest, 1e-9);
}

TEST(SphereMeasures, BallThatSticksOut) {
  const double radius = 1.2, height = 0.2;
  const SphereMeasures m = measure_in_cube({{{1, 1, 1}, radius}});
  const double outside = 6 * std::numbers::pi * height * height * (3 * radius - height) / 3;
  const double ball = 4 * std::numbers::pi / 3 * radius * radius * radius;
  EXPECT_FALSE(m.inside.proved());
  EXPECT_GT(m.volume.standard_error, 0);
  EXPECT_LT(m.volume.standard_error, 0.01);
  EXPECT_NEAR(m.volume.outside, outside, 5 * m.volume.standard_error);
  EXPECT_NEAR(m.volume.uncovered, 8 - ball + outside, 5 * m.volume.standard_error);
  EXPECT_GE(m.volume.normalized(), m.volume.normalized_lower_bound());
  EXPECT_NEAR(m.metrics.coverage, (ball - outside) / 8, 0.005);
  // Six caps of the sphere, each of 2 pi r h.
  EXPECT_NEAR(m.metrics.protrusion,
              6 * 2 * std::numbers::pi * radius * height / (4 * std::numbers::pi * radius * radius), 0.03);
  EXPECT_GT(m.metrics.protrusion_dist_p95, m.metrics.protrusion_dist_mean);
  EXPECT_LT(m.metrics.protrusion_dist_p95, height);
  EXPECT_NEAR(m.histograms.envelope_to_boundary.greatest, height, 1e-3);
}

TEST(SphereMeasures, BallThatCovers) {
  const SphereMeasures m = measure_in_cube({{{1, 1, 1}, 1.8}});
  EXPECT_TRUE(m.cover.proved());
  EXPECT_EQ(m.volume.standard_error, 0);
  EXPECT_EQ(m.volume.uncovered, 0);
  EXPECT_NEAR(m.volume.outside, 4 * std::numbers::pi / 3 * 1.8 * 1.8 * 1.8 - 8, 1e-9);
  EXPECT_EQ(m.metrics.coverage, 1);
  EXPECT_EQ(m.metrics.max_uncovered_gap, 0);
  EXPECT_EQ(m.distances.between_sets().upper, m.distances.balls_to_solid.upper);
}

TEST(SphereMeasures, SeedsAndThreads) {
  MeasureOptions other;
  other.seed = 2;
  MeasureOptions one;
  one.threads = 1;
  const std::vector<Ball> balls = {{{1, 1, 1}, 1.2}, {{0.2, 0.2, 0.5}, 0.4}};
  const SphereMeasures a = measure_in_cube(balls), b = measure_in_cube(balls, other), c = measure_in_cube(balls, one);
  EXPECT_NE(a.volume.outside, b.volume.outside);
  EXPECT_NEAR(a.volume.outside, b.volume.outside, 6 * a.volume.standard_error);
  EXPECT_EQ(measures_json(a).dump(), measures_json(c).dump());
}

TEST(SphereMeasures, AnOpenMeshHasAnEstimate) {
  Mesh open = make_sphere(1, 2000);
  open.triangles.resize(open.triangles.size() - 20);
  const PreparedMesh mesh = prepare(open);
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  ASSERT_FALSE(solid.has_volume());
  const SphereMeasures m = measure_spheres(solid, std::vector<Ball>{{{0, 0, 0}, 0.9}}).value();
  EXPECT_GT(m.volume.standard_error, 0);
  EXPECT_NEAR(m.volume.solid, 4 * std::numbers::pi / 3, 0.1);
  EXPECT_NEAR(m.volume.normalized(), 1 - 0.729, 0.02);
}

TEST(SphereMeasures, JsonTextAndPicture) {
  const SphereMeasures m = measure_in_cube({{{1, 1, 1}, 1.2}});
  const nlohmann::ordered_json json = measures_json(m);
  for (const char* key : {"num_spheres", "coverage", "protrusion", "protrusion_dist_mean", "protrusion_dist_p95",
                          "surface_gap_mean", "surface_gap_p95", "max_uncovered_gap", "volume_ratio"}) {
    EXPECT_TRUE(json.at("metrics").contains(key)) << key;
    EXPECT_TRUE(json.at("metrics").at(key).is_number()) << key;
  }
  EXPECT_FALSE(json.at("certificate").at("inside").at("proved").get<bool>());
  EXPECT_LE(json.at("distances").at("hausdorff_of_surfaces").at("lower").get<double>(),
            json.at("distances").at("hausdorff_of_surfaces").at("upper").get<double>());
  const std::string text = measures_text(m);
  EXPECT_NE(text.find("standard error"), std::string::npos);
  EXPECT_NE(text.find("no: 1 balls reach out"), std::string::npos);
  double share = 0;
  for (const double each : m.histograms.envelope_to_boundary.share) share += each;
  EXPECT_NEAR(share, 1, 1e-9);
  const std::string svg = encode_histograms_svg(m), csv = encode_histograms_csv(m);
  EXPECT_EQ(svg.rfind("<svg", 0), 0u);
  EXPECT_NE(svg.find("class=\"bar\""), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(csv.rfind("surface,lower,upper,share\n", 0), 0u);
}

TEST(SphereMeasures, NoBallsAreAnError) {
  const PreparedMesh mesh = prepare(make_box({2, 2, 2}));
  const Solid solid = Solid::build(test::indexed(mesh)).value();
  EXPECT_EQ(measure_spheres(solid, {}).error().code, ErrorCode::kUsage);
}

}  // namespace
}  // namespace medial_vk
