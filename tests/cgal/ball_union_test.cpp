// Unions of balls against CGAL's regular triangulation and inclusion-exclusion: another diagram, other predicates,
// other formulas, other precision. Only with MEDIAL_VK_TEST_CGAL.
#include "medial_vk/ball_union.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "cgal/complex_volume.h"
#include "cgal/regular_triangulation.h"
#include "cpu_reference/ball_union.h"
#include "input/read_mesh.h"
#include "support/extraction.h"
#include "support/solids/ball_families.h"
#include "support/solids/solids.h"
#include "support/source_folder.h"

namespace medial_vk {
namespace {

constexpr double kAgrees = 1e-12;  // relative; the project guarantees 1e-9

BallUnion measure(const std::vector<Ball>& balls) {
  auto result = measure_ball_union(balls, {.threads = 2, .complex = true});
  EXPECT_TRUE(result.ok()) << result.error().message;
  return std::move(result).value();
}

std::int64_t euler(const DualComplex& c) {
  return static_cast<std::int64_t>(c.vertices.size() + c.triangles.size()) -
         static_cast<std::int64_t>(c.edges.size() + c.tetrahedra.size());
}

void expect_measures(const BallUnion& found, const test::Measures& expected) {
  EXPECT_NEAR(found.volume, expected.volume, kAgrees * expected.volume);
  EXPECT_NEAR(found.area, expected.area, kAgrees * expected.area);
}

void expect_same_measures(const std::vector<Ball>& balls, const BallUnion& found, const DualComplex& complex) {
  expect_measures(found, test::measure_by_complex(balls, complex, true));
}

/// The project's complex must itself be a complex of the union: the same measures follow from it.
void expect_consistent(const std::vector<Ball>& balls, const BallUnion& found) {
  expect_measures(found, test::measure_by_complex(balls, found.complex));
}

/// Compares the topology only, since ties may be broken differently. `touching`: spheres touch on the envelope, within
/// the tolerance of touching; simplices of such spheres are in the project's complex, which changes no topology, but
/// inclusion and exclusion knows no tolerance.
void expect_same_union(const std::vector<Ball>& balls, bool touching = false) {
  const BallUnion found = measure(balls);
  const DualComplex complex = test::dual_complex_by_cgal(balls);
  expect_same_measures(balls, found, complex);
  if (!touching) expect_consistent(balls, found);
  EXPECT_EQ(betti_numbers(found.complex).value(), betti_numbers(complex).value());
  EXPECT_EQ(euler(found.complex), euler(complex));
}

/// Compares simplex by simplex, for balls without ties.
void expect_same_complex(const std::vector<Ball>& balls) {
  const BallUnion found = measure(balls);
  const DualComplex complex = test::dual_complex_by_cgal(balls);
  expect_same_measures(balls, found, complex);
  EXPECT_EQ(found.complex.vertices, complex.vertices);
  EXPECT_EQ(found.complex.edges, complex.edges);
  EXPECT_EQ(found.complex.triangles, complex.triangles);
  EXPECT_EQ(found.complex.tetrahedra, complex.tetrahedra);
  EXPECT_EQ(betti_numbers(found.complex).value(), betti_numbers(complex).value());
}

/// Compares the oracle itself with slices.
TEST(UnionByCgal, OfADozenAgainstSlices) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const auto balls = test::random_balls(12, seed, 0.2, 0.6);
    std::vector<reference::UnionBall> spheres;
    for (const auto& [c, r] : balls) spheres.push_back({{c[0], c[1], c[2]}, r});
    const double expected = reference::union_volume_by_slices(spheres);
    const double found = test::measure_by_complex(balls, test::dual_complex_by_cgal(balls)).volume;
    EXPECT_NEAR(found, expected, kAgrees * expected);
  }
}

TEST(UnionByCgal, OfRandomBalls) {
  for (unsigned seed = 0; seed < 40; ++seed) expect_same_complex(test::random_balls(4 + seed / 10, seed, 0.3, 0.8));
  for (unsigned seed = 0; seed < 20; ++seed) expect_same_complex(test::random_balls(30, seed, 0.1, 0.5));
  for (unsigned seed = 0; seed < 5; ++seed) expect_same_complex(test::random_balls(300, seed, 0, 0.2));
  expect_same_complex(test::random_balls(5000, 1, 0.01, 0.06));
  expect_same_complex(test::random_balls(5000, 2, 0, 0.3));
}

