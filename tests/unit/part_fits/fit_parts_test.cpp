// Balls for the parts of an assembly: their distribution, levels of one length, positions in the frame of the link.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <utility>

#include "base/point_ops.h"
#include "medial_vk/part_fits.h"
#include "medial_vk/prepare.h"
#include "reference_bridge/reference_extractor.h"
#include "robots/primitive_mesh.h"
#include "support/indexed.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

class FitParts : public testing::Test {
 protected:
  FitParts() {
    parts_.push_back(box_part("a", "box", {2, 1, 0.7}));
    parts_.push_back(box_part("a", "small", {0.2, 0.1, 0.07}));
    Part ball;
    ball.link = "b";
    ball.name = "primitive0";
    ball.pose = make_pose({1, 2, 3}, {0.1, 0.2, 0.3});
    ball.ball = Ball{{0, 0, 0}, 0.25};
    parts_.push_back(ball);
    options_.spheres.method = SphereMethod::kSource;
  }

  static Part box_part(const std::string& link, const std::string& name, const Point& size) {
    Part part;
    part.link = link;
    part.name = name;
    part.mesh = test::indexed(prepare_mesh(test::make_box(size)).value());
    part.pose = make_pose({5, 0, 0}, {0.3, 0.2, 0.1});
    return part;
  }

  Result<std::vector<PartFit>> fit() const { return fit_parts(parts_, options_, reference_extractor()); }

  std::vector<Part> parts_;
  PartFitOptions options_;
};

TEST_F(FitParts, ABallIsItself) {
  options_.total = 40;
  const Result<std::vector<PartFit>> fits = fit();
  ASSERT_TRUE(fits.ok()) << fits.error().message;
  const PartFit& ball = fits.value()[2];
  ASSERT_EQ(ball.levels.back().size(), 1u);
  EXPECT_EQ(ball.levels.back()[0].centre, (Point{1, 2, 3}));
  EXPECT_EQ(ball.levels.back()[0].radius, 0.25);
  EXPECT_EQ(ball.count, 1u);
}

TEST_F(FitParts, TheLargerGetsMore) {
  options_.count_per_link = 60;
  const Result<std::vector<PartFit>> fits = fit();
  ASSERT_TRUE(fits.ok()) << fits.error().message;
  EXPECT_EQ(fits.value()[0].count + fits.value()[1].count, 60u);
  EXPECT_GT(fits.value()[0].count, 5 * fits.value()[1].count);
  EXPECT_NEAR(*fits.value()[0].solid_volume, 1.4, 1e-12);
  EXPECT_LT(*fits.value()[0].spheres_volume, 1.4);
}

TEST_F(FitParts, MoreInTotalMakesNoPartWorse) {
  options_.spheres.method = SphereMethod::kBest;
  options_.spheres.resolution = 12;
  std::vector<PartFit> before;
  for (const std::size_t total : {3u, 8u, 21u, 22u, 40u}) {
    options_.total = total;
    const std::vector<PartFit> fits = std::move(fit().value());
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_GE(fits[i].count, before[i].count) << total;
      EXPECT_GE(*fits[i].spheres_volume, *before[i].spheres_volume * (1 - 1e-12)) << total;
    }
    before = fits;
  }
}

TEST_F(FitParts, EachPartIsSearchedOnce) {
  options_.spheres.method = SphereMethod::kBest;
  options_.spheres.resolution = 12;
  std::atomic<int> extractions = 0;
  const Extractor counted = [&](const IndexedMesh& mesh, const ExtractionOptions& options,
                                const ProgressCallback& progress, const std::stop_token& stop) {
    ++extractions;
    return reference_extractor()(mesh, options, progress, stop);
  };
  options_.count_per_link = 30;
  const std::vector<PartFit> fits = fit_parts(parts_, options_, counted).value();
  EXPECT_EQ(extractions, 2);  // of the boxes, for their curves and their balls
  EXPECT_EQ(fits[0].levels.back().size() + fits[1].levels.back().size(), 30u);
  // Each has the balls of a fit of its own.
  for (const std::size_t part : {0u, 1u}) {
    SphereFitOptions own = options_.spheres;
    own.count = fits[part].count;
    const SphereFit alone = fit_spheres(*parts_[part].mesh, own, reference_extractor()).value();
    ASSERT_EQ(fits[part].proved.size(), alone.levels.back().size());
    for (std::size_t i = 0; i < fits[part].proved.size(); ++i) {
      EXPECT_EQ(fits[part].proved[i].centre, alone.levels.back()[i].centre);
      EXPECT_EQ(fits[part].proved[i].radius, alone.levels.back()[i].radius);
    }
  }
}

