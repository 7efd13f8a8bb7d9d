// A search that is kept gives what searches for each number give.
#include "sphere_fits/methods/kept_search.h"

#include <gtest/gtest.h>

#include <stop_token>

#include "support/solids/solids.h"
#include "unit/sphere_fits/shape.h"

namespace medial_vk {
namespace {

class KeptSearches : public testing::Test {
 protected:
  KeptSearches() : mesh_(test::indexed(prepare_mesh(test::make_l_shape(2.0, 0.6, 0.8)).value())) {
    options_.resolution = 16;
    options_.threads = 1;
  }
  void expect_the_fit_of(KeptSearch& search, std::size_t count) {
    const Result<SphereFit> kept = search.fit(count, options_.aim);
    ASSERT_TRUE(kept.ok()) << kept.error().message;
    options_.count = count;
    const SphereFit own = fit_spheres(mesh_, options_, reference_extractor()).value();
    ASSERT_EQ(kept.value().levels.size(), own.levels.size());
    for (std::size_t k = 0; k < own.levels.size(); ++k) {
      ASSERT_EQ(kept.value().levels[k].size(), own.levels[k].size());
      for (std::size_t i = 0; i < own.levels[k].size(); ++i) {
        EXPECT_EQ(kept.value().levels[k][i].centre, own.levels[k][i].centre);
        EXPECT_EQ(kept.value().levels[k][i].radius, own.levels[k][i].radius);
      }
    }
    EXPECT_EQ(kept.value().measures.volume.balls, own.measures.volume.balls);
    EXPECT_TRUE(kept.value().measures.inside.proved());
  }

  IndexedMesh mesh_;
  SphereFitOptions options_;
};

TEST_F(KeptSearches, FitsAreThoseOfSearchesOfTheirOwnInAnyOrder) {
  for (const bool levels : {false, true}) {
    options_.levels = levels;
    KeptSearch search(mesh_, options_, 40, reference_extractor());
    for (const std::size_t count : {12u, 1u, 30u, 11u, 29u, 30u}) expect_the_fit_of(search, count);
  }
}

TEST_F(KeptSearches, BallsByDistanceLikewise) {
  options_.aim = SphereAim::kDistance;
  for (const bool levels : {false, true}) {
    options_.levels = levels;
    KeptSearch search(mesh_, options_, 40, reference_extractor());
    EXPECT_EQ(search.gaps(23).value().size(), 23u);
    for (const std::size_t count : {12u, 1u, 30u, 11u, 29u, 30u}) expect_the_fit_of(search, count);
  }
}

TEST_F(KeptSearches, TheCurveIsContinued) {
  KeptSearch search(mesh_, options_, 40, reference_extractor());
  ASSERT_EQ(search.curve(9).value().covered.size(), 9u);
  const CoverageCurve kept = search.curve(25).value();
  options_.count = 25;
  const CoverageCurve own = measure_coverage_curve(mesh_, options_, reference_extractor()).value();
  EXPECT_EQ(kept.covered, own.covered);
  EXPECT_EQ(kept.ends, own.ends);
  EXPECT_EQ(kept.solid_volume, own.solid_volume);
  // A shorter one needs no more balls.
  EXPECT_EQ(search.curve(3).value().covered, own.covered);
}

TEST_F(KeptSearches, AreNotSearchedTwice) {
  int extractions = 0;
  const Extractor counted = [&](const IndexedMesh& mesh, const ExtractionOptions& options,
                                const ProgressCallback& progress, const std::stop_token& stop) {
    ++extractions;
    return reference_extractor()(mesh, options, progress, stop);
  };
  KeptSearch search(mesh_, options_, 40, counted);
  ASSERT_TRUE(search.curve(20).ok());
  ASSERT_TRUE(search.fit(20, SphereAim::kVolume).ok());
  ASSERT_TRUE(search.curve(30).ok());
  EXPECT_EQ(extractions, 1);
}

TEST_F(KeptSearches, ARequestToStopEndsTheCallAndNotTheSearch) {
  KeptSearch search(mesh_, options_, 40, reference_extractor());
  ASSERT_TRUE(search.fit(5, SphereAim::kVolume).ok());
  std::stop_source stop;
  stop.request_stop();
  const Result<SphereFit> stopped = search.fit(20, SphereAim::kVolume, {}, stop.get_token());
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
  expect_the_fit_of(search, 20);
}

TEST(KeptSearch, WhichFitsAreKept) {
  SphereFitOptions options;
  options.count = 5;
  EXPECT_TRUE(is_kept(options));
  options.max_gap = 0.1;
  EXPECT_FALSE(is_kept(options));
  EXPECT_TRUE(has_kept_curve(options));
  options.max_gap = 0;
  options.aim = SphereAim::kDistance;
  EXPECT_TRUE(is_kept(options));
  options.aim = SphereAim::kAuto;  // which of the two is decided before
  EXPECT_FALSE(is_kept(options));
  options.aim = SphereAim::kVolume;
  options.contract = SphereContract::kCover;
  EXPECT_FALSE(is_kept(options));
  EXPECT_TRUE(has_kept_curve(options));
  options.method = SphereMethod::kSource;
  EXPECT_FALSE(has_kept_curve(options));
}

}  // namespace
}  // namespace medial_vk
