// Solid angles against closed forms, the tree against the plain sum.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "base/point_ops.h"
#include "mesh/winding/winding_number.h"
#include "mesh/winding/winding_step.h"
#include "support/solids/solids.h"

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
  for (std::uint32_t position = 0; position < tree.order.size(); ++position) {
    if (tree.order[position] < 12) continue;  // the sphere: around the box's corner, 1/8 of it inside
    const Point c = tree.corners[position][0];
    const bool inside_box = c[0] > 1e3 + 0.05 && c[1] > 0.05 && c[2] > 0.05;
    const bool outside_box = c[0] < 1e3 - 0.05 || c[1] < -0.05 || c[2] < -0.05;
    if (inside_box) {
      EXPECT_NEAR(winding.beside(position), 1.5, 0.03);
    }
    if (outside_box) {
      EXPECT_NEAR(winding.beside(position), 0.5, 0.03);
    }
  }
}

// ---- Steps from one triangle to another

Mesh stack_of_plates(int plates) {
  Mesh mesh;
  for (int i = 0; i < plates; ++i) {
    Mesh plate = make_box({1, 1, 1.0 / (3 * plates)});
    translate(plate, {0, 0, static_cast<double>(i) / plates});
    append(mesh, plate);
  }
  return mesh;
}

Mesh shells(int count) {
  Mesh mesh;
  for (int i = 1; i <= count; ++i) {
    Mesh shell = make_sphere(i, 80 + 10 * static_cast<std::uint32_t>(i));
    rotate(shell, {0.3, 0.4, 0.5}, i);
    if (i % 3 == 0) turn_over(shell);
    append(mesh, shell);
  }
  return mesh;
}

// Boxes whose sides lie in the same planes: no straight path between two that leaves either.
Mesh rows_of_boxes(int side) {
  Mesh mesh;
  for (int i = 0; i < side * side; ++i) {
    Mesh box = make_box({1, 1, 1});
    translate(box, {1.5 * (i % side), 1.5 * (i / side), 0});
    append(mesh, box);
  }
  return mesh;
}

TEST(WindingStep, IsTheDifferenceOfTwoValues) {
  Mesh far_away = shells(5);
  translate(far_away, {1e6, -1e6, 1e6});
  for (Mesh mesh : {stack_of_plates(5), shells(9), rows_of_boxes(3), make_torus(2, 0.5, 12, 30), far_away}) {
    const TriangleTree tree(mesh);
    const auto count = static_cast<std::uint32_t>(tree.order.size());
    const auto beside = [&](std::uint32_t position) {  // sums all terms
      const Point centroid =
          (1.0 / 3) * (tree.corners[position][0] + tree.corners[position][1] + tree.corners[position][2]);
      double sum = 0;
      for (std::uint32_t other = 0; other < count; ++other) {
        if (other != position) sum += triangle_winding(tree.corners[other], centroid);
      }
      return sum;
    };
    std::mt19937 random(1);
    std::uniform_int_distribution<std::uint32_t> any(0, count - 1);
    for (int i = 0; i < 200; ++i) {
      const std::uint32_t from = any(random), to = any(random);
      if (from == to) continue;
      std::uint64_t cost = 0;
      const std::optional<int> step = winding_step(tree, from, to, cost);
      ASSERT_TRUE(step) << from << " " << to;
      ASSERT_NEAR(*step, beside(to) - beside(from), 1e-3) << from << " " << to;
    }
  }
}

// If a face lies within rounding of another, every path is doubtful, and no result is given.
TEST(WindingStep, SaysNothingInDoubt) {
  Mesh mesh = make_box({1, 1, 1});
  Mesh same = mesh;
  translate(same, {0, 0, 1e-17});
  append(mesh, same);
  const TriangleTree tree(mesh);
  std::uint64_t cost = 0, decided = 0;
  for (std::uint32_t to = 1; to < 24; ++to) decided += winding_step(tree, 0, to, cost).has_value();
  EXPECT_EQ(decided, 0u);
}

// Formerly quadratic in their number: a value from the tree examines every plate.
TEST(WindingStep, CostsTheSameInALargerStack) {
  const auto cost_of_one = [](int plates) {
    const Mesh mesh = stack_of_plates(plates);
    const TriangleTree tree(mesh);
    std::uint64_t cost = 0;
    std::uint32_t last = 0;
    for (std::uint32_t position = 0; position < tree.order.size(); ++position) {
      if (tree.order[position] % 12 != 0) continue;
      if (last != position) {
        EXPECT_TRUE(winding_step(tree, last, position, cost));
      }
      last = position;
    }
    return static_cast<double>(cost) / plates;
  };
  // The tree is deeper by log2(16) = 4 levels; a tenfold of that for boxes that touch the path.
  EXPECT_LT(cost_of_one(1600), cost_of_one(100) + 40);
}

}  // namespace
}  // namespace medial_vk
