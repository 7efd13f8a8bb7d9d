// Every kernel that walks the tree against the reference in double precision.
//
// Tolerances, for a mesh whose longest side is L and queries within its box, u = 2^-24. The device sees positions
// scaled to the unit box and rounded to float: the query and a corner a are off by sqrt(3) u/2 each, an edge by as much
// again; together below 3 sqrt(3) u/2 = 1.6e-7. The distance to a triangle is evaluated to 8 u (|p - a| + |edge|)
// (shaders/shared/closest_point.glsl); with |p - a| <= sqrt(3) and edges up to sqrt(2) that is 1.5e-6.
// Faces are preferred to edges by 2^-21 of the distance (tree_closest.glsl), 5e-7. Sum: 2.2e-6 L.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "cpu_reference/queries.h"
#include "medial_vk/queries.h"
#include "support/device.h"
#include "support/reference_mesh.h"
#include "support/solids.h"

namespace medial_vk {
namespace {

constexpr double kDistanceTolerance = 2.2e-6;

Eigen::Vector3d vector(const Point& p) { return {p[0], p[1], p[2]}; }

MeshView view_of(const Mesh& mesh) { return {mesh.vertices, mesh.triangles, {}, true}; }

struct NamedSolid {
  std::string name;
  Mesh mesh;
};

/// Convex, concave, with a hole, thin, needles, far from the origin; all in generic position.
std::vector<NamedSolid> solids() {
  std::vector<NamedSolid> all = {{"box", test::make_box({1, 2, 3})},
                                 {"ellipsoid", test::make_ellipsoid({1, 0.9, 0.4}, 40)},
                                 {"needles", test::make_capsule(1, 1, 60)},
                                 {"cup", test::make_cup(1, 0.1, 1.5, 60)},
                                 {"L", test::make_l_shape(2, 0.5, 1)},
                                 {"torus", test::make_torus(1, 0.3, 60, 30)},
                                 {"plate", test::make_plate_with_hole(2, 0.05, 0.7)}};
  for (Point& p : all[2].mesh.vertices) p[2] *= 100;  // triangles a hundred times longer than wide
  double angle = 0.3;
  for (NamedSolid& solid : all) {
    test::rotate(solid.mesh, {1, -2, 0.5}, angle);
    angle += 0.4;
  }
  test::scale(all[5].mesh, 1e-3);
  test::translate(all[5].mesh, {5, -3, 4});
  return all;
}

/// One context for all tests, with validation where the layer is installed; no message may come.
class TreeQueriesTest : public testing::Test {
 protected:
  void SetUp() override {
    MEDIAL_VK_SKIP_WITHOUT_DEVICE();
    const bool validation = test::no_validation_reason().empty();
    Result<Context> created = Context::create({.device = "", .validation = validation, .cache_folder = "/dev/null"});
    ASSERT_TRUE(created.ok()) << created.error().message;
    context_.emplace(std::move(created).value());
  }
  void TearDown() override {
    if (context_) {
      EXPECT_EQ(context_->validation_messages(), 0u);
    }
  }
  Scene scene_of(const Mesh& mesh) {
    Result<Scene> scene = Scene::create(*context_, view_of(mesh));
    EXPECT_TRUE(scene.ok());
    return std::move(scene).value();
  }
  std::optional<Context> context_;
};

/// Points spread over the mesh's box, the same every time.
std::vector<Point> points_in_box(const reference::Tree& tree, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<Point> points(count);
  for (Point& p : points) {
    for (int k = 0; k < 3; ++k) p[k] = tree.lower()[k] + share(random) * (tree.upper()[k] - tree.lower()[k]);
  }
  return points;
}

TEST_F(TreeQueriesTest, ClosestPoints) {
  for (const NamedSolid& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const reference::Tree tree(test::to_reference(solid.mesh));
    const double tolerance = kDistanceTolerance * tree.longest_side();
    const std::vector<Point> points = points_in_box(tree, 3000, 1);
    const auto found = scene_of(solid.mesh).closest_points(points);
    ASSERT_TRUE(found.ok()) << found.error().message;
    ASSERT_EQ(found.value().size(), points.size());
    double squares = 0;
    int other_features = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d p = vector(points[i]);
      const reference::Closest truth = tree.closest(p);
      const ClosestPoint& hit = found.value()[i];
      ASSERT_NEAR(hit.distance, truth.distance, tolerance);
      ASSERT_NEAR((vector(hit.point) - p).norm(), hit.distance, 1e-12 * tree.longest_side());
      ASSERT_LE(tree.closest(vector(hit.point)).distance, tolerance);
      ASSERT_LT(hit.triangle, solid.mesh.triangles.size());
      const reference::TrianglePoint on = tree.closest_on(static_cast<int>(hit.triangle), p);
      ASSERT_NEAR(std::sqrt(on.squared_distance), truth.distance, tolerance);
      other_features += static_cast<int>(on.feature) != static_cast<int>(hit.feature);
      squares += std::pow((hit.distance - truth.distance) / tree.longest_side(), 2);
    }
    // The bound is the worst case; rounding errors that do not conspire stay an order of magnitude below.
    EXPECT_LE(std::sqrt(squares / static_cast<double>(points.size())), 2e-7);
    // Features differ only where the nearest point is within rounding of a feature's end.
    EXPECT_LE(other_features, static_cast<int>(points.size()) / 200);
  }
}

// Packets choose the triangle by another arithmetic, good to 15 u (|p - a| + |edge|) (triangle_frame.glsl), 3e-6: one
// that is further by twice that may win. Root mean squares stay as small as one by one.
constexpr double kPacketTolerance = kDistanceTolerance + 6e-6;

/// Groups of `size` points on spheres around the points.
std::vector<Point> groups_around(const std::vector<Point>& centres, double radius, std::uint32_t size) {
  const std::vector<Eigen::Vector3d> directions = reference::spiral_points(static_cast<int>(size));
  std::vector<Point> points;
  for (const Point& c : centres) {
    for (const Eigen::Vector3d& d : directions) {
      points.push_back({c[0] + radius * d[0], c[1] + radius * d[1], c[2] + radius * d[2]});
    }
  }
  return points;
}

void expect_closest(const reference::Tree& tree, const std::vector<Point>& points,
                    const std::vector<ClosestPoint>& found) {
  const double longest = tree.longest_side();
  ASSERT_EQ(found.size(), points.size());
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = vector(points[i]);
    const double truth = tree.closest(p).distance;
    ASSERT_NEAR(found[i].distance, truth, kPacketTolerance * longest) << "query " << i;
    ASSERT_NEAR((vector(found[i].point) - p).norm(), found[i].distance, 1e-12 * longest);
    const reference::TrianglePoint on = tree.closest_on(static_cast<int>(found[i].triangle), p);
    ASSERT_NEAR(std::sqrt(on.squared_distance), truth, kPacketTolerance * longest) << "query " << i;
    squares += std::pow((found[i].distance - truth) / longest, 2);
  }
  EXPECT_LE(std::sqrt(squares / static_cast<double>(points.size())), 2e-7);
}

