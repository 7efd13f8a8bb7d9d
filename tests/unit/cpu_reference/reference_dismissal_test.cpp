// Dismissed boxes hold no salient medial point: boxes of all shapes in random solids against medial points that are
// found by distances alone.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "dismissal/dismissal.h"
#include "support/medial_samples.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"
#include "unit/cpu_reference/random.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;
using reference::Box;

/// A star-shaped polygon with corners at random distances from the z axis, extruded.
Mesh make_random_prism(Random& random) {
  const auto n = static_cast<std::uint32_t>(5 + random.below(8));
  const double height = random(0.3, 1.2);
  Mesh mesh;
  for (const double z : {0.0, height}) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const double phi = 2 * std::numbers::pi * (i + random(-0.3, 0.3)) / n, r = random(0.35, 1);
      if (z == 0) mesh.vertices.push_back({r * std::cos(phi), r * std::sin(phi), 0});
      if (z > 0) mesh.vertices.push_back({mesh.vertices[i][0], mesh.vertices[i][1], z});
    }
  }
  mesh.vertices.push_back({0, 0, 0});
  mesh.vertices.push_back({0, 0, height});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.triangles.push_back({2 * n, j, i});
    mesh.triangles.push_back({2 * n + 1, n + i, n + j});
    mesh.triangles.push_back({i, j, n + j});
    mesh.triangles.push_back({i, n + j, n + i});
  }
  return mesh;
}

Mesh make_noisy_sphere(Random& random) {
  Mesh mesh = test::make_sphere(1, static_cast<std::uint32_t>(80 + random.below(400)));
  for (Point& v : mesh.vertices) {
    const double factor = random(0.75, 1.15);  // along the radius: star-shaped, so embedded
    for (double& x : v) x *= factor;
  }
  return mesh;
}

std::vector<reference::Mesh> make_solids(Random& random) {
  std::vector<Mesh> solids = {test::make_box({1, 0.7, 0.4}), test::make_l_shape(1, 0.35, 0.6),
                              test::make_cup(0.6, 0.2, 1, 16), test::make_plate_with_hole(1, 0.2, 0.4),
                              test::make_torus(1, 0.4, 12, 20)};
  for (int i = 0; i < 4; ++i) solids.push_back(make_random_prism(random));
  for (int i = 0; i < 3; ++i) solids.push_back(make_noisy_sphere(random));
  std::vector<reference::Mesh> out;
  for (Mesh& solid : solids) {
    test::rotate(solid, {random(-1, 1), random(-1, 1), random(-1, 1)}, random(0, 3));
    out.push_back(test::to_reference(solid));
  }
  return out;
}

std::vector<test::MedialSample> samples_in(const reference::Tree& tree, Random& random, const Vector3d& low,
                                           const Vector3d& high, int starts) {
  std::vector<test::MedialSample> samples;
  for (int i = 0; i < starts; ++i) {
    if (const auto sample = test::medial_sample(tree, random.point(low, high))) samples.push_back(*sample);
  }
  return samples;
}

/// True if rounding does not matter: the point is well inside the box and well above the angle.
bool holds_salient(const Box& box, const std::vector<test::MedialSample>& samples, double angle, double slack) {
  return std::any_of(samples.begin(), samples.end(), [&](const test::MedialSample& s) {
    return s.object_angle > angle + 1e-4 &&
           ((s.point - box.centre).cwiseAbs().array() < box.half.array() - slack).all();
  });
}

struct Tally {
  int dismissed = 0, by_one_cone = 0, kept_without_sample = 0, wrong = 0;
  std::string first_wrong;
};

void try_boxes(const reference::Mesh& mesh, Random& random, int boxes, Tally& tally) {
  const reference::Tree tree(mesh);
  const reference::SpokeCones cones(mesh, tree);
  reference::Mesh careful = mesh;
  careful.trusted = cones.trusted();
  const double size = tree.longest_side();
  const auto pool = samples_in(tree, random, tree.lower(), tree.upper(), 3000);
  for (int i = 0; i < boxes; ++i) {
    Box box;
    const double scale = size * std::exp(random(std::log(0.003), std::log(0.12)));
    box.half = random.point(Vector3d::Constant(0.1), Vector3d::Ones()) * scale;
    // Half of the boxes are close to medial points, where proofs are difficult.
    box.centre = random.point(tree.lower(), tree.upper());
    if (i % 2 == 0)
      box.centre =
          pool[random.below(pool.size())].point + 2 * scale * random.point(-Vector3d::Ones(), Vector3d::Ones());
    if (!reference::is_inside(tree, box.centre)) continue;
    const double angle = random(0.2, 1.2);
    const reference::ContactList list(tree, careful, box.centre, box.reach());
    reference::BoxTest test(tree, cones, box, list);
    const bool dismissed = test.dismisses(angle);
    std::vector<test::MedialSample> near = samples_in(tree, random, box.centre - box.half, box.centre + box.half, 15);
    const bool salient = holds_salient(box, pool, angle, 1e-7 * size) || holds_salient(box, near, angle, 1e-7 * size);
    if (!dismissed && !salient) ++tally.kept_without_sample;
    if (!dismissed) continue;
    ++tally.dismissed;
    tally.by_one_cone += reference::spokes_are_close(tree, test.contacts(), box.reach(), angle) ? 1 : 0;
    if (!salient || tally.wrong++ > 0) continue;
    tally.first_wrong =
        testing::PrintToString(box.centre.transpose()) + " half " + testing::PrintToString(box.half.transpose());
  }
}

