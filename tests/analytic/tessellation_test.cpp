// The same smooth solids cut into triangles in many ways: the result must be the medial surface of the smooth solid,
// not of its facets. In both directions, within 1.5 voxels; tests/support/solids/mesh_guarantees.h derives what
// a mesh guarantees.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/solids/mesh_guarantees.h"
#include "support/solids/smooth_solids.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::SmoothMedialPoint;
using test::SmoothSolid;

constexpr std::uint32_t kResolution = 40;
constexpr double kNearby = 1.5;  // voxels
// Objects thinner than this need not be found: their angle barely passes, and the last bits of float decide.
constexpr double kClearAngle = 0.05;
constexpr double kNoise = 1e-4;  // of the longest side
constexpr std::uint32_t kCoarse = 1000;

const Vector3d kTurnAxis = Vector3d(0.3, 0.5, 0.8).normalized();
constexpr double kTurn = 0.7;

Mesh turned(Mesh mesh) {
  test::rotate(mesh, {kTurnAxis.x(), kTurnAxis.y(), kTurnAxis.z()}, kTurn);
  return mesh;
}

Matrix3d to_world() { return Eigen::AngleAxisd(kTurn, kTurnAxis).toRotationMatrix(); }

class OnDevice : public testing::Test {
 protected:
  void SetUp() override { MEDIAL_VK_SKIP_WITHOUT_DEVICE(); }

  static CertifiedExtraction extract(const PreparedMesh& mesh, double object_angle) {
    ExtractionOptions options;
    options.resolution = kResolution;
    options.object_angle = object_angle;
    return test::extract_on_device(test::quick_device(), mesh, options);
  }
};

std::vector<Vector3d> centres_in_body(const Extraction& extraction) {
  const Matrix3d back = to_world().transpose();
  std::vector<Vector3d> centres;
  for (const MedialSphere& s : extraction.spheres) centres.emplace_back(back * test::to_eigen(s.centre));
  return centres;
}

double distance_to_nearest(const std::vector<Vector3d>& points, const Vector3d& p) {
  double squared = std::numeric_limits<double>::infinity();
  for (const Vector3d& q : points) squared = std::min(squared, (q - p).squaredNorm());
  return std::sqrt(squared);
}

/// The fineness and the kind of the triangulation.
struct Cut {
  std::uint32_t triangles;
  bool is_irregular, is_noisy;

  std::string name() const {
    return std::to_string(triangles) + (is_irregular ? " irregular" : " regular") + (is_noisy ? " noisy" : " smooth");
  }
};

Mesh cut(const SmoothSolid& solid, const Cut& how) {
  Mesh mesh = solid.mesh(how.triangles);
  if (how.is_irregular) test::make_irregular(solid, mesh, 5);
  if (how.is_noisy) test::add_noise(mesh, kNoise * test::longest_side(mesh), 6);
  return mesh;
}

struct SmoothCase {
  std::string name;
  std::unique_ptr<SmoothSolid> (*solid)();
  std::uint32_t triangles;
};

std::ostream& operator<<(std::ostream& out, const SmoothCase& smooth) { return out << smooth.name; }

class Tessellation : public OnDevice, public testing::WithParamInterface<SmoothCase> {};

/// A count that must be 0, and the size of the worst case.
struct Verdict {
  std::size_t judged = 0, failed = 0;
  double worst = 0;  // voxels

  void judge(double distance, double allowed) {
    ++judged;
    failed += distance > allowed;
    worst = std::max(worst, distance);
  }
};

/// The known properties of a mesh, for all tests of it.
struct Expectation {
  const SmoothSolid& solid;
  double deviation;
  std::vector<test::Guarantee> guarantees;
};

Verdict judge_outputs(const Expectation& expected, const Extraction& extraction) {
  const double voxel = extraction.grid.voxel_size, epsilon = ExtractionOptions{}.epsilon * voxel;
  const std::vector<Vector3d> centres = centres_in_body(extraction);
  Verdict verdict;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const double allowed = test::farthest_off(extraction.spheres[i], expected.deviation, epsilon) / voxel;
    verdict.judge(expected.solid.distance_to_medial_surface(centres[i]) / voxel, std::max(kNearby, allowed));
  }
  return verdict;
}

