// Solid angles against closed forms, the tree against the plain sum.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/point_ops.h"
#include "mesh/winding_number.h"
#include "support/solids.h"

namespace medial_vk {
namespace {

using namespace test;

TEST(WindingNumber, TriangleOfAnOctant) {
  const double big = 1e8;  // the octant's far face, seen from the origin: 1/8 of the sphere
  EXPECT_NEAR(triangle_winding({{{big, 0, 0}, {0, big, 0}, {0, 0, big}}}, {0, 0, 0}), 0.125, 1e-15);
  EXPECT_NEAR(triangle_winding({{{big, 0, 0}, {0, 0, big}, {0, big, 0}}}, {0, 0, 0}), -0.125, 1e-15);
}

TEST(WindingNumber, InsideAndOutside) {
  Mesh mesh = make_torus(2, 0.5, 24, 60);
  EXPECT_NEAR(exact_winding_number(mesh, {2, 0.01, 0.02}), 1, 1e-12);
  EXPECT_NEAR(exact_winding_number(mesh, {0, 0.01, 0.02}), 0, 1e-12);
  EXPECT_NEAR(exact_winding_number(mesh, {5, 5, 5}), 0, 1e-12);
  turn_over(mesh);
  EXPECT_NEAR(exact_winding_number(mesh, {2, 0.01, 0.02}), -1, 1e-12);
}

TEST(WindingNumber, HalfASphereSeenFromItsCentre) {
  Mesh mesh = make_sphere(1, 2000);
  std::erase_if(mesh.triangles, [&](const Triangle& t) {
    return mesh.vertices[t[0]][2] + mesh.vertices[t[1]][2] + mesh.vertices[t[2]][2] < 0;
  });
  EXPECT_NEAR(exact_winding_number(mesh, {0, 0, 0}), 0.5, 0.02);
}

TEST(WindingNumber, TreeAgreesWithSum) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (const double unit : {1.0, 1e-6, 1e6}) {
    for (Mesh mesh : {make_torus(0.7, 0.2, 40, 120), make_sphere(0.9, 5000), make_cup(0.8, 0.05, 1, 90)}) {
      mesh.triangles.resize(mesh.triangles.size() * 3 / 4);  // open
      scale(mesh, unit);
      const TriangleTree tree(mesh);
      const WindingTree winding(tree);
      double worst = 0, sum = 0;
      const int samples = 500;
      for (int i = 0; i < samples; ++i) {
        const Point p = {unit * uniform(random), unit * uniform(random), unit * uniform(random)};
        const double error = std::abs(winding.at(p) - exact_winding_number(mesh, p));
        worst = std::max(worst, error);
        sum += error;
      }
      EXPECT_LT(worst, 0.03);
      EXPECT_LT(sum / samples, 0.008);
    }
  }
}

TEST(WindingNumber, BesideASurfaceIsHalfway) {
  Mesh mesh = make_box({1, 2, 3});
  append(mesh, make_sphere(0.3, 200));
  translate(mesh, {1e3, 0, 0});
  const TriangleTree tree(mesh);
  const WindingTree winding(tree);
  for (std::uint32_t place = 0; place < tree.order.size(); ++place) {
    if (tree.order[place] < 12) continue;  // the sphere: around the box's corner, 1/8 of it inside
    const Point c = tree.corners[place][0];
    const bool inside_box = c[0] > 1e3 + 0.05 && c[1] > 0.05 && c[2] > 0.05;
    const bool outside_box = c[0] < 1e3 - 0.05 || c[1] < -0.05 || c[2] < -0.05;
    if (inside_box) {
      EXPECT_NEAR(winding.beside(place), 1.5, 0.03);
    }
    if (outside_box) {
      EXPECT_NEAR(winding.beside(place), 0.5, 0.03);
    }
  }
}

}  // namespace
}  // namespace medial_vk
