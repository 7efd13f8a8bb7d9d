// Volumes of unions of hulls by lines, against exact ones.
#include "hull_fits/search/coverage_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "medial_vk/ball_union.h"
#include "medial_vk/hull_union.h"
#include "support/hulls/random_hulls.h"
#include "support/solids/ball_families.h"

namespace medial_vk {
namespace {

constexpr Point kLower = {-2, -2, -2}, kUpper = {2, 2, 2};

/// Of lines with a step s along both coordinates, for convex hulls: along a row the length of a chord, or of what a
/// union adds to it, varies by at most four times the extent along the lines (its begin and its end go there and back),
/// and a sum of one value per step differs from the integral by at most s times the variation. There are at most
/// extent / s + 1 rows. Across rows the area of a section goes up and down by at most the greatest one, and the middle
/// of a step is off by at most s / 2 times the variation. With the extents d of the hull in its box, that is at most
///     4 d (d + s) s + d^2 s
/// for each of the three directions, and so for their mean.
double lattice_error(const BallHull& hull, double step) {
  const HullBounds box = bounds_of(hull);
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, box.upper[k] - box.lower[k]);
  return step * extent * (4 * (extent + step) + extent);
}

/// The step of about so many lines in the box above, whose three faces are squares.
double step_of(std::size_t lines) { return 4 * std::sqrt(3.0 / static_cast<double>(lines)); }

std::vector<BallHull> some_hulls(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<BallHull> hulls;
  for (std::size_t i = 0; i < count; ++i) {
    hulls.push_back(test::random_hull(1 + static_cast<std::uint32_t>(random() % 3), random));
  }
  return hulls;
}

bool is_in_box(const BallHull& hull) {
  const HullBounds box = bounds_of(hull);
  for (std::size_t k = 0; k < 3; ++k) {
    if (box.lower[k] < kLower[k] || box.upper[k] > kUpper[k]) return false;
  }
  return true;
}

// Each line stands for a part of one face of the box, and the parts of a face add up to it: a hull that is equally
// thick over all of a face has an exact volume there. The other lines pass it.
TEST(CoverageLines, AreExactOverAFaceOfTheBox) {
  const double r = 0.5;
  const BallHull slab = hull_of(Ball{{-100, -100, 0}, r}, Ball{{300, -100, 0}, r}, Ball{{-100, 300, 0}, r});
  for (const std::size_t lines : {1u, 7u, 300u, 5000u}) {
    for (const std::uint64_t seed : {0u, 5u}) {
      // Lines along z pass the slab below the box: a chord is not cut off at its ends.
      const CoverageLines above({-1, -2, 2}, {3, 1, 7}, lines, seed);
      // A sum of at most 5000 terms up to 4.
      EXPECT_NEAR(above.gain(slab, CoverageLines::kNone), 4 * 3 * 2 * r / 3, 5000 * 4 * 0x1p-53) << lines;
    }
  }
}

TEST(CoverageLines, AreNearTheVolumeOfUnionsOfBalls) {
  constexpr std::size_t kLines = 400'000;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const std::vector<Ball> balls = test::random_balls(12, seed, 0.2, 0.5);
    CoverageLines lines(kLower, kUpper, kLines, seed);
    double bound = 0;
    for (const Ball& ball : balls) {
      lines.add(hull_of(ball));
      bound += lattice_error(hull_of(ball), 1.01 * step_of(kLines));  // steps are rounded to divide the box
    }
    const double exact = measure_ball_union(balls).value().volume;
    EXPECT_NEAR(lines.covered(), exact, bound);
    // Errors of the parts have all signs: they have been below 1e-4.
    EXPECT_NEAR(lines.covered(), exact, 1e-3 * exact);
  }
}

TEST(CoverageLines, AreNearTheVolumeOfUnionsOfHulls) {
  constexpr std::size_t kLines = 100'000;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const std::vector<BallHull> hulls = some_hulls(8, seed);
    CoverageLines lines(kLower, kUpper, kLines, seed);
    double bound = 0;
    for (const BallHull& hull : hulls) {
      if (!is_in_box(hull)) continue;
      lines.add(hull);
      bound += lattice_error(hull, 1.01 * step_of(kLines));
    }
    std::vector<BallHull> added;
    for (std::size_t i = 0; i < lines.size(); ++i) added.push_back(lines.hull(i));
    const Bounds exact = measure_hull_union(added, {.width = 2e-3}).value();
    EXPECT_GE(lines.covered(), exact.lower - bound);
    EXPECT_LE(lines.covered(), exact.upper + bound);
    EXPECT_GE(lines.covered(), exact.lower * (1 - 2e-3)) << "as for balls";
    EXPECT_LE(lines.covered(), exact.upper * (1 + 2e-3)) << "as for balls";
  }
}

/// Sums of chords in different orders: some thousand of them, of at most 4, each with an error of 2^-53.
constexpr double kSums = 1e-11;

TEST(CoverageLines, GainsAreWhatIsAdded) {
  const std::vector<BallHull> hulls = some_hulls(40, 9);
  CoverageLines lines(kLower, kUpper, 3000);
  double covered = 0;
  for (const BallHull& hull : hulls) {
    const double gain = lines.gain(hull, CoverageLines::kNone);
    EXPECT_GE(gain, -kSums);
    lines.add(hull);
    EXPECT_NEAR(lines.covered(), covered + gain, kSums);
    EXPECT_NEAR(lines.gain(hull, CoverageLines::kNone), 0, kSums) << "it is there already";
    covered = lines.covered();
  }
  EXPECT_EQ(lines.size(), hulls.size());
}

TEST(CoverageLines, ReplacedHullsLeaveNothingBehind) {
  const std::vector<BallHull> hulls = some_hulls(12, 10), others = some_hulls(60, 11);
  CoverageLines lines(kLower, kUpper, 3000);
  for (const BallHull& hull : hulls) lines.add(hull);
  std::vector<BallHull> now = hulls;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const std::size_t i = (5 * k) % now.size();
    const double loss = lines.gain(now[i], i), gain = lines.gain(others[k], i), before = lines.covered();
    lines.replace(i, others[k]);
    now[i] = others[k];
    EXPECT_NEAR(lines.covered(), before - loss + gain, kSums) << k;
    CoverageLines fresh(kLower, kUpper, 3000);
    for (const BallHull& hull : now) fresh.add(hull);
    EXPECT_NEAR(lines.covered(), fresh.covered(), kSums) << k;
    EXPECT_NEAR(lines.gain(others[k], i), fresh.gain(others[k], i), kSums) << k;
  }
  for (std::size_t k = now.size(); k-- > 0;) {
    const double loss = lines.gain(now[k], k), before = lines.covered();
    lines.remove_last();
    EXPECT_NEAR(lines.covered(), before - loss, kSums) << k;
  }
  EXPECT_EQ(lines.covered(), 0);
  EXPECT_EQ(lines.size(), 0u);
}

TEST(CoverageLines, OtherSeedsHaveOtherLines) {
  const BallHull hull = some_hulls(1, 3)[0];
  const CoverageLines first(kLower, kUpper, 500), again(kLower, kUpper, 500), other(kLower, kUpper, 500, 1);
  EXPECT_EQ(first.gain(hull, CoverageLines::kNone), again.gain(hull, CoverageLines::kNone));
  EXPECT_NE(first.gain(hull, CoverageLines::kNone), other.gain(hull, CoverageLines::kNone));
}

}  // namespace
}  // namespace medial_vk