TEST_F(TreeQueriesTest, GroupsOfPoints) {
  for (const NamedSolid& solid : solids()) {
    const reference::Tree tree(test::to_reference(solid.mesh));
    Scene scene = scene_of(solid.mesh);
    for (const std::uint32_t size : {1u, 50u, 51u, 120u}) {
      SCOPED_TRACE(solid.name + ", groups of " + std::to_string(size));
      const std::vector<Point> points =
          groups_around(points_in_box(tree, 1500 / static_cast<int>(size) + 1, 7), 0.02 * tree.longest_side(), size);
      expect_closest(tree, points, scene.closest_points_of_groups(points, size).value());
    }
  }
}

// So many points are sorted and answered by packets.
TEST_F(TreeQueriesTest, ManyScatteredPoints) {
  for (const NamedSolid& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const reference::Tree tree(test::to_reference(solid.mesh));
    const std::vector<Point> points = points_in_box(tree, 6001, 8);
    expect_closest(tree, points, scene_of(solid.mesh).closest_points(points).value());
  }
}

TEST_F(TreeQueriesTest, FeaturesOfABox) {
  Mesh mesh = test::make_box({2, 2, 2});
  test::rotate(mesh, {1, 2, 3}, 0.7);
  Mesh queries;
  queries.vertices = {{1, 1.1, 2.5}, {-0.5, 0.7, 1}, {1.2, -0.3, 2.4}, {2.2, 0.9, -0.7}, {2.5, 2.3, 2.7}};
  test::rotate(queries, {1, 2, 3}, 0.7);
  const auto found = scene_of(mesh).closest_points(queries.vertices).value();
  const std::vector<Feature> expected = {Feature::kFace, Feature::kFace, Feature::kEdge, Feature::kEdge,
                                         Feature::kVertex};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(found[i].feature, expected[i]) << "query " << i;
}