Verdict judge_guarantees(const Expectation& expected, const Extraction& extraction, double object_angle) {
  const double voxel = extraction.grid.voxel_size;
  const std::vector<Vector3d> found = centres_in_body(extraction);
  Verdict verdict;
  for (const test::Guarantee& g : expected.guarantees) {
    if (g.object_angle < object_angle + kClearAngle) continue;
    verdict.judge(distance_to_nearest(found, g.point) / voxel, kNearby);
  }
  return verdict;
}

void expect_agreement(const Expectation& expected, const Extraction& extraction, double object_angle) {
  const Verdict outputs = judge_outputs(expected, extraction);
  EXPECT_GT(outputs.judged, 0u);
  EXPECT_EQ(outputs.failed, 0u) << "of " << outputs.judged
                                << " points are far from the smooth medial surface, the worst " << outputs.worst
                                << " voxels";
  const Verdict guarantees = judge_guarantees(expected, extraction, object_angle);
  // Facets and noise turn normals by less than the difference between the threshold and the widest angles.
  EXPECT_GT(guarantees.judged, 0u);
  EXPECT_EQ(guarantees.failed, 0u) << "of " << guarantees.judged
                                   << " smooth medial points have no point near, the worst none in " << guarantees.worst
                                   << " voxels";
}

/// Regular and irregular, with and without noise.
std::vector<Cut> cuts(std::uint32_t triangles) {
  return {{triangles, false, false}, {triangles, true, true}, {triangles, false, true}, {triangles, true, false}};
}

TEST_P(Tessellation, MedialSurfaceIsThatOfTheSmoothSolid) {
  const std::unique_ptr<SmoothSolid> solid = GetParam().solid();
  for (const Cut& how : cuts(GetParam().triangles)) {
    SCOPED_TRACE(how.name());
    const Mesh mesh = cut(*solid, how);
    const PreparedMesh prepared = test::prepare(turned(mesh));
    ASSERT_TRUE(prepared.report.closed);
    ASSERT_EQ(prepared.report.trusted_triangles, mesh.triangles.size());
    const double voxel = prepared.report.longest_side() / kResolution, deviation = test::deviation(*solid, mesh);
    const Expectation expected = {*solid, deviation, test::guarantees_of(*solid, mesh, deviation, voxel / 2)};
    for (const double object_angle : {0.4, 0.6, 0.9, 1.2}) {
      const CertifiedExtraction result = extract(prepared, object_angle);
      SCOPED_TRACE("object angle " + std::to_string(object_angle) + ": " + test::describe(result));
      expect_agreement(expected, result.extraction, object_angle);
    }
  }
}

std::unique_ptr<SmoothSolid> torus() { return test::smooth_torus(1, 0.35); }
std::unique_ptr<SmoothSolid> capsule() { return test::smooth_pear(0.4, 0.4, 1.5); }
std::unique_ptr<SmoothSolid> pear() { return test::smooth_pear(0.5, 0.2, 1); }
std::unique_ptr<SmoothSolid> oblate() { return test::smooth_ellipsoid(1, 1, 0.4); }
std::unique_ptr<SmoothSolid> prolate() { return test::smooth_ellipsoid(1, 0.4, 0.4); }
std::unique_ptr<SmoothSolid> triaxial() { return test::smooth_ellipsoid(1, 0.6, 0.35); }

std::vector<SmoothCase> all_cases() {
  std::vector<SmoothCase> cases;
  for (const std::uint32_t finer : {1u, 4u, 16u}) {
    const std::string suffix = "_" + std::to_string(finer) + "x";
    cases.push_back({"torus" + suffix, &torus, finer * kCoarse});
    cases.push_back({"capsule" + suffix, &capsule, finer * kCoarse});
    cases.push_back({"pear" + suffix, &pear, finer * kCoarse});
    cases.push_back({"oblate" + suffix, &oblate, finer * kCoarse});
    cases.push_back({"prolate" + suffix, &prolate, finer * kCoarse});
    cases.push_back({"triaxial" + suffix, &triaxial, finer * kCoarse});
  }
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Smooth, Tessellation, testing::ValuesIn(all_cases()),
                         [](const auto& smooth) { return smooth.param.name; });

// Thin curves: voxels of the points, and voxels that the smooth curve crosses.
using Voxels = std::set<test::Voxel>;

Voxels voxels_with_a_point(const Extraction& extraction) {
  Voxels voxels;
  for (const auto& [voxel, index] : test::spheres_by_voxel(extraction)) voxels.insert(voxel);
  return voxels;
}

