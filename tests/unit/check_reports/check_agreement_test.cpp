// Two extractions against each other: what differs by rounding alone, and what does not.
#include "check_reports/check_agreement.h"

#include <gtest/gtest.h>

namespace medial_vk {
namespace {

constexpr std::uint32_t kRow = 300;

/// A row of voxels of side 1, each with a clearly salient point in its middle.
Extraction row_of_points() {
  Extraction extraction;
  extraction.grid = {{0, 0, 0}, 1, {kRow, 1, 1}};
  for (std::uint32_t x = 0; x < kRow; ++x) {
    MedialSphere sphere;
    sphere.centre = {x + 0.5, 0.5, 0.5};
    sphere.radius = 1;
    sphere.object_angle = 1;
    sphere.voxel = {x, 0, 0};
    extraction.spheres.push_back(sphere);
  }
  return extraction;
}

CertifiedExtraction certified(Extraction extraction) {
  CertifiedExtraction out;
  out.certificate.passed = extraction.spheres.size();
  out.extraction = std::move(extraction);
  return out;
}

TEST(CheckAgreement, EqualExtractionsAgree) {
  const CheckReport report = check_agreement(certified(row_of_points()), row_of_points(), {});
  EXPECT_TRUE(report.passed());
  for (const CheckLine& line : report.lines) EXPECT_GT(line.tested, 0u) << line.condition;
}

TEST(CheckAgreement, APointThatIsMissingIsAFault) {
  for (const bool of_device : {true, false}) {
    Extraction less = row_of_points();
    less.spheres.erase(less.spheres.begin() + 7);
    const CheckReport report = of_device ? check_agreement(certified(less), row_of_points(), {})
                                         : check_agreement(certified(row_of_points()), less, {});
    EXPECT_FALSE(report.passed());
    const CheckLine& line = report.lines[of_device ? 2 : 3];
    EXPECT_EQ(line.failed, 1u);
    EXPECT_EQ(line.first_failure, "voxel (7, 0, 0) has no point");
  }
}

TEST(CheckAgreement, UndecidedVoxelsExplainFew) {
  Extraction less = row_of_points();
  less.spheres.erase(less.spheres.begin() + 7);
  less.measurements.counters.undecided = 1;
  EXPECT_TRUE(check_agreement(certified(less), row_of_points(), {}).passed());
  less.spheres.resize(kRow - 10);
  less.measurements.counters.undecided = 10;
  EXPECT_FALSE(check_agreement(certified(less), row_of_points(), {}).passed());  // more than one in 200, and one
}

TEST(CheckAgreement, RoundingExplainsPointsAtTheirLimits) {
  const auto agrees_without = [](const auto& change) {
    Extraction full = row_of_points();
    change(full.spheres[7]);
    Extraction less = full;
    less.spheres.erase(less.spheres.begin() + 7);
    return check_agreement(certified(less), full, {}).passed();
  };
  EXPECT_FALSE(agrees_without([](MedialSphere&) {}));
  EXPECT_TRUE(agrees_without([](MedialSphere& s) { s.object_angle = 0.62f; }));  // the threshold is 0.6
  EXPECT_TRUE(agrees_without([](MedialSphere& s) { s.centre[0] = 7.001; }));     // epsilon is 0.01
}

TEST(CheckAgreement, OtherGridsAndRejectedBallsAreFaults) {
  Extraction other = row_of_points();
  other.grid.size = {kRow, 2, 1};
  EXPECT_EQ(check_agreement(certified(other), row_of_points(), {}).lines[0].failed, 1u);
  CertifiedExtraction rejected = certified(row_of_points());
  rejected.certificate.rejected = 2;
  EXPECT_TRUE(check_agreement(rejected, row_of_points(), {}).passed());
  rejected.certificate.rejected = 20;
  EXPECT_EQ(check_agreement(rejected, row_of_points(), {}).lines[1].failed, 20u);
}

TEST(CheckAgreement, NoPointsAtAllAreAFault) {
  Extraction none = row_of_points();
  none.spheres.clear();
  EXPECT_FALSE(check_agreement(certified(none), row_of_points(), {}).passed());
}

}  // namespace
}  // namespace medial_vk