TEST_F(TreeQueriesTest, TiesGoToTheSmallestIndex) {
  const Mesh mesh = test::make_box({2, 2, 2});
  const auto found = scene_of(mesh).closest_points(std::vector<Point>{{1, 1, 1}}).value();
  EXPECT_EQ(found[0].triangle, 0u);
  EXPECT_DOUBLE_EQ(found[0].distance, 1.0);
  const auto group = scene_of(mesh).closest_points_of_groups(std::vector<Point>(51, Point{1, 1, 1}), 51).value();
  for (const ClosestPoint& hit : group) EXPECT_EQ(hit.triangle, 0u);
}

TEST_F(TreeQueriesTest, EmptyBalls) {
  for (const NamedSolid& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const reference::Tree tree(test::to_reference(solid.mesh));
    const double tolerance = kDistanceTolerance * tree.longest_side();
    std::vector<Ball> balls;
    std::vector<std::uint8_t> expected;
    int k = 0;
    for (const Point& p : points_in_box(tree, 2000, 2)) {
      const double distance = tree.closest(vector(p)).distance;
      const double change = ++k % 3 == 0 ? 0.2 * distance : 0.0;  // most just beside the boundary
      const bool inside = k % 2 == 0;
      balls.push_back({p, inside ? distance - change - tolerance : distance + change + tolerance});
      expected.push_back(inside ? 1 : 0);
    }
    balls.push_back({balls[0].centre, 0});
    balls.push_back({balls[0].centre, -1});
    expected.insert(expected.end(), {1, 1});
    EXPECT_EQ(scene_of(solid.mesh).empty_balls(balls).value(), expected);
  }
}

// The mesh that the device sees is off by 1.6e-7 L; where the boundary is further than 0.02 L, that moves a solid angle
// by less than 1e-3. GLSL's atan may be off by 4096 units in the last place, 2.5e-4 of each angle.
constexpr double kWindingRounding = 2e-3;

TEST_F(TreeQueriesTest, WindingNumbers) {
  std::vector<NamedSolid> all = solids();
  Mesh half = all[1].mesh;  // an open mesh: numbers between 0 and 1
  half.triangles.resize(half.triangles.size() / 2);
  all.push_back({"half an ellipsoid", half});
  Mesh twice = all[0].mesh;  // nested: numbers 0, 1 and 2
  Mesh inner = all[0].mesh;
  test::scale(inner, 0.5);
  test::append(twice, inner);
  all.push_back({"two boxes", twice});
  for (const NamedSolid& solid : all) {
    SCOPED_TRACE(solid.name);
    const reference::Tree tree(test::to_reference(solid.mesh));
    Scene scene = scene_of(solid.mesh);
    const std::vector<Point> points = points_in_box(tree, 400, 3);
    for (const double tolerance : {0.3, 0.05, 0.01}) {
      const std::vector<double> numbers = scene.winding_numbers(points, tolerance).value();
      double worst = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (tree.closest(vector(points[i])).distance < 0.02 * tree.longest_side()) continue;
        worst = std::max(worst, std::abs(numbers[i] - reference::winding_number(tree, vector(points[i]))));
      }
      EXPECT_LE(worst, tolerance + kWindingRounding);
    }
  }
}

// A sample's direction is off by up to sqrt(2^-22) = 5e-4 where it is nearest to an edge or a vertex
// (tree_closest.glsl), else by 2.2e-6 L over its distance, which is at least 0.02 L; and so is its part of the flux. A
// sample that lies on the medial surface or on the boundary of a fan to within rounding may count differently, and
// changes the average by up to 2 / N; few do.
TEST_F(TreeQueriesTest, Fluxes) {
  constexpr std::uint32_t kSamples = 50;
  for (const NamedSolid& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const reference::Tree tree(test::to_reference(solid.mesh));
    const double longest = tree.longest_side();
    std::vector<Ball> spheres;
    for (const Point& p : points_in_box(tree, 1000, 4)) {
      const double room = tree.closest(vector(p)).distance - 0.02 * longest;
      if (room > 0.01 * longest) spheres.push_back({p, std::min(room, 0.1 * longest)});
    }
    const std::vector<Eigen::Vector3d> directions = reference::spiral_points(kSamples);
    const std::vector<FluxSample> found = scene_of(solid.mesh).fluxes(spheres, kSamples).value();
    int undecided = 0;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const reference::Flux truth =
          reference::outward_flux(tree, vector(spheres[i].centre), spheres[i].radius, directions);
      EXPECT_NEAR(found[i].greatest_distance, truth.greatest_distance, kDistanceTolerance * longest);
      const bool same = static_cast<int>(found[i].fans) == truth.fans;
      const double error = std::abs(found[i].flux - truth.average);
      undecided += !(same && error <= 5e-4);
    }
    EXPECT_LE(undecided, static_cast<int>(spheres.size()) / 50) << "of " << spheres.size();
  }
}