TEST(ReferenceDismissal, DismissedBoxesHoldNoSalientPoint) {
  Random random(5);
  Tally all;
  for (const reference::Mesh& mesh : make_solids(random)) try_boxes(mesh, random, 1000, all);
  EXPECT_EQ(all.wrong, 0) << "first at " << all.first_wrong;
  EXPECT_GT(all.dismissed, 3000);
  // Power: most boxes in which no salient point was found are dismissed, many of them by pairs only.
  EXPECT_GT(all.dismissed, 5 * all.kept_without_sample) << all.dismissed << ' ' << all.kept_without_sample;
  EXPECT_GT(all.dismissed - all.by_one_cone, 150);
}

// Without trusted normals sides are unknown; dismissal is still right.
TEST(ReferenceDismissal, UntrustedTrianglesFromEitherSide) {
  Random random(6);
  Tally all;
  for (reference::Mesh& mesh : make_solids(random)) {
    for (std::uint8_t& trusted : mesh.trusted) trusted = random(0, 1) < 0.7 ? 1 : 0;
    try_boxes(mesh, random, 400, all);
  }
  EXPECT_EQ(all.wrong, 0) << "first at " << all.first_wrong;
  EXPECT_GT(all.dismissed, 800);
}

/// Two prisms that cross, as a rule, with a few triangles missing; nothing is trusted.
reference::Mesh make_mess(Random& random) {
  Mesh mesh = make_random_prism(random), other = make_random_prism(random);
  test::rotate(other, {random(-1, 1), random(-1, 1), random(-1, 1)}, random(0, 3));
  test::translate(other, {random(-0.5, 0.5), random(-0.5, 0.5), random(-0.5, 0.5)});
  test::append(mesh, other);
  std::erase_if(mesh.triangles, [&](const Triangle&) { return random(0, 1) < 0.1; });
  reference::Mesh mess = test::to_reference(mesh);
  mess.trusted.clear();
  mess.closed = false;
  return mess;
}

// Lemma I: open edges and crossings.
TEST(ReferenceDismissal, AMessIsDismissedToo) {
  Random random(8);
  Tally all;
  for (int i = 0; i < 12; ++i) try_boxes(make_mess(random), random, 500, all);
  EXPECT_EQ(all.wrong, 0) << "first at " << all.first_wrong;
  EXPECT_GT(all.dismissed, 3 * all.kept_without_sample) << all.dismissed << ' ' << all.kept_without_sample;
  EXPECT_GT(all.dismissed - all.by_one_cone, 100);
}

/// True if some carrier is at the foot, with this spoke among those that it allows.
bool is_carried(const std::vector<reference::Carrier>& carriers, const Vector3d& foot, const Vector3d& spoke,
                double slack) {
  return std::any_of(carriers.begin(), carriers.end(), [&](const reference::Carrier& c) {
    const auto on = reference::closest_point_on_triangle(foot, c.corners[0], c.corners[1], c.corners[2]);
    return on.squared_distance <= slack * slack &&
           2 * reference::half_angle(c.spokes.axis, spoke) <= c.spokes.angle + 1e-6;
  });
}

// Lemmas A, C, D and F for one carrier: the feet of medial points are on carriers of every box around the points.
TEST(ReferenceDismissal, FeetAreOnCarriersThatAllowTheirSpokes) {
  Random random(7);
  int tried = 0, lost = 0;
  for (reference::Mesh& mesh : make_solids(random)) {
    const reference::Tree tree(mesh);
    const double size = tree.longest_side();
    const auto pool = samples_in(tree, random, tree.lower(), tree.upper(), 400);
    for (std::size_t i = 0; i < pool.size(); ++i) {
      if (i % 40 == 0) {
        for (std::uint8_t& trusted : mesh.trusted) trusted = random(0, 1) < 0.8 ? 1 : 0;
      }
      const reference::SpokeCones cones(mesh, tree);
      // The point is in the box, often in a corner of it.
      Box box = {pool[i].point, random.point(Vector3d::Zero(), Vector3d::Ones()) * size * random(0, 0.2)};
      for (int k = 0; k < 3; ++k) box.centre[k] += std::clamp(random(-1.5, 1.5), -1.0, 1.0) * box.half[k];
      const reference::ContactList list(tree, mesh, box.centre, box.reach());
      const auto carriers = reference::carriers_of(tree, cones, box, list.nearest_to_centre(), list.within(box));
      const reference::Closest foot = tree.closest(pool[i].point);
      ++tried;
      const Vector3d spoke = reference::direction_to(pool[i].point, foot);
      if (!is_carried(carriers, foot.point, spoke, 1e-9 * size)) ++lost;
    }
  }
  EXPECT_EQ(lost, 0);
  EXPECT_GT(tried, 1000);
}

// In a box of size 1, edges of 45 degrees: the bisector of two faces at right angles is salient below pi/4 only.
TEST(ReferenceDismissal, KnowsTheAngleOfASheet) {
  const reference::Mesh mesh = test::to_reference(test::make_box({1, 1, 1}));
  const reference::Tree tree(mesh);
  const reference::SpokeCones cones(mesh, tree);
  const Box box = {{0.2, 0.2, 0.5}, Vector3d::Constant(0.02)};
  const reference::ContactList list(tree, mesh, box.centre, box.reach());
  reference::BoxTest test(tree, cones, box, list);
  EXPECT_FALSE(test.dismisses(std::numbers::pi / 4 - 1e-5));
  EXPECT_EQ(test.pairs().size(), 1u);
  EXPECT_TRUE(test.dismisses(std::numbers::pi / 4 + 1e-5));
  // Feet at distance x from the edge, x at most 0.22: sqrt(2) x apart; the bound by angles has D_0 + reach in place of
  // x.
  const double width = test.width(0.6);
  EXPECT_GE(width, std::sqrt(2.0) * 0.22);
  EXPECT_LE(width, std::sqrt(2.0) * (0.2 + box.reach()) * (1 + 1e-6));
}

}  // namespace
}  // namespace medial_vk