TEST_F(FitParts, BesideBallsOneMeshGetsTheRestWithoutACurve) {
  parts_[1] = parts_[2];
  parts_[1].link = "a";
  options_.spheres.method = SphereMethod::kBest;
  options_.spheres.resolution = 12;
  options_.count_per_link = 20;
  const std::vector<PartFit> fits = fit().value();
  std::vector<std::size_t> counts;
  for (const PartFit& part : fits) counts.push_back(part.levels.back().size());
  EXPECT_THAT(counts, testing::ElementsAre(19, 1, 1));
}

TEST_F(FitParts, ByDistanceTheWidestGapOfAllPartsIsNarrow) {
  parts_[1] = box_part("a", "plate", {1.5, 1, 0.02});
  options_.spheres.method = SphereMethod::kBest;
  options_.spheres.resolution = 16;
  options_.total = 25;
  std::vector<double> widest;
  for (const SphereAim aim : {SphereAim::kVolume, SphereAim::kDistance}) {
    options_.spheres.aim = aim;
    const std::vector<PartFit> fits = fit().value();
    EXPECT_EQ(fits[0].count + fits[1].count + fits[2].count, 25u);
    double gap = 0;
    for (const PartFit& part : fits) {
      if (!part.measures) continue;
      EXPECT_TRUE(part.measures->inside.proved());
      gap = std::max(gap, part.measures->distances.boundary_to_balls.upper);
    }
    widest.push_back(gap);
  }
  EXPECT_LT(widest[1], 0.7 * widest[0]);
}

TEST_F(FitParts, WithAGreatestReachPartsHaveTheBallsThatTheyNeed) {
  options_.spheres.method = SphereMethod::kBest;
  options_.spheres.contract = SphereContract::kCover;
  options_.spheres.max_reach = 0.2;
  options_.spheres.balls_only = true;
  const std::vector<PartFit> alone = fit().value();
  for (const PartFit& part : alone) EXPECT_LE(part.reach.back().greatest, 0.2);
  const std::size_t needed = alone[0].levels.back().size() + alone[1].levels.back().size();
  EXPECT_GT(needed, 8u);
  options_.count_per_link = needed;
  const std::vector<PartFit> enough = fit().value();
  EXPECT_EQ(enough[0].levels.back().size(), alone[0].levels.back().size());
  options_.count_per_link = needed - 1;
  EXPECT_EQ(fit().error().message,
            "of link \"a\", " + std::to_string(needed) +
                " balls are found that keep to `max_reach`; raise it, or `count_per_link` from " +
                std::to_string(needed - 1));
  options_.count_per_link = 0;
  options_.total = needed;  // and one more for the part that is a ball
  EXPECT_THAT(fit().error().message, HasSubstr("raise it, or `total` from"));
}

TEST_F(FitParts, ThePrimitivesErrorIsThatOfItsShape) {
  Geometry cylinder;
  cylinder.kind = GeometryKind::kCylinder;
  cylinder.size = {0.5, 2, 0};
  options_.spheres.method = SphereMethod::kBest;
  options_.spheres.resolution = 12;
  options_.spheres.count = 4;
  for (const SphereContract contract : {SphereContract::kInside, SphereContract::kCover}) {
    options_.spheres.contract = contract;
    const bool cover = contract == SphereContract::kCover;
    const FacetSide side = cover ? FacetSide::kCircumscribed : FacetSide::kInscribed;
    Part part;
    part.link = part.name = "c";
    part.mesh = test::indexed(prepare_mesh(make_primitive(cylinder, side)).value());
    part.volume = primitive_volume(cylinder);
    parts_ = {part};
    const PartFit fitted = std::move(fit().value().front());
    EXPECT_TRUE(fitted.of_shape);
    EXPECT_EQ(*fitted.solid_volume, primitive_volume(cylinder));
    const VolumeError& volume = fitted.measures->volume;
    EXPECT_EQ(volume.standard_error, 0);
    EXPECT_EQ(volume.solid, primitive_volume(cylinder));
    EXPECT_EQ(volume.uncovered, cover ? 0 : volume.solid - volume.balls);
    EXPECT_EQ(volume.outside, cover ? volume.balls - volume.solid : 0);
    EXPECT_GT(volume.uncovered + volume.outside, 0);
  }
}

