// Thickness at points of the boundary: solids with known thickness, and the reference's distances along many rays.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stop_token>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/queries.h"
#include "medial_vk/prepare.h"
#include "medial_vk/thickness.h"
#include "support/eigen_points.h"
#include "support/indexed.h"
#include "support/reference_mesh.h"
#include "support/solids/smooth_solids.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

constexpr double kDelta = 0.004;

/// Of an interval that holds this thickness, or has this upper end, up to a hundredth.
double widest(double thickness) { return 1.01 * std::max(ThicknessOptions().width * thickness, 0.25 * kDelta); }

ThicknessOptions options_with(ThicknessSide side = ThicknessSide::kWalls) {
  ThicknessOptions options;
  options.delta = kDelta;
  options.side = side;
  options.queries = 4000;  // walls of some ten deltas take more distances than there are by default
  options.patience = options.queries;
  return options;
}

IndexedMesh solid_of(const Mesh& mesh) { return indexed(prepare_mesh(mesh).value()); }

std::vector<Thickness> thickness_at(const IndexedMesh& mesh, const std::vector<Point>& points,
                                    const ThicknessOptions& options = options_with()) {
  return measure_thickness(mesh, points, options).value();
}

void expect_holds(const Thickness& found, double thickness) {
  EXPECT_LE(found.diameter.lower, thickness * (1 + 1e-12));
  EXPECT_GE(found.diameter.upper, thickness * (1 - 1e-12));
  EXPECT_LE(found.diameter.upper - found.diameter.lower, widest(thickness));
}

// A ball of radius r in the corner of two or three perpendicular planes is sqrt(2) r or sqrt(3) r from it.
TEST(Thickness, OfABox) {
  const IndexedMesh box = solid_of(make_box({2, 1, 0.4}));
  const Point upper = box.prepared().report.upper, lower = box.prepared().report.lower, middle = 0.5 * (lower + upper);
  const std::vector<Thickness> found = thickness_at(box, {{middle[0], middle[1], upper[2]},
                                                          {middle[0] + 0.3, middle[1] - 0.2, lower[2]},
                                                          {upper[0], middle[1], upper[2]},
                                                          upper});
  expect_holds(found[0], 0.4);
  expect_holds(found[1], 0.4);
  expect_holds(found[2], 2 * kDelta / (std::numbers::sqrt2 - 1));
  expect_holds(found[3], 2 * kDelta / (std::numbers::sqrt3 - 1));
}

// The end of a wall between two boxes is a gap; beyond the outer faces there is no other boundary.
TEST(Thickness, OfAGap) {
  Mesh both = make_box({1, 1, 1});
  append(both, moved(make_box({1, 1, 1}), {1.1, 0, 0}));
  const IndexedMesh mesh = solid_of(both);
  const Point lower = mesh.prepared().report.lower;
  const ThicknessOptions options = options_with(ThicknessSide::kGaps);
  const std::vector<Thickness> found = thickness_at(
      mesh, {lower + Point{1, 0.5, 0.5}, lower + Point{1.1, 0.4, 0.6}, lower + Point{0, 0.5, 0.5}}, options);
  expect_holds(found[0], 0.1);
  expect_holds(found[1], 0.1);
  EXPECT_EQ(found[2].diameter.lower, mesh.longest_side());
  EXPECT_EQ(found[2].diameter.upper, mesh.longest_side());
}

struct Case {
  const char* name;
  Mesh mesh;
  ThicknessSide side = ThicknessSide::kWalls;
};

std::vector<Case> cases() {
  Mesh irregular = smooth_ellipsoid(1, 0.7, 0.4)->mesh(900);
  make_irregular(*smooth_ellipsoid(1, 0.7, 0.4), irregular, 5);
  return {{"ellipsoid", irregular},
          {"torus", make_turned_torus(30, 20)},
          {"cup", make_cup(0.5, 0.05, 1, 24)},
          {"shell", make_shell(320, 80)},
          {"L", make_l_shape(1, 0.3, 0.2)},
          {"plate with a hole", make_plate_with_hole(1, 0.1, 0.3)},
          {"bent torus", bent(make_turned_torus(24, 16))},
          {"two parts outside", make_two_parts(160), ThicknessSide::kGaps},
          {"L outside", make_l_shape(1, 0.3, 0.2), ThicknessSide::kGaps}};
}

/// The vertices, and points evenly spread over triangles.
std::vector<Point> points_of(const Mesh& mesh, std::mt19937_64& random) {
  std::vector<Point> points(mesh.vertices.begin(),
                            mesh.vertices.begin() + std::min<std::ptrdiff_t>(60, std::ssize(mesh.vertices)));
  std::uniform_real_distribution<> share(0, 1);
  std::uniform_int_distribution<std::size_t> triangle(0, mesh.triangles.size() - 1);
  for (int i = 0; i < 40; ++i) {
    const Triangle& t = mesh.triangles[triangle(random)];
    const double a = std::sqrt(share(random)), b = share(random);
    points.push_back((1 - a) * mesh.vertices[t[0]] + (a * (1 - b)) * mesh.vertices[t[1]] +
                     (a * b) * mesh.vertices[t[2]]);
  }
  return points;
}

