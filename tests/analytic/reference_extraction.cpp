// The reference's medial points against solids whose medial surface is known.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpu_reference/certificate.h"
#include "cpu_reference/extract.h"
#include "cpu_reference/queries.h"
#include "support/medial_samples.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;
using reference::Options;
using reference::Result;

constexpr double kAngle = 0.7;
const Point kAxis = {0.3, -0.5, 0.8};

void expect_certified(const reference::Mesh& mesh, const Result& result, const Options& p) {
  const double side = reference::Tree(mesh).longest_side();
  const auto certificate =
      reference::check(mesh, result, p.epsilon * result.voxel_size, p.object_angle, p.radius * side);
  for (const auto& line : certificate.lines) {
    EXPECT_EQ(line.failed, 0u) << line.condition << ": " << line.first_failure;
    EXPECT_EQ(line.tested, result.spheres.size());
  }
}

/// Distances from p to the planes of the six faces of a box at the origin, turned by kAxis and kAngle.
struct BoxFaces {
  explicit BoxFaces(const Vector3d& box_size) : size(box_size) {
    back = Eigen::AngleAxisd(-kAngle, Vector3d(kAxis[0], kAxis[1], kAxis[2]).normalized()).toRotationMatrix();
  }
  std::array<double, 6> distances(const Vector3d& p) const {
    const Vector3d local = back * p, other = size - local;
    std::array<double, 6> d = {local.x(), local.y(), local.z(), other.x(), other.y(), other.z()};
    return d;
  }
  Vector3d size;
  Eigen::Matrix3d back;
};

reference::Mesh turned(Mesh mesh) {
  test::rotate(mesh, kAxis, kAngle);
  return test::to_reference(mesh);
}

TEST(ReferenceAnalytic, DistanceToASphere) {
  const reference::Tree tree(test::to_reference(test::make_sphere(1, 5000)));
  const double sagitta = 0.01;  // edges of 5000 faces on 4 pi are about 0.076 long: 0.076^2 / 3 / 2
  for (const Vector3d& p : reference::spiral_points(200)) {
    for (double r : {0.0, 0.3, 0.9, 1.5}) {
      const double distance = tree.closest(r * p).distance;
      EXPECT_NEAR(distance, std::abs(1 - r), sagitta);
      EXPECT_EQ(reference::is_inside(tree, r * p), r < 1);
    }
  }
}

// In a convex solid the distance is the least distance to the plane of a face, and a point is medial if two are least.
class BoxInMode : public testing::TestWithParam<bool> {};

TEST_P(BoxInMode, EveryPointIsOnABisector) {
  const Vector3d size(0.5, 0.8, 1.3);
  const BoxFaces box(size);
  const reference::Mesh mesh = turned(test::make_box({size.x(), size.y(), size.z()}));
  Options options;
  options.certified = GetParam();
  options.resolution = 40;
  const Result result = reference::extract(mesh, options);
  const double epsilon = options.epsilon * result.voxel_size;
  ASSERT_GT(result.spheres.size(), 500u);
  for (const reference::Sphere& s : result.spheres) {
    std::array<double, 6> d = box.distances(s.centre);
    std::sort(d.begin(), d.end());
    EXPECT_NEAR(s.radius, d[0], 1e-12);
    EXPECT_LE(d[1] - d[0], 2 * epsilon);  // the medial surface is within epsilon, distances change by as much
    EXPECT_GE(s.object_angle, options.object_angle);
  }
  expect_certified(mesh, result, options);
}

INSTANTIATE_TEST_SUITE_P(Modes, BoxInMode, testing::Bool(),
                         [](const auto& mode) { return mode.param ? "Certified" : "Thesis"; });

// Sheets of a box have object angle pi/4 (between neighbours) or pi/2 (the middle): all are above 0.6.
TEST(ReferenceAnalytic, EveryVoxelOfABoxIsFound) {
  const reference::Mesh mesh = turned(test::make_box({0.5, 0.8, 1.3}));
  const reference::Tree tree(mesh);
  Options options;
  options.resolution = 40;
  const auto all = [](const test::MedialSample&) { return true; };
  const Result certified = reference::extract(mesh, options);
  const test::Recall recall = test::recall_of(tree, certified, 4000, all);
  EXPECT_EQ(recall.samples, 4000);
  EXPECT_EQ(recall.found, recall.samples) << "first missed " << recall.first_missed.transpose();
  EXPECT_LT(certified.undecided, certified.found / 10);
  // The published search skips some voxels: flux of finitely many samples, and one line per sample.
  options.certified = false;
  EXPECT_GT(test::recall_of(tree, reference::extract(mesh, options), 4000, all).share(), 0.9);
}

TEST(ReferenceAnalytic, SpheresOfACubeInItsOwnGrid) {
  // Not turned: sheets lie on voxel faces and edges, with ties everywhere.
  const reference::Mesh mesh = test::to_reference(test::make_box({1, 1, 1}));
  Options options;
  options.resolution = 17;
  const Result result = reference::extract(mesh, options);
  EXPECT_GT(result.found, 17u * 17u);
  expect_certified(mesh, result, options);
}

