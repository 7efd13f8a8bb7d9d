// The same solid, moved, scaled, turned or described in another order, has the same medial points. Where arithmetic is
// exact the results must be equal; where rounding or the search's order may differ, clear points must agree.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <string>

#include "support/device/device.h"
#include "support/extraction.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Clearly salient, clearly inside its voxel: neither rounding nor the order of the search decides about it.
bool is_clear(const Extraction& e, const MedialSphere& s, const ExtractionOptions& options) {
  return static_cast<double>(s.object_angle) >= options.object_angle + 0.05 &&
         test::depth_in_voxel(e.grid, test::to_eigen(s.centre)) >= 0.05;
}

using VoxelMap = std::function<test::Voxel(const test::Voxel&)>;

/// The number of clear points of `from` without a point of `to` in their mapped voxel.
std::size_t clear_points_without_partner(const Extraction& from, const Extraction& to, const VoxelMap& map,
                                         const ExtractionOptions& options) {
  const test::SphereByVoxel found = test::spheres_by_voxel(to);
  std::size_t missing = 0;
  for (const auto& [voxel, index] : test::spheres_by_voxel(from)) {
    missing += !found.contains(map(voxel)) && is_clear(from, from.spheres[index], options);
  }
  return missing;
}

/// Exact-arithmetic changes: same voxels, same floats; lengths mapped within `tolerance` (of the mapped ones).
void expect_equal_up_to(const Extraction& a, const Extraction& b, double factor, const Vector3d& offset,
                        double tolerance) {
  ASSERT_EQ(a.spheres.size(), b.spheres.size());
  for (std::size_t i = 0; i < a.spheres.size(); ++i) {
    const MedialSphere &s = a.spheres[i], &t = b.spheres[i];
    ASSERT_EQ(s.voxel, t.voxel) << i;
    EXPECT_LE((factor * test::to_eigen(s.centre) + offset - test::to_eigen(t.centre)).norm(), tolerance) << i;
    EXPECT_NEAR(factor * s.radius, t.radius, tolerance) << i;
    EXPECT_EQ(s.flux, t.flux) << i;
  }
}

class Invariance : public testing::Test {
 protected:
  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    context_ = std::make_unique<Context>(test::make_context());
    options_.resolution = 24;
    solid_ = test::make_cup(1, 0.25, 1.2, 32);
    test::rotate(solid_, {0.3, 0.5, 0.8}, 0.7);
    // Corners with few binary digits: 2^-20 is far below a voxel, and the changes below are exact.
    for (Point& p : solid_.vertices) {
      for (double& x : p) x = std::ldexp(std::round(std::ldexp(x, 20)), -20);
    }
    base_ = extract(solid_);
  }

  Extraction extract(const Mesh& solid) {
    const CertifiedExtraction result = test::extract_on_device(*context_, test::prepare(solid), options_);
    EXPECT_GT(result.extraction.spheres.size(), 500u);
    return result.extraction;
  }

  /// At most one clear point in 200 may differ: a voxel that one search leaves undecided.
  void expect_clear_points_agree(const Extraction& other, const VoxelMap& map, const VoxelMap& back) {
    const std::size_t most = 1 + base_.spheres.size() / 200;
    EXPECT_LE(clear_points_without_partner(base_, other, map, options_), most);
    EXPECT_LE(clear_points_without_partner(other, base_, back, options_), most);
  }

  std::unique_ptr<Context> context_;
  ExtractionOptions options_;
  Mesh solid_;
  Extraction base_;
};

const VoxelMap kSameVoxel = [](const test::Voxel& v) { return v; };

// Multiples of 2^-20 plus 2^21 (a million times the solid's size) need 42 bits: exact in double. The device sees the
// same floats. Centres are rounded to doubles near 4e6, 2^-31; radii get as much safety margin (certify.cpp: 4 units of
// rounding of the coordinates' magnitude).
TEST_F(Invariance, FarFromTheOrigin) {
  Mesh moved = solid_;
  const double far = std::ldexp(1, 21);
  test::translate(moved, {far, -far, far});
  expect_equal_up_to(base_, extract(moved), 1, Vector3d(far, -far, far), std::ldexp(1, -28));
}

