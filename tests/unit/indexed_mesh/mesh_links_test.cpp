// The turn of spokes from the normals of the triangles that they end on (docs/theory.md, Lemma L).
#include "indexed_mesh/mesh_links.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/point_ops.h"
#include "medial_vk/bvh.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

struct Normals {
  std::vector<std::uint8_t> flags;
  std::vector<Point> of_triangle;
};

Normals trusted_normals(const Mesh& mesh) {
  Normals normals = {std::vector<std::uint8_t>(mesh.triangles.size(), kTrustedNormal), {}};
  for (const Triangle& t : mesh.triangles) {
    const Point n = cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    normals.of_triangle.push_back((1 / length(n)) * n);
  }
  return normals;
}

double winding_number(const Mesh& mesh, const Point& p) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Point a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p, c = mesh.vertices[t[2]] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (2 * std::numbers::pi);
}

struct Turns {
  int slanted = 0;          // spokes that are no normals
  double closest_call = 0;  // greatest turn of one of them, over the bound of its triangle, both as sines
};

/// Tests the spokes of random points inside.
Turns expect_spokes_within_spreads(const Mesh& mesh) {
  constexpr double kRoundingOfSines = 1e-7;
  Turns turns;
  const Normals normals = trusted_normals(mesh);
  const MeshView view = {mesh.vertices, mesh.triangles, normals.flags, true};
  const Bvh bvh = Bvh::build(view).value();
  const MeshLinks links = make_mesh_links(view, bvh.order());
  std::vector<double> spread_of(mesh.triangles.size());
  for (std::size_t i = 0; i < spread_of.size(); ++i) spread_of[bvh.order()[i]] = double{links.spreads[i]};
  const BvhBox& box = bvh.nodes()[0].box;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 10000; ++i) {
    Point m = box.lower;
    for (int k = 0; k < 3; ++k) m[k] += share(random) * (box.upper[k] - box.lower[k]);
    if (winding_number(mesh, m) < 0.5) continue;
    const BvhHit hit = bvh.closest(m);
    const Point spoke = (1 / std::sqrt(hit.squared_distance)) * (hit.point - m);
    const double sine = length(cross(spoke, normals.of_triangle[hit.triangle])), spread = spread_of[hit.triangle];
    EXPECT_LE(sine, spread + kRoundingOfSines);
    if (sine <= 1e-3) continue;
    ++turns.slanted;
    turns.closest_call = std::max(turns.closest_call, sine / spread);
  }
  return turns;
}

Mesh make_box_with_cavity() {
  Mesh box = test::make_box({4, 4, 4}), cavity = test::make_sphere(1, 120);
  test::translate(cavity, {2, 2, 2});
  test::turn_over(cavity);
  test::append(box, cavity);
  return box;
}

TEST(MeshLinks, NoSpokeTurnsFartherThanItsTriangleAllows) {
  // A coarse torus has reflex edges around its hole, a cavity nothing else.
  for (const Mesh& mesh :
       {test::make_turned_torus(12, 9), test::bent(test::make_turned_torus(16, 11)), make_box_with_cavity()}) {
    const Turns turns = expect_spokes_within_spreads(mesh);
    EXPECT_GT(turns.slanted, 50);
    EXPECT_GT(turns.closest_call, 0.8);  // the bound is nearly attained
    EXPECT_LE(turns.closest_call, 1);
  }
}

TEST(MeshLinks, ConvexSolidsAreTouchedAlongNormalsOnly) {
  for (const Mesh& mesh :
       {test::make_box({1, 0.7, 0.4}), test::make_sphere(1, 300), test::make_ellipsoid({1, 0.6, 0.35}, 30)}) {
    const Normals normals = trusted_normals(mesh);
    const Bvh bvh = Bvh::build({mesh.vertices, mesh.triangles, normals.flags, true}).value();
    const MeshLinks links = make_mesh_links({mesh.vertices, mesh.triangles, normals.flags, true}, bvh.order());
    EXPECT_LT(*std::max_element(links.spreads.begin(), links.spreads.end()), 2e-5f);
    EXPECT_EQ(expect_spokes_within_spreads(mesh).slanted, 0);
  }
}

TEST(MeshLinks, NothingIsSaidBesideTrianglesThatAreNotTrusted) {
  const Mesh mesh = test::make_sphere(1, 300);
  Normals normals = trusted_normals(mesh);
  normals.flags[0] = 0;
  const Bvh bvh = Bvh::build({mesh.vertices, mesh.triangles, normals.flags, true}).value();
  const MeshLinks links = make_mesh_links({mesh.vertices, mesh.triangles, normals.flags, true}, bvh.order());
  const Triangle& distrusted = mesh.triangles[0];
  for (std::size_t i = 0; i < links.spreads.size(); ++i) {
    const Triangle& t = mesh.triangles[bvh.order()[i]];
    const bool beside =
        std::ranges::any_of(t, [&](std::uint32_t v) { return std::ranges::find(distrusted, v) != distrusted.end(); });
    if (beside) {
      EXPECT_EQ(links.spreads[i], 1.0f);
    } else {
      EXPECT_LT(links.spreads[i], 2e-5f);
    }
  }
}

}  // namespace
}  // namespace medial_vk