// The ideal medial surface is a segment. Facets of sagitta s put salient points at most s / (1 - cos(2 theta)) away
// from it: a point at that distance has its nearest facets all on one side.
TEST(ReferenceAnalytic, CapsuleKeepsToItsAxis) {
  constexpr int kSegments = 64;
  const double radius = 0.4, length = 1.0;
  const reference::Mesh mesh = turned(test::make_capsule(radius, length, kSegments));
  Options options;
  options.resolution = 30;
  const Result result = reference::extract(mesh, options);
  const Vector3d axis = BoxFaces(Vector3d::Ones()).back.transpose() * Vector3d::UnitZ();
  const double half = length / 2;
  const double sagitta = 2 * radius * (1 - std::cos(std::numbers::pi / kSegments));
  const double off = sagitta / (1 - std::cos(2 * options.object_angle)) + 2 * options.epsilon * result.voxel_size;
  std::vector<double> along;
  for (const reference::Sphere& s : result.spheres) {
    const double z = axis.dot(s.centre);
    EXPECT_LT((s.centre - z * axis).norm(), off);
    EXPECT_LT(std::abs(z), half + off);
    EXPECT_NEAR(s.radius, radius, 2 * off);
    along.push_back(z);
  }
  // The axis is found in nearly every voxel that it crosses: no gap of more than three voxels.
  ASSERT_GT(along.size(), 12u);
  std::sort(along.begin(), along.end());
  for (std::size_t i = 1; i < along.size(); ++i) EXPECT_LT(along[i] - along[i - 1], 3 * result.voxel_size);
  EXPECT_GT(along.back() - along.front(), length - 4 * result.voxel_size);
  expect_certified(mesh, result, options);
}

struct Solid {
  const char* name;
  Mesh mesh;
  int resolution;
};

TEST(ReferenceAnalytic, IndependentSamplesAreFound) {
  const Solid solids[] = {{"L", test::make_l_shape(1, 0.35, 0.6), 40},
                          {"cup", test::make_cup(0.6, 0.2, 1, 40), 30},
                          {"ellipsoid", test::make_ellipsoid({1, 1, 0.4}, 40), 30}};
  for (const Solid& solid : solids) {
    const reference::Mesh mesh = turned(solid.mesh);
    const reference::Tree tree(mesh);
    Options options;
    options.resolution = solid.resolution;
    const Result result = reference::extract(mesh, options);
    const auto salient = [](const test::MedialSample& s) { return s.object_angle >= 0.65; };
    const test::Recall recall = test::recall_of(tree, result, 1500, salient);
    EXPECT_EQ(recall.samples, 1500) << solid.name;
    EXPECT_EQ(recall.found, recall.samples) << solid.name << ", first missed " << recall.first_missed.transpose();
    expect_certified(mesh, result, options);
  }
}

TEST(ReferenceAnalytic, RadiusThresholdAddsDeepPoints) {
  const reference::Mesh mesh = turned(test::make_l_shape(1, 0.35, 0.6));
  const reference::Tree tree(mesh);
  Options options;
  options.resolution = 30;
  options.object_angle = 1.2;  // the sheets of the edges, pi/4, are salient by radius only
  const Result by_angle = reference::extract(mesh, options);
  options.radius = 0.05;
  const Result result = reference::extract(mesh, options);
  EXPECT_GT(result.found, by_angle.found);
  const double threshold = options.radius * tree.longest_side();
  const auto salient = [&](const test::MedialSample& s) {
    return s.object_angle >= 1.25 || (s.radius >= 1.02 * threshold && s.object_angle >= 0.1);
  };
  const test::Recall recall = test::recall_of(tree, result, 1500, salient);
  EXPECT_EQ(recall.found, recall.samples) << "first missed " << recall.first_missed.transpose();
  expect_certified(mesh, result, options);
  options.certified = false;
  expect_certified(mesh, reference::extract(mesh, options), options);
}

// Nothing may depend on normals or on closedness where these are not known.
TEST(ReferenceAnalytic, UntrustedAndOpenSolids) {
  reference::Mesh mesh = turned(test::make_l_shape(1, 0.35, 0.6));
  Options options;
  options.resolution = 20;
  mesh.trusted.clear();
  const reference::Tree tree(mesh);
  const Result untrusted = reference::extract(mesh, options);
  // Where the boundary does not touch the voxel, directions (Lemma C) serve as well as normals.
  const auto deep = [&](const test::MedialSample& s) {
    return s.object_angle >= 0.65 && s.radius > std::sqrt(3.0) * untrusted.voxel_size;
  };
  const test::Recall recall = test::recall_of(tree, untrusted, 1000, deep);
  EXPECT_EQ(recall.found, recall.samples) << "first missed " << recall.first_missed.transpose();
  const auto any = [](const test::MedialSample& s) { return s.object_angle >= 0.65; };
  EXPECT_GT(test::recall_of(tree, untrusted, 1000, any).share(), 0.95);
  expect_certified(mesh, untrusted, options);
  mesh.closed = false;
  mesh.triangles.pop_back();
  const Result open = reference::extract(mesh, options);
  EXPECT_GT(open.found, untrusted.found / 2);
  expect_certified(mesh, open, options);
}

}  // namespace
}  // namespace medial_vk
