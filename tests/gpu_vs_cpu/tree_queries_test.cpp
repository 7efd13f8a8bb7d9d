// Every kernel that walks the tree against the reference in double precision; tolerances: tree_test.h.
#include "support/indexed.h"
#include "tree_test.h"

#include <cmath>

namespace medial_vk {
namespace {

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
      const Eigen::Vector3d p = test::to_eigen(points[i]);
      const reference::Closest truth = tree.closest(p);
      const ClosestPoint& hit = found.value()[i];
      ASSERT_NEAR(hit.distance, truth.distance, tolerance);
      ASSERT_NEAR((test::to_eigen(hit.point) - p).norm(), hit.distance, 1e-12 * tree.longest_side());
      ASSERT_LE(tree.closest(test::to_eigen(hit.point)).distance, tolerance);
      ASSERT_LT(hit.triangle, solid.mesh.triangles.size());
      const reference::TrianglePoint on = tree.closest_on(static_cast<int>(hit.triangle), p);
      ASSERT_NEAR(std::sqrt(on.squared_distance), truth.distance, tolerance);
      other_features += static_cast<int>(on.feature) != static_cast<int>(hit.feature);
      squares += std::pow((hit.distance - truth.distance) / tree.longest_side(), 2);
    }
    // The bound is the worst case; typical rounding errors stay an order of magnitude below.
    EXPECT_LE(std::sqrt(squares / static_cast<double>(points.size())), 2e-7);
    // Features differ only where the nearest point is within rounding of a feature's end.
    EXPECT_LE(other_features, static_cast<int>(points.size()) / 200);
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
      const double distance = tree.closest(test::to_eigen(p)).distance;
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

// The mesh on the device has an error of 1.6e-7 L; where the boundary is further than 0.02 L, that changes a solid
// angle by less than 1e-3. GLSL's atan may have an error of 4096 units in the last place, 2.5e-4 of each angle.
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
        if (tree.closest(test::to_eigen(points[i])).distance < 0.02 * tree.longest_side()) continue;
        worst = std::max(worst, std::abs(numbers[i] - reference::winding_number(tree, test::to_eigen(points[i]))));
      }
      EXPECT_LE(worst, tolerance + kWindingRounding);
    }
  }
}

// The error of a sample's direction is up to sqrt(2^-22) = 5e-4 where it is nearest to an edge or a vertex
// (tree_closest.glsl), otherwise 2.2e-6 L over its distance, which is at least 0.02 L; and so is that of its part of
// the flux. A sample that lies on the medial surface or on the boundary of a fan to within rounding may count
// differently, and changes the average by up to 2 / N; there are few of these.
TEST_F(TreeQueriesTest, Fluxes) {
  constexpr std::uint32_t kSamples = 50;
  for (const NamedSolid& solid : solids()) {
    SCOPED_TRACE(solid.name);
    const reference::Tree tree(test::to_reference(solid.mesh));
    const double longest = tree.longest_side();
    std::vector<Ball> spheres;
    for (const Point& p : points_in_box(tree, 1000, 4)) {
      const double room = tree.closest(test::to_eigen(p)).distance - 0.02 * longest;
      if (room > 0.01 * longest) spheres.push_back({p, std::min(room, 0.1 * longest)});
    }
    const std::vector<Eigen::Vector3d> directions = reference::spiral_points(kSamples);
    const std::vector<FluxSample> found = scene_of(solid.mesh).fluxes(spheres, kSamples).value();
    int undecided = 0;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      const reference::Flux truth =
          reference::outward_flux(tree, test::to_eigen(spheres[i].centre), spheres[i].radius, directions);
      EXPECT_NEAR(found[i].greatest_distance, truth.greatest_distance, kDistanceTolerance * longest);
      const bool same = static_cast<int>(found[i].fans) == truth.fans;
      const double error = std::abs(found[i].flux - truth.average);
      undecided += !(same && error <= 5e-4);
    }
    EXPECT_LE(undecided, static_cast<int>(spheres.size()) / 50) << "of " << spheres.size();
  }
}

// Every triangle is equally near: no box can be excluded, and the walk gives up long before it has visited them all.
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
    const double truth = tree.closest(test::to_eigen(points[i])).distance;
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
      const double truth = tree.closest(test::to_eigen(points[i])).distance;
      EXPECT_NEAR(found[i].distance, truth, kDistanceTolerance * tree.longest_side());
      if (truth < 0.02 * tree.longest_side()) continue;
      EXPECT_NEAR(numbers[i], reference::winding_number(tree, test::to_eigen(points[i])), 0.02 + kWindingRounding);
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
            "`group_size` must be 1 to 262144 and divide the number of points; it is 5 for 7 points");
  EXPECT_EQ(scene.closest_points_of_groups(std::vector<Point>(7), 0).error().code, ErrorCode::kUsage);
  Mesh flat;
  flat.vertices = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_EQ(test::make_scene(*context_, test::view_of(flat)).error().code, ErrorCode::kInvalidMesh);
}

}  // namespace
}  // namespace medial_vk