/// The radius of the largest ball that comes within delta of p, of those with centres on a ray, by the reference: they
/// are the centres up to some distance from p (docs/theory.md, "Thickness"), which bisection finds.
double radius_along(const reference::Tree& tree, const Point& p, const Point& direction, double limit) {
  const auto radius_at = [&](double s) { return tree.closest(to_eigen(p + s * direction)).distance; };
  double near = 0, far = 0.5 * limit + kDelta;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (near + far);
    (middle <= radius_at(middle) + kDelta ? near : far) = middle;
  }
  double greatest = 0;
  for (int i = 1; i <= 50; ++i) greatest = std::max(greatest, radius_at(near * i / 50));
  return std::min(greatest, 0.5 * limit);
}

class ThicknessOf : public testing::TestWithParam<Case> {};

// The ball of the lower bound is where it should be, and no ray of many, those near its centre among them, has a ball
// larger than the upper bound.
TEST_P(ThicknessOf, HoldsWhatTheReferenceFinds) {
  const PreparedMesh prepared = prepare_mesh(GetParam().mesh).value();
  const IndexedMesh mesh = indexed(prepared);
  const reference::Tree tree(to_reference(prepared));
  std::mt19937_64 random(11);
  std::normal_distribution<> normal;
  const std::vector<Point> points = points_of(prepared.mesh, random);
  const ThicknessOptions options = options_with(GetParam().side);
  const bool walls = GetParam().side == ThicknessSide::kWalls;
  const std::vector<Thickness> found = thickness_at(mesh, points, options);
  for (std::size_t i = 0; i < points.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "point " << i << " at " << testing::PrintToString(points[i]));
    const Bounds& diameter = found[i].diameter;
    const Ball& ball = found[i].ball;
    EXPECT_LE(diameter.upper - diameter.lower, widest(diameter.upper));
    EXPECT_EQ(diameter.lower, 2 * ball.radius);
    ASSERT_GT(ball.radius, 0);
    EXPECT_LE(ball.radius, tree.closest(to_eigen(ball.centre)).distance);
    EXPECT_LE(length(ball.centre - points[i]), ball.radius + kDelta);
    EXPECT_EQ(winding_number(tree, to_eigen(ball.centre), 0.01) > 0.5, walls);
    const Point best = (1 / length(ball.centre - points[i])) * (ball.centre - points[i]);
    for (int k = 0; k < 60; ++k) {
      const double spread = k < 20 ? 0.02 : k < 40 ? 0.2 : 5;
      Point direction = best + spread * Point{normal(random), normal(random), normal(random)};
      direction = (1 / length(direction)) * direction;
      const double radius = radius_along(tree, points[i], direction, mesh.longest_side());
      if (2 * radius <= diameter.upper) continue;
      // A larger ball is on the other side.
      const Point beside = points[i] + (kDelta + radius) * direction;
      EXPECT_EQ(winding_number(tree, to_eigen(beside), 0.01) > 0.5, !walls) << 2 * radius << " > " << diameter.upper;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Solids, ThicknessOf, testing::ValuesIn(cases()), [](const auto& example) {
  std::string name = example.param.name;
  std::erase(name, ' ');
  return name;
});

/// Each triangle as four.
Mesh quartered(const Mesh& mesh) {
  Mesh out;
  const auto add = [&](const Point& p) {
    out.vertices.push_back(p);
    return static_cast<std::uint32_t>(out.vertices.size() - 1);
  };
  for (const auto& [i, j, k] : mesh.triangles) {
    const Point &p = mesh.vertices[i], &q = mesh.vertices[j], &r = mesh.vertices[k];
    const std::uint32_t a = add(p), b = add(q), c = add(r);
    const std::uint32_t d = add(0.5 * (p + q)), e = add(0.5 * (q + r)), f = add(0.5 * (r + p));
    for (const Triangle& part : {Triangle{a, d, f}, {d, b, e}, {f, e, c}, {d, e, f}}) out.triangles.push_back(part);
  }
  return out;
}

/// Triangles as three, around points that are often near an edge, again and again.
Mesh split_at_random(Mesh mesh, std::size_t triangles, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<> uniform(0.02, 1);
  while (mesh.triangles.size() < triangles) {
    const std::size_t t = random() % mesh.triangles.size();
    const auto [i, j, k] = mesh.triangles[t];
    const double a = uniform(random), b = uniform(random), c = std::pow(uniform(random), 3);
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back((1 / (a + b + c)) * (a * mesh.vertices[i] + b * mesh.vertices[j] + c * mesh.vertices[k]));
    mesh.triangles[t] = {i, j, middle};
    mesh.triangles.push_back({j, k, middle});
    mesh.triangles.push_back({k, i, middle});
  }
  return mesh;
}

void expect_overlap(const Thickness& a, const Thickness& b) {
  // Coordinates of one solid are rounded otherwise, which delta and radii hold many times.
  EXPECT_LE(a.diameter.lower, b.diameter.upper * (1 + 1e-9));
  EXPECT_LE(b.diameter.lower, a.diameter.upper * (1 + 1e-9));
}

// The faces of a box are the same in whatever triangles.
TEST(Thickness, DoesNotDependOnTheTrianglesOfFlatFaces) {
  const Mesh box = make_box({2, 1, 0.4}), fine = quartered(box);
  std::mt19937_64 random(5);
  std::vector<Point> points = points_of(fine, random);
  points.resize(60);
  const std::vector<Thickness> coarse = thickness_at(solid_of(box), points);
  for (const Mesh& other : {fine, quartered(fine), split_at_random(box, 60, 1), split_at_random(box, 400, 2)}) {
    const std::vector<Thickness> found = thickness_at(solid_of(other), points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      SCOPED_TRACE(testing::Message() << other.triangles.size() << " triangles, point " << i);
      expect_overlap(coarse[i], found[i]);
    }
  }
}

/// How far the surface of an ellipsoid is from triangles with corners on it, at most. In the convex solid the distance
/// d from the boundary is concave, and along a line its second derivative is at least -kappa / (1 - kappa d), where
/// kappa bounds the curvatures. It is 0 at the corners v of a triangle, so at a point with the weights w it is at most
/// half of kappa / (1 - kappa d) times the sum of w |x - v|^2, which for edges of at most e is at most e^2 / 3.
double sagitta(const Mesh& mesh, double kappa) {
  double e = 0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      e = std::max(e, length(mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]));
    }
  }
  return (1 - std::sqrt(1 - 4 * kappa * kappa * e * e / 6)) / (2 * kappa);
}