// Powers of two scale without rounding; 1e6 and 1e-6 round each coordinate to 1e-16 of it, which may change the last
// bit of one float in 1e9 only. Lengths agree to the accuracy of the device's numbers.
TEST_F(Invariance, ScaledByPowersOfTwo) {
  for (const int exponent : {-20, 20}) {
    Mesh scaled = solid_;
    const double factor = std::ldexp(1, exponent);
    test::scale(scaled, factor);
    expect_equal_up_to(base_, extract(scaled), factor, Vector3d::Zero(), 0.0);
  }
}

TEST_F(Invariance, ScaledByMillions) {
  for (const double factor : {1e-6, 1e6}) {
    Mesh scaled = solid_;
    test::scale(scaled, factor);
    expect_equal_up_to(base_, extract(scaled), factor, Vector3d::Zero(), 1e-9 * factor);
  }
}

// The indices of the vertices do not matter: the device receives corners, in the order of the faces.
TEST_F(Invariance, VerticesInAnotherOrder) {
  Mesh mixed = solid_;
  std::vector<std::uint32_t> new_index(mixed.vertices.size());
  std::iota(new_index.begin(), new_index.end(), 0u);
  std::shuffle(new_index.begin(), new_index.end(), std::mt19937(7));
  for (std::size_t i = 0; i < new_index.size(); ++i) mixed.vertices[new_index[i]] = solid_.vertices[i];
  for (Triangle& t : mixed.triangles) t = {new_index[t[0]], new_index[t[1]], new_index[t[2]]};
  expect_equal_up_to(base_, extract(mixed), 1, Vector3d::Zero(), 0.0);
}

// The order of the faces decides which of two contacts at exactly the same distance is named first.
TEST_F(Invariance, FacesInAnotherOrder) {
  Mesh mixed = solid_;
  std::shuffle(mixed.triangles.begin(), mixed.triangles.end(), std::mt19937(7));
  for (std::size_t i = 0; i < mixed.triangles.size(); ++i) {
    Triangle& t = mixed.triangles[i];
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(i % 3), t.end());
  }
  expect_clear_points_agree(extract(mixed), kSameVoxel, kSameVoxel);
}

// A quarter turn that carries the grid onto itself: the longest axis, a whole number of voxels, is the one that is
// reversed.
TEST_F(Invariance, QuarterTurnOfTheGrid) {
  int along = 0;
  for (int k = 1; k < 3; ++k) along = base_.grid.size[k] > base_.grid.size[along] ? k : along;
  ASSERT_EQ(base_.grid.size[along], options_.resolution);
  const int other = (along + 1) % 3, last = static_cast<int>(options_.resolution) - 1;
  Mesh turned = solid_;
  for (Point& p : turned.vertices) {
    std::swap(p[along], p[other]);
    p[other] = -p[other];
  }
  const VoxelMap map = [=](test::Voxel v) {
    std::swap(v[along], v[other]);
    v[other] = last - v[other];
    return v;
  };
  const VoxelMap back = [=](test::Voxel v) {
    v[other] = last - v[other];
    std::swap(v[along], v[other]);
    return v;
  };
  expect_clear_points_agree(extract(turned), map, back);
}

// In another grid other points of the same surface are found: each has one within two voxels (one voxel's diagonal,
// sqrt(3), lies between points of neighbouring voxels of a sheet that both grids cross).
TEST_F(Invariance, GenericRotation) {
  const Vector3d axis = Vector3d(-0.6, 0.2, 0.5).normalized();
  const Matrix3d rotation = Eigen::AngleAxisd(1.9, axis).toRotationMatrix();
  Mesh turned = solid_;
  test::rotate(turned, {axis.x(), axis.y(), axis.z()}, 1.9);
  const Extraction other = extract(turned);
  const auto expect_partners = [&](const Extraction& from, const Extraction& to, const Matrix3d& map) {
    const double reach = 2 * std::max(from.grid.voxel_size, to.grid.voxel_size);
    for (const MedialSphere& s : from.spheres) {
      if (!is_clear(from, s, options_)) continue;
      const Vector3d p = map * test::to_eigen(s.centre);
      const bool has_partner = std::any_of(to.spheres.begin(), to.spheres.end(), [&](const MedialSphere& t) {
        return (test::to_eigen(t.centre) - p).norm() <= reach;
      });
      EXPECT_TRUE(has_partner) << p.transpose() << ", radius " << s.radius << ", object angle " << s.object_angle;
    }
  };
  expect_partners(base_, other, rotation);
  expect_partners(other, base_, rotation.transpose());
}

}  // namespace
}  // namespace medial_vk
