// Curvatures at the vertices of meshes whose smooth solids and medial balls are known in closed form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <stop_token>

#include "medial_vk/medial_vk.h"
#include "support/solids/solids.h"
#include "unit/curvature/ball_sheets.h"

namespace medial_vk {
namespace {

constexpr double kBallSpacing = 0.07;

IndexedMesh indexed(const Mesh& mesh) {
  return IndexedMesh::build(MeshView{mesh.vertices, mesh.triangles, {}, true}).value();
}

struct Case {
  Mesh mesh;
  std::vector<Ball> balls;

  std::vector<VertexCurvature> measured(CurvatureAssignment assignment = CurvatureAssignment::kAlongSurface) const {
    CurvatureOptions options;
    options.spacing = kBallSpacing;
    VertexCurvatureOptions vertex_options;
    vertex_options.assignment = assignment;
    return curvature_at_vertices(indexed(mesh), balls, measure_curvature(balls, options).value(), vertex_options)
        .value();
  }
};

/// Semi-axes 2, 2 and 1. The balls end before the rim of the sheet, at an object angle of 0.39.
Case spheroid_case(std::uint32_t segments) {
  return {test::make_ellipsoid({2, 2, 1}, segments), test::spheroid(2, 1, kBallSpacing).balls};
}

std::array<double, 2> spheroid_truth(const Point& p) {
  const double sine = std::hypot(p[0], p[1]) / 2;  // p = (a sin t, c cos t)
  const double speed = std::sqrt(4 * (1 - sine * sine) + sine * sine);
  const double along = 2 / (speed * speed * speed), across = 1 / (2 * speed);
  return {std::max(along, across), std::min(along, across)};
}

constexpr double kDisc = 1.5, kRound = 0.5;

/// A plate with a round rim: the balls of radius 0.5 around a disc of radius 1.5.
Case disc_case(std::uint32_t triangles) {
  Case out = {test::make_sphere(1, triangles), {}};
  for (Point& p : out.mesh.vertices) {
    // The point of the boundary nearest to one of a spheroid around it.
    const Point q = {(kDisc + kRound) * p[0], (kDisc + kRound) * p[1], kRound * p[2]};
    const double away = std::hypot(q[0], q[1]), kept = std::min(away, kDisc);
    const Point core = away > 0 ? Point{kept / away * q[0], kept / away * q[1], 0} : Point{0, 0, 0};
    const Point offset = q - core;
    p = core + (kRound / length(offset)) * offset;
  }
  test::scatter(kDisc, kDisc, kBallSpacing, [&](double x, double y) {
    if (std::hypot(x, y) <= kDisc) out.balls.push_back({{x, y, 0}, kRound});
  });
  return out;
}

struct Count {
  std::size_t known = 0, below = 0, all = 0;
  double errors = 0;

  void add(const VertexCurvature& found, const std::array<double, 2>& truth) {
    ++all;
    if (!is_known(found.state)) return;
    ++known;
    const double error = std::max(std::fabs(found.kappa[0] - truth[0]), std::fabs(found.kappa[1] - truth[1]));
    errors += error;
    if (error <= found.error) ++below;
  }
};

TEST(VertexCurvature, OfASpheroidWithItsCap) {
  for (const std::uint32_t segments : {60u, 120u}) {
    const Case solid = spheroid_case(segments);
    const std::vector<VertexCurvature> found = solid.measured();
    Count all, cap;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Point& p = solid.mesh.vertices[i];
      all.add(found[i], spheroid_truth(p));
      if (std::fabs(p[2]) < 0.1) cap.add(found[i], spheroid_truth(p));  // between the last tips
    }
    EXPECT_GE(all.known, 0.98 * static_cast<double>(all.all));
    EXPECT_GE(all.below, 0.9 * static_cast<double>(all.known));
    // From the last tips, where it is 1.7, to the equator, where it is 2, the greater curvature changes by 0.3; the cap
    // is a polynomial that keeps the place and the direction of both ends.
    EXPECT_GE(cap.known, 0.98 * static_cast<double>(cap.all));
    EXPECT_LT(cap.errors, 0.1 * static_cast<double>(cap.known));
  }
}

TEST(VertexCurvature, ARoundRimHasTheCurvatureOfItsBall) {
  const Case solid = disc_case(8000);
  const std::vector<VertexCurvature> along = solid.measured();
  const std::vector<VertexCurvature> cells = solid.measured(CurvatureAssignment::kVoronoi);
  Count rim, flat;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < along.size(); ++i) {
    const Point& p = solid.mesh.vertices[i];
    const double away = std::hypot(p[0], p[1]);
    if (away < kDisc - 6 * kBallSpacing) flat.add(along[i], {0, 0});
    if (std::fabs(p[2]) > 0.8 * kRound) continue;  // the border of the rim
    // Of the circles around the axis, the normal makes this angle with their planes.
    const double cosine = (away - kDisc) / kRound;
    rim.add(along[i], {1 / kRound, cosine / away});
    ASSERT_TRUE(is_known(along[i].state));
    EXPECT_EQ(along[i].tip, VertexCurvature::kCap);
    if (std::fabs(cells[i].kappa[0] - 1 / kRound) > 0.5 / kRound) ++wrong;
  }
  EXPECT_GT(rim.all, 500u);
  EXPECT_GE(rim.below, 0.98 * static_cast<double>(rim.known));
  // The last ball of the sheet is up to a spacing from its rim: its radius is exact here, its centre is not.
  EXPECT_LT(rim.errors, static_cast<double>(rim.known) * kBallSpacing / (kRound * kRound));
  EXPECT_GE(flat.below, 0.98 * static_cast<double>(flat.known));
  EXPECT_GE(flat.known, 0.98 * static_cast<double>(flat.all));
  // As the source says of its method: caps get the curvature beside them.
  EXPECT_GT(wrong, rim.all / 4);
}