TEST_F(FitParts, SpheresStandInTheFrameOfTheLink) {
  options_.count_per_link = 60;
  const std::vector<PartFit> fits = fit().value();
  const Pose& pose = parts_[0].pose;
  for (const Ball& ball : fits[0].levels.back()) {
    const Point moved = ball.centre - pose.shift;
    Point local = {0, 0, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t row = 0; row < 3; ++row) local[axis] += pose.rotation[row][axis] * moved[row];
    }
    const Point size = {2, 1, 0.7};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_GE(local[axis], ball.radius - 1e-15);
      EXPECT_LE(local[axis], size[axis] - ball.radius + 1e-15);
    }
  }
}

TEST_F(FitParts, AllPartsHaveAsManyLevels) {
  options_.total = 50;
  options_.spheres.levels = true;
  const std::vector<PartFit> fits = fit().value();
  EXPECT_GT(fits[0].levels.size(), 3u);
  for (const PartFit& part : fits) {
    EXPECT_EQ(part.levels.size(), fits[0].levels.size());
    EXPECT_EQ(part.reach.size(), fits[0].levels.size());
    EXPECT_EQ(part.levels.front().size(), 1u);
  }
}

TEST_F(FitParts, FaultsNameLinkAndPart) {
  options_.count_per_link = 1;
  EXPECT_EQ(fit().error().message, "link \"a\" has 2 parts, which need a ball each; raise `count_per_link` from 1");
  options_.count_per_link = 0;
  options_.spheres.max_gap = 0.1;
  EXPECT_THAT(fit().error().message, HasSubstr("link \"a\", \"box\": `method` source does not support `max_gap`"));
  EXPECT_EQ(fit().error().code, ErrorCode::kUsage);
  options_.spheres.max_gap = 0;
  options_.total = 2;
  EXPECT_EQ(fit().error().message, "3 parts need a ball each; raise `total` from 2");
  options_.count_per_link = 2;
  EXPECT_THAT(fit().error().message, HasSubstr("`count_per_link` and `total`"));
}

TEST_F(FitParts, PartsThatAreNoneAreRefused) {
  options_.total = 20;
  const std::vector<Part> good = parts_;
  parts_[1].pose.rotation[0] = {2, 0, 0};
  EXPECT_EQ(fit().error().message, "link \"a\", \"small\": its `pose` is no rigid motion");
  parts_ = good;
  parts_[2].ball->radius = 0;
  EXPECT_THAT(fit().error().message, HasSubstr("link \"b\", \"primitive0\": its `ball`"));
  parts_ = good;
  parts_[0].volume = -1;
  EXPECT_EQ(fit().error().message, "link \"a\", \"box\": its `volume` is not positive");
  EXPECT_EQ(fit().error().code, ErrorCode::kUsage);
  parts_ = good;
  parts_[0].mesh.reset();
  EXPECT_EQ(fit().error().message, "link \"a\", \"box\": it has neither `mesh` nor `ball`");
  parts_ = good;
  parts_[2].mesh = parts_[0].mesh;
  EXPECT_EQ(fit().error().message, "link \"b\", \"primitive0\": it has both `mesh` and `ball`");
  parts_.clear();
  EXPECT_TRUE(fit().value().empty());
}

TEST_F(FitParts, ABallBesideItsOriginIsPlacedForTheContract) {
  parts_ = {parts_[2]};
  parts_[0].ball = Ball{{0.5, 0, 0}, 0.25};
  const Point centre = parts_[0].pose * Point{0.5, 0, 0};
  options_.spheres.count = 1;
  for (const SphereContract contract : {SphereContract::kInside, SphereContract::kCover}) {
    options_.spheres.contract = contract;
    const Ball ball = fit().value()[0].levels[0][0];
    EXPECT_EQ(ball.centre, centre);
    EXPECT_EQ(ball.radius < 0.25, contract == SphereContract::kInside);
    EXPECT_NEAR(ball.radius, 0.25, 1e-13);
  }
}

TEST_F(FitParts, ResultsDoNotDependOnThreads) {
  options_.spheres.method = SphereMethod::kBest;
  options_.spheres.resolution = 12;
  options_.total = 14;
  std::vector<std::pair<Point, double>> before;
  for (const unsigned threads : {1u, 2u, 5u}) {
    options_.threads = threads;
    double last = 0;
    const Result<std::vector<PartFit>> fits =
        fit_parts(parts_, options_, reference_extractor(), [&](const char*, double done) { last = done; });
    ASSERT_TRUE(fits.ok()) << fits.error().message;
    EXPECT_GT(last, 0.9);
    std::vector<std::pair<Point, double>> balls;
    for (const PartFit& fit : fits.value()) {
      for (const Ball& ball : fit.levels.back()) balls.emplace_back(ball.centre, ball.radius);
    }
    if (threads > 1) {
      EXPECT_EQ(balls, before) << threads;
    }
    before = balls;
  }
}

