// The features of a solid that its medial balls can touch, and the spokes with which they do.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "cpu_reference/queries.h"
#include "dismissal/spoke_cones.h"
#include "support/medial_samples.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;
using reference::Cap;
using reference::SpokeCones;

struct Listed {
  int edges = 0, vertices = 0;
};

Listed count(const reference::Mesh& mesh) {
  const SpokeCones cones(mesh, reference::Tree(mesh));
  Listed listed;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      listed.edges += cones.edge(t, k) != nullptr ? 1 : 0;
      listed.vertices += cones.vertex(t, k) != nullptr ? 1 : 0;
    }
  }
  return listed;
}

Listed count(Mesh mesh) {
  test::rotate(mesh, {0.3, -0.5, 0.8}, 0.7);
  return count(test::to_reference(mesh));
}

TEST(ReferenceSpokeCones, ConvexFeaturesAreNeverTouched) {
  for (const Mesh& solid : {test::make_box({1, 0.7, 0.4}), test::make_sphere(1, 300), test::make_capsule(0.4, 1, 24),
                            test::make_ellipsoid({1, 0.6, 0.35}, 30)}) {
    const Listed listed = count(solid);
    EXPECT_EQ(listed.edges, 0);
    EXPECT_EQ(listed.vertices, 0);
  }
}

TEST(ReferenceSpokeCones, AllOfACavityIsTouched) {
  Mesh cavity = test::make_sphere(1, 300);
  const std::size_t vertices = cavity.vertices.size(), edges = cavity.triangles.size() * 3 / 2;
  test::turn_over(cavity);
  const Listed listed = count(cavity);
  EXPECT_EQ(listed.edges, static_cast<int>(edges));
  EXPECT_EQ(listed.vertices, static_cast<int>(vertices));
}

TEST(ReferenceSpokeCones, TheReflexEdgeOfAnL) {
  const reference::Mesh mesh = test::to_reference(test::make_l_shape(1, 0.35, 0.6));
  const SpokeCones cones(mesh, reference::Tree(mesh));
  int listed = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Cap* spokes = cones.edge(t, k);
      if (spokes == nullptr) continue;
      ++listed;
      for (const int corner : {k, (k + 1) % 3}) {
        const Vector3d v = mesh.vertices[mesh.triangles[t][corner]];
        EXPECT_EQ(v.head<2>(), Eigen::Vector2d(0.35, 0.35));
      }
      EXPECT_NEAR(spokes->angle, std::numbers::pi / 4, 1e-6);
      EXPECT_NEAR((spokes->axis - Vector3d(1, 1, 0).normalized()).norm(), 0, 1e-6);
      EXPECT_LT(t, cones.neighbour(t, k));
    }
  }
  EXPECT_EQ(listed, 1);
  EXPECT_EQ(count(test::make_l_shape(1, 0.35, 0.6)).edges, 1);
}

// An open edge or an untrusted triangle: the triangles there are carriers as a whole.
TEST(ReferenceSpokeCones, UntrustedTrianglesHoldTheirFeatures) {
  Mesh cavity = test::make_sphere(1, 300);
  test::turn_over(cavity);
  reference::Mesh mesh = test::to_reference(cavity);
  const Listed all = count(mesh);
  mesh.trusted[17] = 0;
  EXPECT_EQ(count(mesh).edges, all.edges - 3);
  EXPECT_EQ(count(mesh).vertices, all.vertices - 3);
  mesh.trusted[17] = 1;
  mesh.triangles.pop_back();
  mesh.trusted.pop_back();
  const SpokeCones cones(mesh, reference::Tree(mesh));
  EXPECT_EQ(std::count(cones.trusted().begin(), cones.trusted().end(), 0), 3);
  // Three triangles at the hole are dropped with all their edges, and with them the vertices of their neighbours.
  EXPECT_EQ(count(mesh).edges, all.edges - 9);
  mesh.trusted.clear();
  EXPECT_EQ(count(mesh).edges, 0);
  EXPECT_EQ(count(mesh).vertices, 0);
}

/// Arcs of spokes to the edges of a mesh without trusted normals, by the middle of the edge.
std::vector<std::pair<Vector3d, reference::Arc>> arcs_of(const Mesh& solid) {
  reference::Mesh mesh = test::to_reference(solid);
  mesh.trusted.clear();
  const SpokeCones cones(mesh, reference::Tree(mesh));
  std::vector<std::pair<Vector3d, reference::Arc>> arcs;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const reference::Arc* arc = cones.arc(t, k);
      if (arc == nullptr) continue;
      const Vector3d a = mesh.vertices[mesh.triangles[t][k]], b = mesh.vertices[mesh.triangles[t][(k + 1) % 3]];
      arcs.emplace_back((a + b) / 2, *arc);
    }
  }
  return arcs;
}