TEST(VertexCurvature, ATubeHasOneCurvatureAndItsEndsHaveBoth) {
  Case solid = {test::make_capsule(0.5, 4, 40), {}};
  for (int i = -40; i <= 40; ++i) solid.balls.push_back({{0, 0, 0.05 * i}, 0.5});  // closer than the spacing
  const std::vector<VertexCurvature> found = solid.measured();
  std::size_t sides = 0, ends = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Point& p = solid.mesh.vertices[i];
    if (std::fabs(p[2]) < 1.9) {
      EXPECT_EQ(found[i].state, CurvatureState::kCurve);
      EXPECT_NEAR(found[i].kappa[0], 2, 1e-12);
      EXPECT_TRUE(std::isnan(found[i].kappa[1]));
      EXPECT_NEAR(found[i].directions[0][2], 0, 1e-12);  // around the tube
      ++sides;
    }
    if (std::fabs(p[2]) < 2.1) continue;
    EXPECT_EQ(found[i].state, CurvatureState::kCut);
    EXPECT_EQ(found[i].tip, VertexCurvature::kCap);
    for (const double kappa : found[i].kappa) EXPECT_NEAR(kappa, 2, 1e-12);
    // The last two balls have too few neighbours to be known as those of a curve; it may end a spacing farther out.
    EXPECT_LE(found[i].error, 1.001 * 3 * kBallSpacing / 0.25);
    ++ends;
  }
  EXPECT_GT(sides, 100u);
  EXPECT_GT(ends, 100u);
}

TEST(VertexCurvature, AWallThinnerThanTrianglesKeepsItsSides) {
  constexpr double kInner = 1, kOuter = 1.04;  // edges are 0.1 long
  Case solid;
  constexpr std::uint32_t kAround = 60, kRows = 21;
  const auto place = [](double radius, std::uint32_t i, std::uint32_t j) {
    const double angle = 2 * std::numbers::pi * i / kAround;
    return Point{radius * std::cos(angle), radius * std::sin(angle), 0.1 * j - 1};
  };
  for (const double radius : {kInner, kOuter}) {
    const auto first = static_cast<std::uint32_t>(solid.mesh.vertices.size());
    for (std::uint32_t j = 0; j < kRows; ++j) {
      for (std::uint32_t i = 0; i < kAround; ++i) solid.mesh.vertices.push_back(place(radius, i, j));
    }
    for (std::uint32_t j = 0; j + 1 < kRows; ++j) {
      for (std::uint32_t i = 0; i < kAround; ++i) {
        const std::uint32_t a = first + j * kAround + i, b = first + j * kAround + (i + 1) % kAround;
        const bool is_outer = radius > kInner;
        solid.mesh.triangles.push_back({a, is_outer ? b : a + kAround, b + kAround});
        solid.mesh.triangles.push_back({a, b + kAround, is_outer ? a + kAround : b});
      }
    }
  }
  solid.balls = test::pipe_wall(kInner, kOuter, kBallSpacing).balls;
  for (const auto assignment : {CurvatureAssignment::kAlongSurface, CurvatureAssignment::kVoronoi}) {
    const std::vector<VertexCurvature> found = solid.measured(assignment);
    std::size_t known = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!is_known(found[i].state)) continue;
      ++known;
      // The other side has -1 and 0, or 0 and 0.96.
      const bool is_outer = i >= found.size() / 2;
      EXPECT_NEAR(found[i].kappa[0], is_outer ? 1 / kOuter : 0, 0.25);
      EXPECT_NEAR(found[i].kappa[1], is_outer ? 0 : -1 / kInner, 0.25);
    }
    EXPECT_GT(known, found.size() / 5);  // the balls are beside a part of the pipe
  }
}