// The curve of a part and its spheres start from the same medial spheres.
TEST_F(FitParts, ExtractsEachGridOfAPartOnce) {
  for (const SphereMethod method : {SphereMethod::kBest, SphereMethod::kSource}) {
    options_.spheres.method = method;
    options_.total = 30;
    std::map<std::pair<double, std::uint32_t>, int> runs;  // by extent of the part and resolution
    const Extractor counted = [&, extractor = reference_extractor()](
                                  const IndexedMesh& mesh, const ExtractionOptions& options, const auto&... rest) {
      ++runs[{mesh.prepared().report.upper[0], options.resolution}];
      return extractor(mesh, options, rest...);
    };
    const Result<std::vector<PartFit>> fits = fit_parts(parts_, options_, counted);
    ASSERT_TRUE(fits.ok()) << fits.error().message;
    EXPECT_GE(runs.size(), 2u);
    for (const auto& [grid, count] : runs) EXPECT_EQ(count, 1) << grid.first << " at " << grid.second;
  }
}

TEST_F(FitParts, ExtractsOneAtATimeAndItsProgressNeverFalls) {
  options_.total = 14;
  options_.threads = 4;
  std::atomic<int> extracting = 0;
  const Extractor alone = [&, extractor = reference_extractor()](const auto&... arguments) {
    EXPECT_EQ(extracting++, 0);
    auto extraction = extractor(arguments...);
    --extracting;
    return extraction;
  };
  double last = 0;
  const auto on_progress = [&](const char*, double done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1);
    last = done;
  };
  ASSERT_TRUE(fit_parts(parts_, options_, alone, on_progress).ok());
  EXPECT_GT(last, 0.9);
}

TEST_F(FitParts, StopsOnRequest) {
  options_.total = 50;
  std::stop_source stop;
  const Result<std::vector<PartFit>> fits = fit_parts(
      parts_, options_, reference_extractor(), [&](const char*, double) { stop.request_stop(); }, stop.get_token());
  ASSERT_FALSE(fits.ok());
  EXPECT_EQ(fits.error().code, ErrorCode::kInterrupted);
}

/// The stop is requested at every n-th query, so in every stage.
TEST_F(FitParts, StopsAtAnyQuery) {
  options_.spheres.method = SphereMethod::kBest;
  options_.spheres.resolution = 20;
  const std::vector<Part> one = {parts_[0]};
  for (const SphereContract contract : {SphereContract::kInside, SphereContract::kCover, SphereContract::kBalanced}) {
    options_.spheres.contract = contract;
    options_.count_per_link = 6;
    const auto run = [&](std::size_t most, std::size_t& queried) {
      queried = 0;
      std::stop_source stop;
      const auto on_progress = [&](const char*, double) {
        if (queried++ >= most) stop.request_stop();
      };
      return fit_parts(one, options_, reference_extractor(), on_progress, stop.get_token());
    };
    std::size_t all = 0, queried = 0;
    ASSERT_TRUE(run(~std::size_t{0}, all).ok());
    ASSERT_GT(all, 100u);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t most = all / 2 * k / 4;  // their number depends slightly on the threads
      const Result<std::vector<PartFit>> fits = run(most, queried);
      ASSERT_FALSE(fits.ok()) << most << " of " << all;
      EXPECT_EQ(fits.error().code, ErrorCode::kInterrupted);
      EXPECT_LE(queried, most + 16);  // other threads may have queried meanwhile
    }
  }
}

TEST_F(FitParts, FarFromTheOriginOfTheLinkIsRefused) {
  options_.count_per_link = 10;
  parts_ = {parts_[0]};
  parts_[0].pose = make_pose({1e6, 0, 0}, {0.3, 0, 0});
  EXPECT_TRUE(fit().ok());
  parts_[0].pose = make_pose({1e18, 0, 0}, {0.3, 0, 0});
  EXPECT_EQ(fit().error().code, ErrorCode::kInvalidMesh);
  EXPECT_THAT(fit().error().message, HasSubstr("so far from the origin of its link"));
}

}  // namespace
}  // namespace medial_vk