/// Voxels that a curve crosses, with its greatest distance from their faces, as a fraction of the voxel side.
std::map<test::Voxel, double> crossed_voxels(const SmoothSolid& solid, const VoxelGrid& grid) {
  std::map<test::Voxel, double> voxels;
  const Matrix3d turn = to_world();
  for (const SmoothMedialPoint& m : solid.medial_points(1e-3 * grid.voxel_size)) {
    const Vector3d p = turn * m.point;
    double& depth = voxels[test::voxel_of(grid, p)];
    depth = std::max(depth, test::depth_in_voxel(grid, p));
  }
  return voxels;
}

/// The voxel and its 26 neighbours.
std::array<test::Voxel, 27> block_around(const test::Voxel& v) {
  std::array<test::Voxel, 27> block;
  for (int i = 0; i < 27; ++i) block[i] = {v[0] + i % 3 - 1, v[1] + i / 3 % 3 - 1, v[2] + i / 9 - 1};
  return block;
}

/// Sets that are connected through faces, edges and corners of voxels.
std::size_t count_components(Voxels voxels) {
  std::size_t components = 0;
  for (; !voxels.empty(); ++components) {
    std::deque<test::Voxel> front = {*voxels.begin()};
    voxels.erase(voxels.begin());
    for (; !front.empty(); front.pop_front()) {
      for (const test::Voxel& next : block_around(front.front())) {
        if (voxels.erase(next) != 0) front.push_back(next);
      }
    }
  }
  return components;
}

bool has_any_of(const Voxels& voxels, const std::array<test::Voxel, 27>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const test::Voxel& v) { return voxels.contains(v); });
}

class ThinCurve : public OnDevice, public testing::WithParamInterface<SmoothCase> {};

TEST_P(ThinCurve, IsAConnectedChainOfVoxels) {
  const std::unique_ptr<SmoothSolid> solid = GetParam().solid();
  for (const bool is_irregular : {false, true}) {
    const Cut how = {GetParam().triangles, is_irregular, false};
    const CertifiedExtraction result = extract(test::prepare(turned(cut(*solid, how))), 0.6);
    SCOPED_TRACE(how.name() + ": " + test::describe(result));
    const Voxels found = voxels_with_a_point(result.extraction);
    EXPECT_EQ(count_components(found), 1u) << "of " << found.size() << " voxels";
    const auto crossed = crossed_voxels(*solid, result.extraction.grid);
    const auto bare = std::count_if(crossed.begin(), crossed.end(),
                                    [&](const auto& c) { return !has_any_of(found, block_around(c.first)); });
    EXPECT_EQ(bare, 0) << "of " << crossed.size() << " voxels on the curve have no point, and no neighbour with one";
  }
}

std::vector<SmoothCase> round_tubes() {
  std::vector<SmoothCase> cases = all_cases();
  std::erase_if(cases, [](const SmoothCase& c) { return c.solid != &torus && c.solid != &capsule; });
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Smooth, ThinCurve, testing::ValuesIn(round_tubes()),
                         [](const auto& smooth) { return smooth.param.name; });

// The curve of the mesh may miss a voxel that the smooth one barely touches: crossings deeper than the reach of a
// guarantee (mesh_guarantees.h, alpha = pi/2) and epsilon are found without exception, and nearly all of any depth.
TEST_F(OnDevice, FindsNearlyEveryVoxelThatTheCircleOfATorusCrosses) {
  const std::unique_ptr<SmoothSolid> solid = torus();
  const Mesh mesh = solid->mesh(16 * kCoarse);
  const CertifiedExtraction result = extract(test::prepare(turned(mesh)), 0.6);
  SCOPED_TRACE(test::describe(result));
  const VoxelGrid& grid = result.extraction.grid;
  const double deep = 8.0 / 3 * test::deviation(*solid, mesh) / grid.voxel_size + ExtractionOptions{}.epsilon;
  const Voxels found = voxels_with_a_point(result.extraction);
  const auto crossed = crossed_voxels(*solid, grid);
  std::size_t hit = 0;
  for (const auto& [voxel, depth] : crossed) {
    hit += found.count(voxel);
    EXPECT_TRUE(found.contains(voxel) || depth <= deep) << "no point in a voxel that is crossed " << depth << " deep";
  }
  EXPECT_GE(static_cast<double>(hit), 0.98 * static_cast<double>(crossed.size())) << hit << " of " << crossed.size();
}

}  // namespace
}  // namespace medial_vk