// Every triangle is equally near: no box can be left out, and the walk gives up long before it has seen them all.
TEST_F(TreeQueriesTest, CentreOfASphere) {
  const Mesh mesh = test::make_sphere(1.0, 200000);
  const reference::Tree tree(test::to_reference(mesh));
  Scene scene = scene_of(mesh);
  std::vector<Point> points(40);
  double step = 0;
  for (Point& p : points) {
    p = {step, -2 * step, 1.5 * step};
    step += 1e-8;
  }
  const auto found = scene.closest_points(points);
  ASSERT_TRUE(found.ok()) << found.error().message;
  const double tolerance = kDistanceTolerance * tree.longest_side();
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double truth = tree.closest(vector(points[i])).distance;
    EXPECT_NEAR(found.value()[i].distance, truth, tolerance);
    balls.push_back({points[i], truth + (i % 2 == 0 ? -tolerance : tolerance)});
  }
  const auto empty = scene.empty_balls(balls).value();
  for (std::size_t i = 0; i < balls.size(); ++i) EXPECT_EQ(empty[i], i % 2 == 0 ? 1 : 0);
  const std::vector<double> numbers = scene.winding_numbers(points, 1e-3).value();
  for (const double w : numbers) EXPECT_NEAR(w, 1.0, 1e-3 + kWindingRounding);
}

TEST_F(TreeQueriesTest, SmallMeshes) {
  for (const std::size_t triangles : {1, 2, 8, 9, 12}) {
    SCOPED_TRACE(triangles);
    Mesh mesh = test::make_box({1, 2, 3});
    test::rotate(mesh, {3, 1, 2}, 1.1);
    mesh.triangles.resize(triangles);
    const reference::Tree tree(test::to_reference(mesh));
    Scene scene = scene_of(mesh);
    const std::vector<Point> points = points_in_box(tree, 200, 5);
    const auto found = scene.closest_points(points).value();
    const auto numbers = scene.winding_numbers(points, 0.02).value();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double truth = tree.closest(vector(points[i])).distance;
      EXPECT_NEAR(found[i].distance, truth, kDistanceTolerance * tree.longest_side());
      if (truth < 0.02 * tree.longest_side()) continue;
      EXPECT_NEAR(numbers[i], reference::winding_number(tree, vector(points[i])), 0.02 + kWindingRounding);
    }
  }
}

TEST_F(TreeQueriesTest, TheSameEveryTime) {
  Mesh mesh = test::make_torus(1, 0.3, 80, 40);
  test::rotate(mesh, {1, 1, 2}, 0.9);
  const reference::Tree tree(test::to_reference(mesh));
  const std::vector<Point> points = points_in_box(tree, 5000, 6);
  const auto first = scene_of(mesh).closest_points(points).value();
  const auto second = scene_of(mesh).closest_points(points).value();
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(first[i].point, second[i].point);
    ASSERT_EQ(first[i].triangle, second[i].triangle);
  }
  EXPECT_EQ(scene_of(mesh).winding_numbers(points).value(), scene_of(mesh).winding_numbers(points).value());
}

TEST_F(TreeQueriesTest, RefusesWhatCannotBeAnswered) {
  const Mesh mesh = test::make_box({1, 1, 1});
  Scene scene = scene_of(mesh);
  const double nan = std::nan("");
  EXPECT_EQ(scene.closest_points(std::vector<Point>{{0, 0, 0}, {0, nan, 0}}).error().message,
            "query 1 is not finite or too far from the mesh");
  EXPECT_EQ(scene.winding_numbers(std::vector<Point>{{1e40, 0, 0}}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(scene.winding_numbers(std::vector<Point>{{0, 0, 0}}, 0).error().code, ErrorCode::kUsage);
  EXPECT_EQ(scene.fluxes(std::vector<Ball>{}, 0).error().code, ErrorCode::kUsage);
  EXPECT_TRUE(scene.closest_points({}).value().empty());
  EXPECT_TRUE(scene.closest_points_of_groups({}, 5).value().empty());
  EXPECT_EQ(scene.closest_points_of_groups(std::vector<Point>(7), 5).error().message,
            "7 points are no groups of 5 (1 to 262144)");
  EXPECT_EQ(scene.closest_points_of_groups(std::vector<Point>(7), 0).error().code, ErrorCode::kUsage);
  Mesh flat;
  flat.vertices = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_EQ(Scene::create(*context_, view_of(flat)).error().code, ErrorCode::kInvalidMesh);
}

}  // namespace
}  // namespace medial_vk