TEST(UnionByCgal, OfBallsOfAllSizes) {
  for (unsigned seed = 0; seed < 4; ++seed) expect_same_complex(test::of_all_sizes(2000, seed));
}

TEST(UnionByCgal, OfLattices) {
  // Squares of these radii are exact: CGAL receives them squared. None touch by their radius alone.
  for (const double radius : {0.625, 0.75, 0.8125, 0.875, 1.25, 1.75}) expect_same_union(test::lattice(6, radius));
  for (const double radius : {0.625, 0.75, 2.5, 6.0}) expect_same_union(test::flat_lattice(20, radius));
}

TEST(UnionByCgal, OfLatticesWithNoise) {
  for (const double radius : {0.625, 0.8125, 1.0, 1.3}) {
    for (unsigned seed = 1; seed < 4; ++seed) {
      for (const double noise : {1e-9, 1e-5}) expect_same_complex(test::lattice(5, radius, noise, seed));
      expect_same_union(test::lattice(5, radius, 1e-13, seed));  // rounding of squared radii still decides some
    }
  }
}

/// Noise of one rounding: CGAL's radii, squared and rounded, differ from the project's, and so do the diagrams
/// everywhere.
TEST(UnionByCgal, OfLatticesWithRoundingNoise) {
  for (const double radius : {0.625, 0.8, 1.0, 1.3}) {
    for (const double noise : {1e-18, 1e-17, 1e-16, 1e-15}) expect_same_union(test::lattice(5, radius, noise));
  }
}

/// Few balls on a plane, a line, a sphere or through a point, up to noise.
TEST(UnionByCgal, OfNearlyDegenerateBalls) {
  std::mt19937_64 engine(7);
  for (unsigned n = 0; n < 200; ++n) {
    const double noise = std::pow(10, -8 - static_cast<double>(engine() % 11));
    for (auto balls : {test::flat_lattice(4, 1.3), test::collinear(20, n), test::cospherical(20 + n % 20, 1.1),
                       test::through_a_point(20, n, true), test::on_a_plane(20, n)}) {
      std::uniform_real_distribution<double> by(-noise, noise);
      for (auto& [c, r] : balls) c = {c[0] + by(engine), c[1] + by(engine), c[2] + by(engine)};
      const BallUnion found = measure(balls);
      expect_same_measures(balls, found, test::dual_complex_by_cgal(balls));
      expect_consistent(balls, found);
    }
  }
}

TEST(UnionByCgal, OfSpheresThroughAPoint) {
  for (unsigned seed = 1; seed < 4; ++seed) {
    expect_same_union(test::through_a_point(200, seed, false));
    expect_same_union(test::through_a_point(200, seed, true));
  }
}

TEST(UnionByCgal, OfCollinearCentres) { expect_same_union(test::collinear(3000, 1)); }

TEST(UnionByCgal, OfConcentricBalls) { expect_same_union(test::concentric(10000, 1)); }

TEST(UnionByCgal, OfBallsOnAPlane) { expect_same_complex(test::on_a_plane(3000, 1)); }

TEST(UnionByCgal, OfCosphericalCentres) {
  for (const double radius : {0.1, 0.5, 1.0, 2.0}) expect_same_union(test::cospherical(300, radius));
}

std::vector<Ball> medial_balls(Mesh mesh, double resolution) {
  ExtractionOptions options;
  options.resolution = static_cast<decltype(options.resolution)>(resolution);
  const reference::Result result = test::extract_with_reference(test::prepare(std::move(mesh)), options);
  std::vector<Ball> balls;
  for (const auto& sphere : result.spheres) {
    balls.push_back({{sphere.centre.x(), sphere.centre.y(), sphere.centre.z()}, sphere.radius});
  }
  return balls;
}

TEST(UnionByCgal, OfMedialBalls) {
  expect_same_union(medial_balls(test::make_turned_torus(), 40), true);
  expect_same_union(medial_balls(test::make_box({1, 0.7, 0.45}), 40), true);
}

TEST(UnionByCgal, OfMedialBallsOfModels) {
  const std::filesystem::path folder = test::source_folder() / ".." / "shared" / "models";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "there is no folder of models beside the source tree";
  for (const auto& [name, resolution] : {std::pair{"spot", 100.0}, {"homer", 60.0}, {"rocker-arm", 60.0}}) {
    Result<Mesh> mesh = read_mesh((folder / (std::string(name) + ".obj")).string());
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    expect_same_union(medial_balls(std::move(mesh).value(), resolution), true);
  }
}

}  // namespace
}  // namespace medial_vk