TEST(VertexCurvature, TurnsWithTheSolid) {
  const Case solid = spheroid_case(40);
  const std::vector<VertexCurvature> before = solid.measured();
  const Eigen::Matrix3d turn(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, -1).normalized()));
  const auto turned = [&](const Point& p) {
    const Eigen::Vector3d q = turn * Eigen::Vector3d(p[0], p[1], p[2]);
    return Point{q[0], q[1], q[2]};
  };
  Case other = solid;
  for (Point& p : other.mesh.vertices) p = turned(p);
  for (Ball& ball : other.balls) ball.centre = turned(ball.centre);
  const std::vector<VertexCurvature> after = other.measured();
  // Where two balls or two windows are equally good, rounding decides. Which tip is the first depends on the
  // coordinates.
  std::size_t different = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    bool is_same = before[i].state == after[i].state && before[i].ball == after[i].ball;
    for (std::size_t k = 0; k < 2; ++k)
      is_same = is_same && !(std::fabs(before[i].kappa[k] - after[i].kappa[k]) > 1e-6);
    is_same = is_same && !(length(turned(before[i].normal) - after[i].normal) > 1e-6);
    if (!is_same) ++different;
  }
  EXPECT_LE(different, before.size() / 100);
}

/// At the corners of a box that is 1 thick nothing is known, and the nearest of the balls between its faces tell why.
TEST(VertexCurvature, TheNearestBallTellsWhyNothingIsKnown) {
  Mesh box = test::make_box({4, 4, 1});
  for (Point& p : box.vertices) p = p - Point{2, 2, 0.5};
  const IndexedMesh mesh = indexed(box);
  const auto states_of = [&](const std::vector<Ball>& balls) {
    CurvatureOptions options;
    options.spacing = kBallSpacing;
    const auto found = curvature_at_vertices(mesh, balls, measure_curvature(balls, options).value()).value();
    std::vector<CurvatureState> states;
    for (const VertexCurvature& at : found) {
      EXPECT_TRUE(std::isnan(at.kappa[0]) && std::isnan(at.kappa[1]));
      states.push_back(at.state);
    }
    return states;
  };
  std::vector<Ball> even, noisy;
  test::scatter(1.5, 1.5, kBallSpacing, [&](double x, double y) {
    even.push_back({{x, y, 0}, 0.5});
    noisy.push_back({{x, y, 0}, 0.5 + 0.02 * std::sin(1000 * x)});
  });
  EXPECT_THAT(states_of(even), testing::Each(CurvatureState::kEdge));
  EXPECT_THAT(states_of(noisy), testing::Each(CurvatureState::kUncertain));
  const std::vector<Ball> few = {{{0, 0, 0}, 0.5}, {{0.5, 0, 0}, 0.5}, {{0, 0.5, 0}, 0.5}};
  EXPECT_THAT(states_of(few), testing::Each(testing::AnyOf(CurvatureState::kFew, CurvatureState::kExposed)));
}

/// A spheroid has no edge; where a half of the balls is noise, the fits to the other half are continued too far.
TEST(VertexCurvature, OnlyEdgesOfTheMeshAreEdges) {
  Case solid = spheroid_case(60);
  for (Ball& ball : solid.balls) {
    if (ball.centre[0] > 0) ball.radius *= 1 + 0.05 * std::sin(1000 * ball.centre[1]);
  }
  std::size_t unknown = 0;
  for (const VertexCurvature& at : solid.measured()) {
    EXPECT_NE(at.state, CurvatureState::kEdge);
    unknown += is_known(at.state) ? 0 : 1;
  }
  EXPECT_GT(unknown, solid.mesh.vertices.size() / 4);
}

TEST(VertexCurvature, NothingIsKnownWithoutBalls) {
  const IndexedMesh mesh = indexed(test::make_box({1, 1, 1}));
  for (const auto assignment : {CurvatureAssignment::kAlongSurface, CurvatureAssignment::kVoronoi}) {
    VertexCurvatureOptions options;
    options.assignment = assignment;
    const auto found = curvature_at_vertices(mesh, {}, {}, options).value();
    ASSERT_EQ(found.size(), 8u);
    for (const VertexCurvature& at : found) {
      EXPECT_EQ(at.state, CurvatureState::kFew);
      EXPECT_EQ(at.ball, VertexCurvature::kNoBall);
      EXPECT_TRUE(std::isnan(at.kappa[0]));
    }
  }
}

TEST(VertexCurvature, RefusesWhatIsWrong) {
  const Case solid = spheroid_case(20);
  const IndexedMesh mesh = indexed(solid.mesh);
  const BoundaryCurvature curvature = measure_curvature(solid.balls).value();
  const auto code_of = [&](std::span<const Ball> balls, const VertexCurvatureOptions& options) {
    return curvature_at_vertices(mesh, balls, curvature, options).error().code;
  };
  EXPECT_EQ(code_of(std::span(solid.balls).first(3), {}), ErrorCode::kUsage);
  std::vector<Ball> bad = solid.balls;
  bad[5].radius = -1;
  EXPECT_EQ(code_of(bad, {}), ErrorCode::kUsage);
  VertexCurvatureOptions options;
  options.object_angle = 2;
  EXPECT_EQ(code_of(solid.balls, options), ErrorCode::kUsage);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(curvature_at_vertices(mesh, solid.balls, curvature, {}, {}, stop.get_token()).error().code,
            ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