// A box without its top: convex edges are touched from outside, across a quarter of a circle; those of the rim by all
// directions that point into the wall or across it; diagonals of faces are flat.
TEST(ReferenceSpokeCones, EdgesAreTouchedFromEitherSide) {
  Mesh box = test::make_box({1, 1, 1});
  std::erase_if(box.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(t, [&](std::uint32_t v) { return box.vertices[v][2] == 1; });
  });
  const auto arcs = arcs_of(box);
  EXPECT_EQ(arcs.size(), 12u);
  for (const auto& [middle, arc] : arcs) {
    const bool at_rim = middle.z() == 1;
    const Vector3d inwards = at_rim ? Vector3d(0, 0, -1) : (Vector3d(0.5, 0.5, 0.5) - middle).normalized().eval();
    EXPECT_NEAR((arc.middle - inwards).norm(), 0, 1e-9) << middle.transpose();
    EXPECT_NEAR(arc.angle, at_rim ? std::numbers::pi / 2 : std::numbers::pi / 4, 1e-8) << middle.transpose();
    EXPECT_NEAR(arc.middle.dot(arc.along), 0, 1e-12);
  }
  // Turned over it is the same mesh.
  test::turn_over(box);
  EXPECT_EQ(arcs_of(box).size(), 12u);
}

// Three sheets that meet in an edge, all around it: no ball touches that from any side. Within half a turn one does.
TEST(ReferenceSpokeCones, SheetsAroundAnEdge) {
  for (const double step : {2.0, 0.5}) {
    Mesh fan;
    fan.vertices = {{0, 0, 0}, {0, 0, 1}};
    for (std::uint32_t i = 0; i < 3; ++i) {
      fan.vertices.push_back({std::cos(i * step), std::sin(i * step), 0.5});
      fan.triangles.push_back(i == 1 ? Triangle{1, 0, i + 2} : Triangle{0, 1, i + 2});
    }
    int shared = 0;
    for (const auto& [middle, arc] : arcs_of(fan)) {
      if (middle.head<2>().norm() > 0) continue;
      ++shared;
      EXPECT_NEAR(arc.angle, std::numbers::pi / 2 - step, 1e-8);
      EXPECT_NEAR((arc.middle - Vector3d(std::cos(step), std::sin(step), 0)).norm(), 0, 1e-9);
    }
    EXPECT_EQ(shared, step > 1 ? 0 : 1);
  }
}

TEST(ReferenceSpokeCones, NeedlesAreNotTrusted) {
  Mesh box = test::make_box({1, 1, 1});
  // Splits a triangle by a vertex that is all but on one of its edges.
  const Triangle t = box.triangles[0];
  const Point &a = box.vertices[t[0]], &b = box.vertices[t[1]], &c = box.vertices[t[2]];
  Point p;
  for (int k = 0; k < 3; ++k) p[k] = (a[k] + b[k]) / 2 * (1 - 1e-9) + c[k] * 1e-9;
  const auto v = static_cast<std::uint32_t>(box.vertices.size());
  box.vertices.push_back(p);
  box.triangles[0] = {t[0], t[1], v};
  box.triangles.push_back({t[1], t[2], v});
  box.triangles.push_back({t[2], t[0], v});
  const reference::Mesh mesh = test::to_reference(box);
  const SpokeCones cones(mesh, reference::Tree(mesh));
  EXPECT_EQ(cones.trusted()[0], 0);
  EXPECT_EQ(std::count(cones.trusted().begin(), cones.trusted().end(), 0), 1);
}

// Lemma D itself: the spokes of medial points are among those that their feet allow.
TEST(ReferenceSpokeCones, SpokesOfMedialPointsAreInTheirCaps) {
  Mesh solid = test::make_sphere(1, 80);
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> along(0.5, 1.2), share(0, 1);
  for (Point& v : solid.vertices) {
    const double factor = along(engine);
    for (double& x : v) x *= factor;
  }
  const reference::Mesh mesh = test::to_reference(solid);
  const reference::Tree tree(mesh);
  const SpokeCones cones(mesh, tree);
  std::array<int, 3> seen = {0, 0, 0};  // faces, edges, vertices
  for (int i = 0; i < 8000; ++i) {
    const Vector3d where(share(engine), share(engine), share(engine));
    const auto sample = test::medial_sample(tree, tree.lower() + where.cwiseProduct(tree.upper() - tree.lower()));
    if (!sample) continue;
    const reference::Closest nearest = tree.closest(sample->point);
    const Vector3d spoke = reference::direction_to(sample->point, nearest);
    // Some feature at the foot allows the spoke: the face, or a listed edge or vertex at the foot of any triangle
    // there.
    bool allowed = false;
    for (const int t : tree.gather(nearest.point, 1e-12)) {
      if (2 * reference::half_angle(tree.normal(t), spoke) < 1e-6) allowed = true, ++seen[0];
      for (int k = 0; k < 3 && !allowed; ++k) {
        const Vector3d &a = tree.corner(t, k), &b = tree.corner(t, (k + 1) % 3);
        const auto allows = [&](const Cap* cap) {
          return cap != nullptr && 2 * reference::half_angle(cap->axis, spoke) <= cap->angle + 1e-6;
        };
        const bool on_edge = (nearest.point - a).cross(b - a).norm() < 1e-12;
        if (on_edge && allows(cones.edge(t, k))) allowed = true, ++seen[1];
        if ((nearest.point - a).norm() < 1e-12 && allows(cones.vertex(t, k))) allowed = true, ++seen[2];
      }
      if (allowed) break;
    }
    EXPECT_TRUE(allowed) << "foot " << nearest.point.transpose() << ", spoke " << spoke.transpose();
  }
  for (const int n : seen) EXPECT_GT(n, 30);
}

}  // namespace
}  // namespace medial_vk
