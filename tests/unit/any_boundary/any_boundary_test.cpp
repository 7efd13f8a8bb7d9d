// Extraction by nearest points alone, from boundaries with a known medial axis.
#include "medial_vk/any_boundary.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <stop_token>

#include "any_boundary/approximate_ball.h"
#include "medial_vk/sheets.h"
#include "support/any_boundary/boundaries.h"

namespace medial_vk::test {
namespace {

constexpr double kTheta = 0.6;

ExtractionOptions options_of(std::uint32_t resolution, std::uint32_t extra_levels = 2) {
  ExtractionOptions options;
  options.resolution = resolution;
  options.extra_levels = extra_levels;
  options.threads = 2;
  return options;
}

BoundaryExtraction extract(const BoundaryFunctions& boundary, const ExtractionOptions& options) {
  Result<BoundaryExtraction> result = extract_medial_spheres(boundary, options);
  EXPECT_TRUE(result) << result.error().message;
  return std::move(result).value();
}

using Voxel = std::array<std::uint32_t, 3>;

Voxel voxel_of(const VoxelGrid& grid, const Point& p) {
  Voxel voxel;
  for (std::size_t k = 0; k < 3; ++k) {
    voxel[k] = static_cast<std::uint32_t>(std::floor((p[k] - grid.origin[k]) / grid.voxel_size));
  }
  return voxel;
}

/// Of voxels with a point, and of those that are undecided.
struct Answered {
  std::set<Voxel> found, undecided;

