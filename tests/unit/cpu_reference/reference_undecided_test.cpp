// The properties of undecided voxels: hidden medial points are of their kind, with feet no farther apart than stated.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "cpu_reference/extract.h"
#include "support/medial_samples.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;
using reference::Result;
using reference::Undecided;
using reference::UndecidedKind;

using Key = std::tuple<int, int, int>;
Key key_of(const Eigen::Vector3i& voxel) { return {voxel.z(), voxel.y(), voxel.x()}; }

reference::Mesh turned(Mesh mesh) {
  test::rotate(mesh, {0.3, -0.5, 0.8}, 0.7);
  return test::to_reference(mesh);
}

void expect_ordered(const Result& result) {
  ASSERT_EQ(result.undecided_voxels.size(), result.undecided);
  for (std::size_t i = 1; i < result.undecided_voxels.size(); ++i) {
    EXPECT_LT(key_of(result.undecided_voxels[i - 1].voxel), key_of(result.undecided_voxels[i].voxel));
  }
}

/// Compares every independent sample whose voxel has no point with the stated properties of its voxel; counts them.
int expect_stated_properties(const reference::Mesh& mesh, const Result& result, double angle) {
  const reference::Tree tree(mesh);
  std::map<Key, const Undecided*> undecided;
  for (const Undecided& u : result.undecided_voxels) undecided[key_of(u.voxel)] = &u;
  std::map<Key, int> found;
  for (const reference::Sphere& s : result.spheres) found[key_of(s.voxel)] = 1;
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> share(0, 1);
  int hidden = 0;
  for (int i = 0; i < 12000; ++i) {
    const Vector3d where(share(engine), share(engine), share(engine));
    const auto sample = test::medial_sample(tree, tree.lower() + where.cwiseProduct(tree.upper() - tree.lower()));
    if (!sample || sample->object_angle < angle + 1e-4) continue;
    const Vector3d scaled = (sample->point - result.grid_origin) / result.voxel_size;
    const Vector3d inside = scaled - Vector3d(scaled.array().floor());
    const double to_face = std::min(inside.minCoeff(), 1 - inside.maxCoeff());
    const Key key = key_of(scaled.array().floor().cast<int>());
    if (to_face < 1e-6 || found.count(key) != 0) continue;
    ++hidden;
    EXPECT_EQ(undecided.count(key), 1u) << "lost at " << sample->point.transpose();
    if (undecided.count(key) == 0) continue;
    const Undecided& u = *undecided[key];
    const bool near_face = to_face <= 1.0 / 64 + 1e-6, near_angle = sample->object_angle <= angle + 0.05 + 1e-6;
    EXPECT_TRUE(u.kind != UndecidedKind::kNearFace || near_face) << to_face;
    EXPECT_TRUE(u.kind != UndecidedKind::kNearAngle || near_face || near_angle) << sample->object_angle;
    const bool small = sample->radius <= 1.0 / 8 * result.voxel_size * (1 + 1e-6);
    EXPECT_TRUE(u.kind != UndecidedKind::kBoundary || near_face || near_angle || small) << sample->radius;
    EXPECT_LE(2 * sample->radius * std::sin(sample->object_angle), u.width * (1 + 1e-6));
  }
  return hidden;
}

TEST(ReferenceUndecided, HiddenPointsAreAsTheirVoxelSays) {
  const double angle = 0.6;
  int hidden = 0;
  for (const Mesh& solid :
       {test::make_l_shape(1, 0.35, 0.6), test::make_ellipsoid({1, 1, 0.4}, 40), test::make_cup(0.6, 0.2, 1, 24)}) {
    const reference::Mesh mesh = turned(solid);
    for (const int levels : {0, 2, 6}) {
      reference::Options options;
      options.object_angle = angle;
      options.resolution = 25;
      options.extra_levels = levels;
      const Result result = reference::extract(mesh, options);
      expect_ordered(result);
      hidden += expect_stated_properties(mesh, result, angle);
    }
  }
  EXPECT_GT(hidden, 30);
}

// Where nothing is trusted, few of the boundary's voxels stay undecided: those at edges, with medial points on one
// side.
TEST(ReferenceUndecided, UntrustedBoundaryIsDecided) {
  reference::Mesh mesh = turned(test::make_l_shape(1, 0.35, 0.6));
  mesh.trusted.clear();
  reference::Options options;
  options.resolution = 20;
  const Result result = reference::extract(mesh, options);
  expect_ordered(result);
  std::array<int, 4> kinds = {0, 0, 0, 0};
  for (const Undecided& u : result.undecided_voxels) ++kinds[static_cast<std::size_t>(u.kind)];
  EXPECT_LT(kinds[static_cast<std::size_t>(UndecidedKind::kBoundary)], 30);
  EXPECT_EQ(kinds[static_cast<std::size_t>(UndecidedKind::kOther)], 0);
  expect_stated_properties(mesh, result, options.object_angle);
}

}  // namespace
}  // namespace medial_vk