// For meshes A and B within a convex solid that are nowhere deeper in it than h, d_A(m) <= d_B(m) + h. So a ball of A
// that comes within delta of a point, made smaller by h, is one of B that comes within delta + h.
TEST(Thickness, DependsOnTheFinenessOfACurvedMeshNoMoreThanItsSolidDoes) {
  const auto ellipsoid = smooth_ellipsoid(1, 0.8, 0.7);
  constexpr double kKappa = 1 / (0.7 * 0.7);
  std::vector<Mesh> meshes = {ellipsoid->mesh(900), ellipsoid->mesh(3600), ellipsoid->mesh(14400),
                              ellipsoid->mesh(3600)};
  make_irregular(*ellipsoid, meshes[3], 7);
  std::vector<Point> points = meshes[0].vertices;
  points.resize(100);
  std::vector<std::vector<Thickness>> near, nearer;
  std::vector<double> depths;
  for (const Mesh& mesh : meshes) {
    depths.push_back(sagitta(mesh, kKappa));
    ASSERT_LT(depths.back(), 0.03);
    const IndexedMesh solid = solid_of(mesh);
    ThicknessOptions wider = options_with();
    wider.delta += depths.back();
    nearer.push_back(thickness_at(solid, points));
    near.push_back(thickness_at(solid, points, wider));
  }
  for (std::size_t a = 0; a < meshes.size(); ++a) {
    for (std::size_t b = 0; b < meshes.size(); ++b) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LE(nearer[a][i].diameter.lower, near[b][i].diameter.upper + 2 * depths[b]) << a << ' ' << b << ' ' << i;
      }
    }
  }
}

// Rotation rounds the coordinates: intervals of one point have a common number.
TEST(Thickness, IsThatOfATurnedMesh) {
  const Mesh mesh = make_turned_torus(40, 24);
  Mesh turned = mesh;
  rotate(turned, {1, 2, 3}, 0.7);
  const std::vector<Thickness> a = thickness_at(solid_of(mesh), mesh.vertices),
                               b = thickness_at(solid_of(turned), turned.vertices);
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    expect_overlap(a[i], b[i]);
  }
}

TEST(Thickness, DoesNotDependOnThreads) {
  const Mesh mesh = make_turned_torus(40, 24);
  ThicknessOptions one = options_with(), three = one;
  one.threads = 1;
  three.threads = 3;
  const IndexedMesh solid = solid_of(mesh);
  const std::vector<Thickness> a = thickness_at(solid, mesh.vertices, one),
                               b = thickness_at(solid, mesh.vertices, three);
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(a[i].diameter.lower, b[i].diameter.lower);
    EXPECT_EQ(a[i].diameter.upper, b[i].diameter.upper);
    EXPECT_EQ(a[i].ball.centre, b[i].ball.centre);
    EXPECT_EQ(a[i].object_angle, b[i].object_angle);
    EXPECT_EQ(a[i].contacts, b[i].contacts);
    EXPECT_EQ(a[i].kind, b[i].kind);
  }
}