  explicit Answered(const Extraction& extraction) {
    for (const MedialSphere& sphere : extraction.spheres) found.insert(sphere.voxel);
    for (const UndecidedVoxel& voxel : extraction.undecided) undecided.insert(voxel.voxel);
  }
};

void expect_sound(const BoundaryExtraction& result, const BoundaryFunctions& boundary) {
  const Extraction& extraction = result.extraction;
  ASSERT_EQ(result.axis_distance.size(), extraction.spheres.size());
  std::set<Voxel> voxels;
  for (const MedialSphere& sphere : extraction.spheres) {
    Point nearest;
    boundary.nearest({&sphere.centre, 1}, {&nearest, 1});
    EXPECT_LE(sphere.radius, length(sphere.centre - nearest));
    EXPECT_GT(sphere.object_angle, kTheta - 1e-6);
    EXPECT_EQ(voxel_of(extraction.grid, sphere.centre), sphere.voxel);
    EXPECT_TRUE(voxels.insert(sphere.voxel).second);
  }
}

TEST(AnyBoundary, TheAxisOfATorusIsACircle) {
  for (const Mode mode : {Mode::kCertified, Mode::kThesis}) {
    ExtractionOptions options = options_of(24);
    options.mode = mode;
    const BoundaryExtraction result = extract(torus(), options);
    expect_sound(result, torus());
    const VoxelGrid& grid = result.extraction.grid;
    EXPECT_GT(static_cast<double>(result.extraction.spheres.size()) * grid.voxel_size, 6.28);
    for (std::size_t i = 0; i < result.axis_distance.size(); ++i) {
      const Point& p = result.extraction.spheres[i].centre;
      const double off = std::hypot(std::hypot(p[0], p[1]) - 1, p[2]);
      EXPECT_LE(off, result.axis_distance[i] + 1e-12);
      if (mode == Mode::kCertified) {
        EXPECT_LE(result.axis_distance[i], 0.01 * grid.voxel_size);
      }
    }
  }
}

/// A medial point of the box, of object angle pi / 4 or more: two walls are equally far, and no other is nearer.
std::optional<Point> medial_point_of_box(std::mt19937_64& random) {
  std::uniform_real_distribution<> share(-1, 1);
  Point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = share(random) * kHalfBox[k];
  const std::size_t first = random() % 3, second = random() % 3;
  const double depth = kHalfBox[first] - std::fabs(p[first]);
  if (first == second) {
    p[first] = 0;
  } else {
    p[second] = std::copysign(kHalfBox[second] - depth, p[second]);
    if (depth > kHalfBox[second]) return std::nullopt;
  }
  const double radius = kHalfBox[first] - std::fabs(p[first]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (kHalfBox[k] - std::fabs(p[k]) < radius - 1e-12) return std::nullopt;
  }
  return p;
}

TEST(AnyBoundary, NoVoxelOfTheMedialSurfaceOfABoxIsProvedEmpty) {
  const BoundaryExtraction result = extract(box(), options_of(30, 3));
  expect_sound(result, box());
  const Answered answered(result.extraction);
  std::mt19937_64 random(7);
  int points = 0, found = 0, deep = 0;
  while (points < 20'000) {
    const std::optional<Point> p = medial_point_of_box(random);
    if (!p) continue;
    ++points;
    const Voxel voxel = voxel_of(result.extraction.grid, *p);
    const bool is_found = answered.found.count(voxel) > 0;
    ASSERT_TRUE(is_found || answered.undecided.count(voxel) > 0) << (*p)[0] << ' ' << (*p)[1] << ' ' << (*p)[2];
    // Voxels that sheets cut a corner of stay undecided at this depth.
    const double radius = length(*p - nearest_on_box(*p));
    if (radius < result.extraction.grid.voxel_size) continue;
    ++deep;
    found += is_found ? 1 : 0;
  }
  EXPECT_GT(found, 0.99 * deep);
  const ExtractionCounters& counters = result.extraction.measurements.counters;
  EXPECT_GT(counters.proved_empty, counters.found);
}

TEST(AnyBoundary, ACloudOfTwoPointsHasAPlane) {
  const Point a = {-0.3, -0.2, 0.1}, b = {0.35, 0.1, 0.2};
  const BoundaryFunctions boundary = cloud({a, b}, {-1, -1, -1}, {1, 1, 1});
  const BoundaryExtraction result = extract(boundary, options_of(16, 4));
  expect_sound(result, boundary);
  const Answered answered(result.extraction);
  const Point normal = (1 / length(b - a)) * (b - a), middle = 0.5 * (a + b);
  for (std::size_t i = 0; i < result.axis_distance.size(); ++i) {
    EXPECT_LE(std::fabs(dot(result.extraction.spheres[i].centre - middle, normal)), result.axis_distance[i] + 1e-12);
  }
  // Points of the plane from which a and b are seen at twice the threshold.
  std::mt19937_64 random(8);
  std::uniform_real_distribution<> share(-1, 1);
  int points = 0;
  for (int i = 0; i < 20'000; ++i) {
    Point p;
    for (double& x : p) x = share(random);
    p = p - dot(p - middle, normal) * normal;
    if (std::fabs(p[0]) >= 1 || std::fabs(p[1]) >= 1 || std::fabs(p[2]) >= 1) continue;
    if (std::asin(0.5 * length(b - a) / length(p - a)) < kTheta) continue;
    ++points;
    const Voxel voxel = voxel_of(result.extraction.grid, p);
    EXPECT_TRUE(answered.found.count(voxel) + answered.undecided.count(voxel) > 0);
  }
  EXPECT_GT(points, 1000);
  EXPECT_GT(answered.found.size(), 30u);
  EXPECT_GT(result.extraction.measurements.counters.proved_empty, answered.undecided.size());
}

/// The box, by answers that are off by up to `error`, and of which any that is near enough may be given.
BoundaryFunctions rough_box(double error) {
  BoundaryFunctions boundary = box();
  boundary.error = error;
  const std::function<void(std::span<const Point>, std::span<Point>)> exact = boundary.nearest;
  boundary.nearest = [exact, error](std::span<const Point> points, std::span<Point> answers) {
    exact(points, answers);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double angle = 1e6 * (points[i][0] + 2 * points[i][1] + 3 * points[i][2]);
      answers[i] = answers[i] + (0.99 * error) * Point{std::cos(angle), std::sin(angle), 0};
    }
  };
  return boundary;
}

/// To the medial axis of the box: the bisectors of its faces, where these are the nearest two.
double distance_to_axis_of_box(const Point& p) {
  std::array<double, 3> depths;
  for (std::size_t k = 0; k < 3; ++k) depths[k] = kHalfBox[k] - std::fabs(p[k]);
  // The middle plane of two parallel faces, and the planes between the nearest face and others at right angles.
  const std::size_t near = static_cast<std::size_t>(std::min_element(depths.begin(), depths.end()) - depths.begin());
  double least = std::fabs(p[near]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (k != near) least = std::min(least, (depths[k] - depths[near]) / std::numbers::sqrt2);
  }
  return least;
}

TEST(AnyBoundary, AnswersMayHaveAnError) {
  std::mt19937_64 random(11);
  for (const Mode mode : {Mode::kCertified, Mode::kThesis}) {
    ExtractionOptions options = options_of(16);
    options.mode = mode;
    const BoundaryFunctions boundary = rough_box(1e-4);
    const BoundaryExtraction result = extract(boundary, options);
    EXPECT_GT(result.extraction.spheres.size(), 300u);
    for (std::size_t i = 0; i < result.extraction.spheres.size(); ++i) {
      const MedialSphere& sphere = result.extraction.spheres[i];
      EXPECT_LE(sphere.radius, length(sphere.centre - nearest_on_box(sphere.centre)));
      EXPECT_GE(result.axis_distance[i], distance_to_axis_of_box(sphere.centre) - 1e-12);
    }
    if (mode == Mode::kThesis) continue;
    const Answered answered(result.extraction);
    for (int points = 0; points < 5000;) {
      const std::optional<Point> p = medial_point_of_box(random);
      if (!p) continue;
      ++points;
      const Voxel voxel = voxel_of(result.extraction.grid, *p);
      EXPECT_TRUE(answered.found.count(voxel) + answered.undecided.count(voxel) > 0);
    }
  }
}

TEST(AnyBoundary, TheResultDependsNotOnThreads) {
  ExtractionOptions options = options_of(16);
  for (const Mode mode : {Mode::kCertified, Mode::kThesis}) {
    options.mode = mode;
    options.threads = 1;
    const BoundaryExtraction one = extract(box(), options);
    options.threads = 3;
    const BoundaryExtraction three = extract(box(), options);
    ASSERT_EQ(one.extraction.spheres.size(), three.extraction.spheres.size());
    for (std::size_t i = 0; i < one.extraction.spheres.size(); ++i) {
      EXPECT_EQ(one.extraction.spheres[i].centre, three.extraction.spheres[i].centre);
      EXPECT_EQ(one.extraction.spheres[i].flux, three.extraction.spheres[i].flux);
      EXPECT_EQ(one.axis_distance[i], three.axis_distance[i]);
    }
    ASSERT_EQ(one.extraction.undecided.size(), three.extraction.undecided.size());
    for (std::size_t i = 0; i < one.extraction.undecided.size(); ++i) {
      EXPECT_EQ(one.extraction.undecided[i].voxel, three.extraction.undecided[i].voxel);
      EXPECT_EQ(one.extraction.undecided[i].kind, three.extraction.undecided[i].kind);
      EXPECT_EQ(one.extraction.undecided[i].width, three.extraction.undecided[i].width);
    }
    EXPECT_EQ(one.extraction.measurements.counters.queries, three.extraction.measurements.counters.queries);
  }
}

TEST(AnyBoundary, CountersAreSharesOfTheLongestSide) {
  const BoundaryExtraction result = extract(box(), options_of(16));
  const ExtractionCounters& counters = result.extraction.measurements.counters;
  ASSERT_EQ(counters.levels.size(), 4u);  // 1/8, and two levels below the voxels
  for (std::size_t i = 0; i < counters.levels.size(); ++i) {
    EXPECT_DOUBLE_EQ(counters.levels[i].cell_size, std::ldexp(0.125, -static_cast<int>(i)));
  }
  EXPECT_EQ(counters.levels[1].visited, counters.found + counters.undecided + counters.proved_empty);
}

TEST(AnyBoundary, SheetsAreFoundAsFromAMesh) {
  ExtractionOptions options = options_of(24);
  const BoundaryExtraction result = extract(box(), options);
  const Result<Sheets> sheets = find_sheets(result.extraction.spheres, result.extraction.grid, options, {});
  ASSERT_TRUE(sheets);
  EXPECT_EQ(sheets.value().sheets.size(), 13u);  // of a box with three different sides
}

TEST(AnyBoundary, GridsMayBeFlatOrOneVoxel) {
  BoundaryFunctions flat = box();
  flat.lower[2] = flat.upper[2] = 0.0;
  const BoundaryExtraction layer = extract(flat, options_of(16));
  EXPECT_EQ(layer.extraction.grid.size[2], 1u);
  EXPECT_GT(layer.extraction.spheres.size(), 30u);
  EXPECT_EQ(extract(box(), options_of(1, 6)).extraction.spheres.size(), 1u);
}

// The flux through spheres around voxels on the plane z = 0 is that of two half balls: half of 1 on either side.
TEST(AnyBoundary, FluxIsThatOfTheSource) {
  const BoundaryExtraction result = extract(box(), options_of(16));
  int compared = 0;
  for (const MedialSphere& sphere : result.extraction.spheres) {
    const bool is_in_middle =
        std::fabs(sphere.centre[2]) < 1e-9 && std::fabs(sphere.centre[0]) < 0.3 && std::fabs(sphere.centre[1]) < 0.1;
    if (!is_in_middle) continue;
    ++compared;
    EXPECT_NEAR(sphere.flux, 0.5, 0.15);
  }
  EXPECT_GT(compared, 3);
}

TEST(AnyBoundary, WithARadiusDeepPointsNeedALesserAngle) {
  ExtractionOptions options = options_of(24);
  options.object_angle = 1.2;
  const std::size_t without = extract(box(), options).extraction.spheres.size();
  options.radius = 0.1;
  options.deep_angle = 0.3;
  EXPECT_GT(extract(box(), options).extraction.spheres.size(), without);
}

TEST(AnyBoundary, BadArgumentsAreErrors) {
  const auto message = [](const BoundaryFunctions& boundary, const ExtractionOptions& options) {
    const Result<BoundaryExtraction> result = extract_medial_spheres(boundary, options);
    EXPECT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kUsage);
    return result.error().message;
  };
  BoundaryFunctions none = box();
  none.nearest = {};
  EXPECT_EQ(message(none, options_of(8)), "`nearest` must be a function");
  BoundaryFunctions empty = box();
  empty.upper = empty.lower;
  EXPECT_EQ(message(empty, options_of(8)), "the longest side of the box must be 1e-90 to 1e90");
  BoundaryFunctions infinite = box();
  infinite.upper[1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(message(infinite, options_of(8)), "`lower` and `upper` must span a finite box");
  BoundaryFunctions far = box();
  far.lower = far.lower + Point{1e15, 0, 0};
  far.upper = far.upper + Point{1e15, 0, 0};
  EXPECT_EQ(message(far, options_of(8)), "`lower` and `upper` are too far from the origin for a box of this size");
  BoundaryFunctions rough = box();
  rough.error = 0.1;
  EXPECT_EQ(message(rough, options_of(8)),
            "`error` must be 0 or more, and at most epsilon (1 - cos `object_angle`) / 2 voxel sides");
  EXPECT_EQ(message(box(), options_of(0)), "`resolution` must be 1 to 4096");
  ExtractionOptions samples = options_of(8);
  samples.thesis.samples[2] = 0;
  EXPECT_EQ(message(box(), samples), "`samples` must be 1 to 4096");
  BoundaryFunctions broken = box();
  broken.nearest = [](std::span<const Point>, std::span<Point> answers) {
    std::fill(answers.begin(), answers.end(), Point{0, std::numeric_limits<double>::quiet_NaN(), 0});
  };
  const std::string about = message(broken, options_of(8));
  EXPECT_EQ(about.substr(0, 47), "`nearest` gave a point that is not finite for (");
  BoundaryFunctions distant = cloud({{-1e9, 0, 0}, {1e9, 0, 0}}, {-1, -1, -1}, {1, 1, 1});
  EXPECT_NE(message(distant, options_of(8)).find("more than 64 diagonals of the box away"), std::string::npos);
}

TEST(AnyBoundary, ExceptionsOfTheBoundaryLeaveTheCall) {
  BoundaryFunctions boundary = box();
  boundary.nearest = [](std::span<const Point>, std::span<Point>) { throw std::runtime_error("no answer"); };
  EXPECT_THROW((void)extract_medial_spheres(boundary, options_of(8)), std::runtime_error);
}

TEST(AnyBoundary, StopsWhenRequested) {
  std::stop_source stop;
  BoundaryFunctions boundary = box();
  const auto exact = boundary.nearest;
  std::atomic<int> batches = 0;
  boundary.nearest = [&](std::span<const Point> points, std::span<Point> answers) {
    if (++batches == 20) stop.request_stop();
    exact(points, answers);
  };
  const Result<BoundaryExtraction> result = extract_medial_spheres(boundary, options_of(64), {}, stop.get_token());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
  EXPECT_LT(batches, 100);
}

TEST(AnyBoundary, ProgressGrowsToOne) {
  double last = 0;
  const Result<BoundaryExtraction> result = extract_medial_spheres(box(), options_of(12), [&](double done) {
    EXPECT_GE(done, last);
    last = done;
  });
  EXPECT_TRUE(result);
  EXPECT_EQ(last, 1);
}

// Between two points the medial axis is their bisector: the bound is never below the distance to it, whatever answers
// the error allows.
TEST(AxisDistance, BoundsTheDistanceToTheBisector) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<> share(-1, 1);
  // Farther from `at`, or nearer for a negative shift: what misleads most.
  const auto moved = [](const Point& p, const Point& at, double shift) {
    return p + (shift / length(p - at)) * (p - at);
  };
  int useful = 0;
  for (int i = 0; i < 40'000; ++i) {
    const Point a = {-1, 0, 0}, b = {1, 0, 0};
    const double off = std::pow(10, -6 * std::fabs(share(random)));
    Point at = {off, 0, 0};
    for (std::size_t k = 1; k < 3; ++k) at[k] = 2 * share(random);
    const double error = i % 2 == 0 ? 0 : off * std::fabs(share(random));
    const Point nearest = moved(b, at, error), near_a = moved(a, at, -error), near_b = moved(b, at, -error);
    const double bound = any_boundary::axis_distance({at, nearest, near_a, near_b}, error);
    ASSERT_GE(bound, off * (1 - 1e-9));
    useful += bound < 20 * off ? 1 : 0;
  }
  EXPECT_GT(useful, 10'000);
}

}  // namespace
}  // namespace medial_vk::test
