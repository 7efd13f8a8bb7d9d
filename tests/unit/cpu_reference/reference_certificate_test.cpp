// The certificate passes for results of the reference and fails, on the right line, for altered ones.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>

#include "cpu_reference/certificate.h"
#include "cpu_reference/extract.h"
#include "cpu_reference/queries.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;
using reference::Certificate;
using reference::Result;
using reference::Sphere;

class ReferenceCertificate : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    Mesh mesh = test::make_l_shape(1, 0.35, 0.6);
    test::rotate(mesh, {0.2, 0.9, -0.4}, 0.5);
    mesh_ = new reference::Mesh(test::to_reference(mesh));
    result_ = new Result(reference::extract(*mesh_, options()));
  }
  static void TearDownTestSuite() {
    delete mesh_;
    delete result_;
  }

  static reference::Options options() {
    reference::Options p;
    p.resolution = 24;
    return p;
  }

  static Certificate check(const Result& result) {
    const reference::Options p = options();
    return reference::check(*mesh_, result, p.epsilon * result.voxel_size, p.object_angle, 0);
  }

  /// Alters one deep ball and expects a failure of the line that begins with `condition`, for that ball.
  template <typename Spoil>
  void expect_caught(const std::string& condition, const Spoil& spoil) {
    Result spoiled = *result_;
    const std::size_t victim = deepest();
    spoil(spoiled.spheres[victim]);
    const Certificate certificate = check(spoiled);
    EXPECT_FALSE(certificate.passed());
    bool seen = false;
    for (const auto& line : certificate.lines) {
      if (line.condition.rfind(condition, 0) != 0) continue;
      seen = true;
      EXPECT_GE(line.failed, 1u) << line.condition;
      EXPECT_LT(line.worst, 0) << line.condition;
      EXPECT_EQ(line.first_failure.rfind("ball " + std::to_string(victim) + " at", 0), 0u) << line.first_failure;
    }
    EXPECT_TRUE(seen) << "no line " << condition;
  }

  static std::size_t deepest() {
    std::size_t best = 0;
    for (std::size_t i = 0; i < result_->spheres.size(); ++i) {
      if (result_->spheres[i].radius > result_->spheres[best].radius) best = i;
    }
    return best;
  }

  static double size() { return reference::Tree(*mesh_).longest_side(); }

  static inline reference::Mesh* mesh_ = nullptr;
  static inline Result* result_ = nullptr;
};

/// A unit vector across v.
Vector3d across(const Vector3d& v) { return v.unitOrthogonal(); }

TEST_F(ReferenceCertificate, PassesInBothModes) {
  ASSERT_GT(result_->spheres.size(), 300u);
  EXPECT_TRUE(check(*result_).passed());
  reference::Options thesis = options();
  thesis.certified = false;
  const Result published = reference::extract(*mesh_, thesis);
  ASSERT_GT(published.spheres.size(), 300u);
  EXPECT_TRUE(check(published).passed());
}

// Files hold spokes, angles and flux in float.
TEST_F(ReferenceCertificate, PassesAfterRoundingToFloat) {
  Result rounded = *result_;
  for (Sphere& s : rounded.spheres) {
    s.spoke_a = s.spoke_a.cast<float>().cast<double>();
    s.spoke_b = s.spoke_b.cast<float>().cast<double>();
    s.object_angle = static_cast<float>(s.object_angle);
  }
  EXPECT_TRUE(check(rounded).passed());
}

TEST_F(ReferenceCertificate, CatchesRadii) {
  const double large = 1e-5 * size();
  expect_caught("radius <=", [&](Sphere& s) { s.radius += large; });
  expect_caught("radius <=", [&](Sphere& s) { s.radius *= 1 + 1e-12; });
  expect_caught("radius >=", [&](Sphere& s) { s.radius -= large; });
  expect_caught("finite", [&](Sphere& s) { s.radius = std::nan(""); });
  expect_caught("finite", [&](Sphere& s) { s.radius = 0; });
}

TEST_F(ReferenceCertificate, CatchesCentres) {
  const double voxel = result_->voxel_size;
  expect_caught("centre inside", [&](Sphere& s) { s.centre += 10 * size() * Vector3d::UnitX(); });
  expect_caught("voxel is in", [&](Sphere& s) { s.centre += 10 * size() * Vector3d::UnitX(); });
  expect_caught("voxel is in", [&](Sphere& s) { s.centre += voxel * Vector3d::UnitX(); });
  // Along its spoke: no longer medial, although the radius is adjusted.
  expect_caught("grown", [&](Sphere& s) {
    s.centre += 0.05 * voxel * s.spoke_a;
    s.radius = reference::Tree(*mesh_).closest(s.centre).distance * (1 - 1e-12);
  });
}

