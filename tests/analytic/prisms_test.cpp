// Box and L-shape: their medial surfaces are known exactly, reflex edges included. Each is turned into a generic
// position; medial points are compared voxel by voxel.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "support/device/device.h"
#include "support/device/device_test.h"
#include "support/extraction.h"
#include "support/solids/extruded_polygon.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::ExtrudedPolygon;

constexpr double kObjectAngle = 0.6;  // below pi/4, the object angle of the bisectors of right angles
// A medial surface that crosses a voxel by less than this share of its side need not be found: the target of a line
// shrinks with it, and the certified mode does not guarantee it.
constexpr double kCrossing = 0.05;
// The same holds for thinner objects: sheets whose object angle barely passes.
constexpr double kClearAngle = kObjectAngle + 0.05;

struct Prism {
  std::string name;
  ExtrudedPolygon exact;
  Mesh mesh;
};

Prism box() {
  return {"box", ExtrudedPolygon({{0, 0}, {1, 0}, {1, 0.7}, {0, 0.7}}, 0.5), test::make_box({1, 0.7, 0.5})};
}

Prism l_shape() {
  return {"l_shape", ExtrudedPolygon({{0, 0}, {1, 0}, {1, 0.35}, {0.35, 0.35}, {0.35, 1}, {0, 1}}, 0.4),
          test::make_l_shape(1, 0.35, 0.4)};
}

class ExactPrism : public testing::TestWithParam<Prism (*)()> {};

void expect_close_to_medial_surface(const Prism& prism, const Matrix3d& to_body, const Extraction& extraction,
                                    double epsilon) {
  for (const MedialSphere& s : extraction.spheres) {
    const Vector3d p = to_body * test::to_eigen(s.centre);
    ASSERT_TRUE(prism.exact.contains(p));
    // Lemma 2.3: growing by epsilon away from the contact meets the boundary elsewhere, so a medial point lies within
    // epsilon. 1e-12: the mesh's corners were turned in double.
    const ExtrudedPolygon::MedialPoint medial = prism.exact.medial_point_behind(p);
    EXPECT_LE(medial.travelled, epsilon + 1e-12) << p.transpose();
  }
}

void expect_every_crossed_voxel_found(const Prism& prism, const Matrix3d& to_world, const Extraction& extraction,
                                      double epsilon) {
  const VoxelGrid& grid = extraction.grid;
  const test::SphereByVoxel found = test::spheres_by_voxel(extraction);
  std::map<test::Voxel, ExtrudedPolygon::MedialPoint> crossed;
  // Samples closer together than the required crossing.
  for (const Vector3d& start : prism.exact.boundary_samples(kCrossing * grid.voxel_size)) {
    const ExtrudedPolygon::MedialPoint medial = prism.exact.medial_point_behind(start);
    // The proof that an aimed line ends in a medial point requires D >= 4 epsilon (docs/theory.md, "How far to
    // narrow").
    if (medial.object_angle < kClearAngle || medial.radius < 4 * epsilon) continue;
    const Vector3d world = to_world * medial.centre;
    if (test::depth_in_voxel(grid, world) >= kCrossing) crossed.emplace(test::voxel_of(grid, world), medial);
  }
  ASSERT_GT(crossed.size(), 500u);
  std::size_t missed = 0;
  for (const auto& [voxel, medial] : crossed) {
    if (found.contains(voxel)) continue;
    ++missed;
    EXPECT_LE(missed, 0u) << "voxel " << voxel[0] << " " << voxel[1] << " " << voxel[2] << " has no point, though "
                          << medial.centre.transpose() << " is medial there, radius " << medial.radius << ", angle "
                          << medial.object_angle;
  }
}

TEST_P(ExactPrism, EveryCrossedVoxelHasAPointOnTheMedialSurface) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Prism prism = GetParam()();
  const Vector3d axis(0.3, 0.5, 0.8);
  const double angle = 0.7;
  test::rotate(prism.mesh, {axis.x(), axis.y(), axis.z()}, angle);
  const Matrix3d to_world = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();

  Context& context = test::quick_device();
  ExtractionOptions options;
  options.resolution = 32;
  options.object_angle = kObjectAngle;
  const PreparedMesh mesh = test::prepare(prism.mesh);
  const CertifiedExtraction result = test::extract_on_device(context, mesh, options);
  SCOPED_TRACE(test::describe(result));
  const double epsilon = options.epsilon * result.extraction.grid.voxel_size;
  EXPECT_EQ(result.certificate.rejected, 0u);
  expect_close_to_medial_surface(prism, to_world.transpose(), result.extraction, epsilon);
  expect_every_crossed_voxel_found(prism, to_world, result.extraction, epsilon);
}

INSTANTIATE_TEST_SUITE_P(Prisms, ExactPrism, testing::Values(&box, &l_shape),
                         [](const auto& prism) { return prism.param().name; });

// On a box every sheet bisects two faces: neighbours, at pi/4, or opposite ones, at pi/2.
TEST(ExactBox, ObjectAnglesAreThoseOfItsFaces) {
  MEDIAL_VK_SKIP_WITHOUT_DEVICE();
  Mesh solid = test::make_box({1, 0.7, 0.5});
  test::rotate(solid, {0.2, 0.9, 0.4}, 1.1);
  Context& context = test::quick_device();
  ExtractionOptions options;
  options.resolution = 24;
  const PreparedMesh mesh = test::prepare(solid);
  const CertifiedExtraction result = test::extract_on_device(context, mesh, options);
  std::size_t neighbours = 0, opposite = 0;
  for (const MedialSphere& s : result.extraction.spheres) {
    const auto angle = static_cast<double>(s.object_angle);
    // Spoke b comes from the device, with an error of 2 * slack / D (docs/theory.md, "Rounding"; slack is 2e-6 of the
    // longest side), half of it in the object angle; 1e-6 for numbers written as floats.
    const double tolerance = 2e-6 * mesh.report.longest_side() / s.radius + 1e-6;
    const bool is_neighbours = std::abs(angle - std::numbers::pi / 4) <= tolerance;
    const bool is_opposite = std::abs(angle - std::numbers::pi / 2) <= tolerance;
    EXPECT_TRUE(is_neighbours || is_opposite) << "object angle " << angle << ", radius " << s.radius;
    neighbours += is_neighbours;
    opposite += is_opposite;
  }
  EXPECT_GT(neighbours, 100u);
  EXPECT_GT(opposite, 10u);
}

}  // namespace
}  // namespace medial_vk