// Without its top, a box encloses the points whose winding number is at least 1/2.
TEST(Thickness, OfAnOpenMesh) {
  Mesh box = make_box({1, 1, 1});
  std::erase_if(box.triangles, [&](const Triangle& t) {
    return std::ranges::all_of(
        t, [&](std::uint32_t v) { return box.vertices[v][2] == box.vertices[box.triangles.front()[0]][2]; });
  });
  const IndexedMesh mesh = solid_of(box);
  ASSERT_FALSE(mesh.prepared().report.closed);
  const reference::Tree tree(to_reference(mesh.prepared()));
  for (const Thickness& found : thickness_at(mesh, mesh.prepared().mesh.vertices)) {
    EXPECT_LE(found.diameter.lower, found.diameter.upper);
    if (found.ball.radius == 0) continue;
    EXPECT_LE(found.ball.radius, tree.closest(to_eigen(found.ball.centre)).distance);
    EXPECT_GE(winding_number(tree, to_eigen(found.ball.centre), 0.001), 0.499);
  }
}

// A budget of few distances leaves an interval that is wider, and holds the thickness all the same.
TEST(Thickness, WithinABudget) {
  const IndexedMesh mesh = solid_of(make_turned_torus(40, 24));
  ThicknessOptions few = options_with();
  few.queries = 12;
  const std::vector<Thickness> wide = thickness_at(mesh, mesh.prepared().mesh.vertices, few),
                               all = thickness_at(mesh, mesh.prepared().mesh.vertices);
  std::size_t wider = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_LE(wide[i].diameter.lower, all[i].diameter.upper);
    EXPECT_GE(wide[i].diameter.upper, all[i].diameter.lower);
    wider += wide[i].diameter.upper > 1.03 * wide[i].diameter.lower ? 1 : 0;
    EXPECT_LE(all[i].diameter.upper, 1.03 * all[i].diameter.lower);
  }
  EXPECT_GT(wider, 0u);
}

// Later a wider interval is enough; both hold the thickness.
TEST(Thickness, AnImpatientSearchEndsWithAnIntervalFourTimesAsWide) {
  const IndexedMesh mesh = solid_of(make_turned_torus(40, 24));
  const std::vector<Point>& points = mesh.prepared().mesh.vertices;
  ThicknessOptions impatient = options_with();
  impatient.patience = 2;
  const std::vector<Thickness> wide = thickness_at(mesh, points, impatient), all = thickness_at(mesh, points);
  std::size_t wider = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    expect_overlap(wide[i], all[i]);
    const double width = wide[i].diameter.upper - wide[i].diameter.lower;
    EXPECT_LE(width, 1.01 * std::max(4 * impatient.width * wide[i].diameter.lower, 0.25 * kDelta));
    wider += width > widest(wide[i].diameter.lower) ? 1 : 0;
  }
  EXPECT_GT(wider, 0u);
}

TEST(Thickness, RefusesWhatIsWrong) {
  const IndexedMesh mesh = solid_of(make_box({1, 1, 1}));
  const auto message_of = [&](std::vector<Point> points, const ThicknessOptions& options) {
    const auto found = measure_thickness(mesh, points, options);
    if (found.ok()) return std::string();
    EXPECT_EQ(found.error().code, ErrorCode::kUsage);
    return found.error().message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ThicknessOptions options;
  EXPECT_EQ(message_of({{0, 0, nan}}, options), "`points` must have coordinates of at most 1e18");
  options.delta = -1;
  EXPECT_EQ(message_of({}, options), "`delta` must be a length, or 0");
  options = {};
  options.limit = nan;
  EXPECT_EQ(message_of({}, options), "`limit` must be a length, or 0");
  options = {};
  options.width = 0;
  EXPECT_EQ(message_of({}, options), "`width` must be from 1e-6 to 1");
  options = {};
  options.queries = 0;
  EXPECT_EQ(message_of({}, options), "`queries` must be positive");
  EXPECT_EQ(message_of({}, {}), "");
}

TEST(Thickness, CanBeStopped) {
  const IndexedMesh mesh = solid_of(make_turned_torus(40, 24));
  std::stop_source source;
  double done = 0;
  const auto found = measure_thickness(
      mesh, mesh.prepared().mesh.vertices, options_with(),
      [&](double share) {
        done = share;
        source.request_stop();
      },
      source.get_token());
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().code, ErrorCode::kInterrupted);
  EXPECT_GT(done, 0);
  EXPECT_LT(done, 1);
}

}  // namespace
}  // namespace medial_vk::test