TEST_F(ReferenceCertificate, CatchesSpokes) {
  expect_caught("spoke a", [](Sphere& s) { s.spoke_a = (s.spoke_a + 1e-4 * across(s.spoke_a)).normalized(); });
  expect_caught("spoke a", [](Sphere& s) { std::swap(s.spoke_a, s.spoke_b), s.spoke_a = -s.spoke_a; });
  expect_caught("spoke b", [](Sphere& s) { s.spoke_b = (s.spoke_b + 0.5 * across(s.spoke_b)).normalized(); });
  expect_caught("spokes are unit", [](Sphere& s) { s.spoke_b *= 1 + 1e-6; });
  expect_caught("spokes are unit", [](Sphere& s) { s.spoke_a *= 1 - 1e-6; });
  expect_caught("finite", [](Sphere& s) { s.spoke_b.setConstant(std::nan("")); });
}

TEST_F(ReferenceCertificate, CatchesAngles) {
  expect_caught("object angle is", [](Sphere& s) { s.object_angle -= 1e-5; });
  // Both spokes to the nearest point: a ball on no sheet.
  expect_caught("object angle or", [](Sphere& s) { s.spoke_b = s.spoke_a, s.object_angle = 0; });
  // All angles are below a threshold of 1.6.
  const Certificate strict = reference::check(*mesh_, *result_, 0.01 * result_->voxel_size, 1.6, 0);
  EXPECT_FALSE(strict.passed());
}

TEST_F(ReferenceCertificate, RadiusCanReplaceTheAngle) {
  const double deep = result_->spheres[deepest()].radius;
  Result one = *result_;
  one.spheres = {result_->spheres[deepest()]};
  EXPECT_TRUE(reference::check(*mesh_, one, 0.01 * one.voxel_size, 1.6, 0.99 * deep).passed());
  EXPECT_FALSE(reference::check(*mesh_, one, 0.01 * one.voxel_size, 1.6, 1.01 * deep).passed());
}

TEST_F(ReferenceCertificate, CatchesTwoInAVoxel) {
  Result twice = *result_;
  twice.spheres.push_back(twice.spheres[3]);
  const Certificate certificate = check(twice);
  EXPECT_FALSE(certificate.passed());
  for (const auto& line : certificate.lines) {
    EXPECT_EQ(line.failed, line.condition.rfind("no two balls", 0) == 0 ? 1u : 0u) << line.condition;
  }
}

TEST_F(ReferenceCertificate, EmptyResultPassesWithNothingTested) {
  Result none = *result_;
  none.spheres.clear();
  const Certificate certificate = check(none);
  EXPECT_TRUE(certificate.passed());
  for (const auto& line : certificate.lines) EXPECT_EQ(line.tested, 0u);
}

TEST_F(ReferenceCertificate, ExtractionIsRepeatableOrderedAndInterruptible) {
  const Result again = reference::extract(*mesh_, options());
  ASSERT_EQ(again.spheres.size(), result_->spheres.size());
  for (std::size_t i = 0; i < again.spheres.size(); ++i) {
    EXPECT_EQ(again.spheres[i].centre, result_->spheres[i].centre);
    EXPECT_EQ(again.spheres[i].flux, result_->spheres[i].flux);
    if (i == 0) continue;
    const Eigen::Vector3i &a = again.spheres[i - 1].voxel, &b = again.spheres[i].voxel;
    EXPECT_TRUE(a.z() < b.z() || (a.z() == b.z() && (a.y() < b.y() || (a.y() == b.y() && a.x() < b.x()))));
  }
  EXPECT_EQ(again.found, again.spheres.size());
  EXPECT_EQ(again.levels.size(), 12u);  // four, and eight extra
  double last = 0;
  const Result stopped = reference::extract(*mesh_, options(), [&](double done) {
    EXPECT_GE(done, last);
    last = done;
    return done < 0.5;
  });
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_FALSE(again.interrupted);
  EXPECT_LT(stopped.spheres.size(), again.spheres.size());
}

// The flux of a found voxel comes from its parent's list; the tree must give the same.
TEST_F(ReferenceCertificate, FluxFromListsIsFluxFromTheTree) {
  const reference::Tree tree(*mesh_);
  const auto spiral = reference::spiral_points(50);
  for (const Sphere& s : result_->spheres) {
    const Vector3d centre =
        result_->grid_origin + result_->voxel_size * (s.voxel.cast<double>() + Vector3d::Constant(0.5));
    EXPECT_NEAR(s.flux, reference::outward_flux(tree, centre, result_->voxel_size, spiral).average, 1e-9);
  }
}

}  // namespace
}  // namespace medial_vk
