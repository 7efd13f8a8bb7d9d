// What limits the ball at a point: solids where walls, creases, corners and facets are known by construction.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "medial_vk/prepare.h"
#include "medial_vk/thickness.h"
#include "support/indexed.h"
#include "support/solids/solids.h"
#include "thickness/ball_kind.h"

namespace medial_vk::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Of a polygon in the plane z = 0, counterclockwise and convex, from z = 0 to `height`, or with an apex there.
Mesh extruded(const std::vector<Point>& polygon, double height, bool has_apex = false) {
  const auto n = static_cast<std::uint32_t>(polygon.size());
  Mesh mesh;
  mesh.vertices = polygon;
  if (has_apex) {
    mesh.vertices.push_back({0, 0, height});
  } else {
    for (const Point& p : polygon) mesh.vertices.push_back(p + Point{0, 0, height});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    if (has_apex) {
      mesh.triangles.push_back({i, next, n});
    } else {
      mesh.triangles.push_back({i, next, n + next});
      mesh.triangles.push_back({i, n + next, n + i});
    }
  }
  for (std::uint32_t i = 2; i < n; ++i) {
    mesh.triangles.push_back({0, i, i - 1});
    if (!has_apex) mesh.triangles.push_back({n, n + i - 1, n + i});
  }
  return mesh;
}

std::vector<Point> circle(double radius, int corners) {
  std::vector<Point> polygon;
  polygon.reserve(static_cast<std::size_t>(corners));
  for (int i = 0; i < corners; ++i) {
    polygon.push_back({radius * std::cos(2 * kPi * i / corners), radius * std::sin(2 * kPi * i / corners), 0});
  }
  return polygon;
}

/// Two faces of unit length that meet at the z axis with this angle inside.
std::vector<Point> wedge(double angle) {
  return {{0, 0, 0}, {std::cos(angle / 2), -std::sin(angle / 2), 0}, {std::cos(angle / 2), std::sin(angle / 2), 0}};
}

struct KnownKind {
  const char* where;
  Point at;
  ThicknessKind kind;
  double object_angle = -1;  // known, or negative
};

/// In five positions: the normals at contacts are those of faces, and no more than rounding and, at p, which of several
/// faces is the nearest, depends on the position.
void expect_kinds(const Mesh& mesh, const std::vector<KnownKind>& known, ThicknessOptions options = {}) {
  if (options.delta == 0) options.delta = 0.002;
  for (int turn = 0; turn < 5; ++turn) {
    SCOPED_TRACE(turn);
    Mesh turned = mesh;
    for (const KnownKind& one : known) turned.vertices.push_back(one.at);  // turned with the mesh
    if (turn > 0) rotate(turned, {1, 2.0 * turn, 3}, 0.7 * turn);
    std::vector<Point> points(turned.vertices.end() - static_cast<std::ptrdiff_t>(known.size()), turned.vertices.end());
    turned.vertices.resize(mesh.vertices.size());
    const IndexedMesh solid = indexed(prepare_mesh(turned).value());
    const std::vector<Thickness> found = measure_thickness(solid, points, options).value();
    for (std::size_t i = 0; i < known.size(); ++i) {
      SCOPED_TRACE(known[i].where);
      EXPECT_EQ(found[i].kind, known[i].kind) << found[i].object_angle;
      if (known[i].object_angle >= 0) {
        EXPECT_NEAR(found[i].object_angle, known[i].object_angle, 1e-6);
      }
      const double width = found[i].diameter.upper - found[i].diameter.lower;
      for (const Point& contact : found[i].contacts) {
        const double distance = length(contact - found[i].ball.centre);
        EXPECT_GE(distance, found[i].ball.radius * (1 - 1e-9));
        EXPECT_LE(distance, (found[i].ball.radius + options.delta + width) * (1 + 1e-9));
      }
    }
  }
}

TEST(ThicknessKinds, OfABox) {
  expect_kinds(make_box({2, 1, 0.4}), {{"face", {1, 0.5, 0.4}, ThicknessKind::kWall, kPi / 2},
                                       {"other face", {1.2, 0.4, 0}, ThicknessKind::kWall, kPi / 2},
                                       {"edge", {1, 0, 0.4}, ThicknessKind::kCrease, kPi / 4},
                                       {"beside the edge", {1, 0.05, 0.4}, ThicknessKind::kCrease, kPi / 4},
                                       {"corner", {2, 1, 0.4}, ThicknessKind::kCorner, kPi / 4},
                                       {"beside the corner", {0.05, 0.05, 0}, ThicknessKind::kCorner, kPi / 4}});
}

// A wall, whatever its thickness, down to some ten deltas.
TEST(ThicknessKinds, OfPlates) {
  for (const double thickness : {0.02, 0.1, 0.3}) {
    SCOPED_TRACE(thickness);
    expect_kinds(make_plate_with_hole(1, thickness, 0.4), {{"above", {0.15, 0.5, thickness}, ThicknessKind::kWall},
                                                           {"below", {0.15, 0.4, 0}, ThicknessKind::kWall},
                                                           {"edge", {0.5, 0, 0}, ThicknessKind::kCrease, kPi / 4}});
  }
}

// The normal turns by pi less the angle inside. An edge that is sharper than walls are allowed to taper is a wall.
TEST(ThicknessKinds, OfWedges) {
  ThicknessOptions options;
  options.delta = 1e-4;
  for (const double degrees : {160.0, 120.0, 90.0, 60.0, 50.0}) {
    SCOPED_TRACE(degrees);
    const double angle = degrees * kPi / 180;
    const ThicknessKind kind = degrees > 152 ? ThicknessKind::kFacets : ThicknessKind::kCrease;
    const Point along = 0.005 * Point{std::cos(angle / 2), std::sin(angle / 2), 0};
    expect_kinds(
        extruded(wedge(angle), 1),
        {{"edge", {0, 0, 0.5}, kind, (kPi - angle) / 2}, {"face", along + Point{0, 0, 0.5}, kind, (kPi - angle) / 2}},
        options);
  }
  expect_kinds(extruded(wedge(kPi / 6), 1),
               {{"edge", {0, 0, 0.5}, ThicknessKind::kWall},
                {"face", {std::cos(kPi / 12) / 2, std::sin(kPi / 12) / 2, 0.5}, ThicknessKind::kWall, 5 * kPi / 12}});
}

// Facets turn by 5.6 degrees, and the ball between two of them is far smaller than the cylinder.
TEST(ThicknessKinds, OfACylinder) {
  ThicknessOptions options;
  options.delta = 1e-4;
  const double middle = std::cos(kPi / 64);
  const Mesh cylinder = extruded(circle(1, 64), 3);
  expect_kinds(cylinder,
               {{"line between facets", {1, 0, 1.5}, ThicknessKind::kFacets, kPi / 64},
                {"rim", {middle * middle, middle * std::sin(kPi / 64), 3}, ThicknessKind::kCrease, kPi / 4}},
               options);
  options.delta = 0.01;
  expect_kinds(cylinder, {{"side", {1, 0, 1.5}, ThicknessKind::kWall}, {"cap", {0, 0, 3}, ThicknessKind::kWall}},
               options);
  options.delta = 1e-4;
  options.crease_angle = 0.04;
  expect_kinds(cylinder, {{"line between facets", {1, 0, 1.5}, ThicknessKind::kCrease, kPi / 64}}, options);
}

// A ball in a cone touches it all around.
TEST(ThicknessKinds, OfACone) {
  const double middle = std::cos(kPi / 48);
  const Point half = {0.5 * middle * middle, 0.5 * middle * std::sin(kPi / 48), std::numbers::sqrt3 / 2};
  expect_kinds(extruded(circle(1, 48), std::numbers::sqrt3, true),
               {{"apex", {0, 0, std::numbers::sqrt3}, ThicknessKind::kCorner},
                {"half way up", half, ThicknessKind::kCorner},
                {"rim", 2 * Point{half[0], half[1], 0}, ThicknessKind::kCrease}});
}

// Outside, the inner edge of an angle is a crease, and the slit of a U is a gap.
TEST(ThicknessKinds, OfGaps) {
  ThicknessOptions options;
  options.side = ThicknessSide::kGaps;
  expect_kinds(make_l_shape(1, 0.3, 1), {{"inner edge", {0.3, 0.3, 0.5}, ThicknessKind::kCrease, kPi / 4}}, options);
  Mesh both = make_box({1, 1, 1});
  append(both, moved(make_box({1, 1, 1}), {1.1, 0, 0}));
  expect_kinds(both, {{"slit", {1, 0.5, 0.5}, ThicknessKind::kWall, kPi / 2}}, options);
}

// Opposite normals are a wall, two others a crease, and a third one makes it a corner if it leaves the plane of the two
// by the crease angle.
TEST(ThicknessKinds, OfNormals) {
  const auto kind = [](const std::vector<Point>& normals) {
    std::vector<BallContact> contacts;
    contacts.reserve(normals.size());
    for (const Point& normal : normals) contacts.push_back({normal, normal});
    return kind_of_ball(contacts, 1.2, 0.25).kind;
  };
  const auto at = [](double angle, double up = 0) {
    return Point{std::cos(angle) * std::cos(up), std::sin(angle) * std::cos(up), std::sin(up)};
  };
  EXPECT_EQ(kind({at(0)}), ThicknessKind::kFacets);
  EXPECT_EQ(kind({at(0), at(0.49), at(0.25, 0.3)}), ThicknessKind::kFacets);
  EXPECT_EQ(kind({at(0), at(0.51), at(0.25, 0.2)}), ThicknessKind::kCrease);
  EXPECT_EQ(kind({at(0), at(2.39), at(1.2, 0.24)}), ThicknessKind::kCrease);
  EXPECT_EQ(kind({at(0), at(2.39), at(1.2, -0.26)}), ThicknessKind::kCorner);
  EXPECT_EQ(kind({at(1.2, 1.2), at(0), at(2.41)}), ThicknessKind::kWall);
  EXPECT_EQ(kind({}), ThicknessKind::kFacets);
}

TEST(ThicknessKinds, RefuseAnglesOutOfOrder) {
  const IndexedMesh box = indexed(prepare_mesh(make_box({1, 1, 1})).value());
  const auto measured = [&](double wall, double crease) {
    ThicknessOptions options;
    options.wall_angle = wall;
    options.crease_angle = crease;
    return measure_thickness(box, std::vector<Point>{{0, 0, 0}}, options).ok();
  };
  EXPECT_TRUE(measured(1.2, 1.2));
  EXPECT_TRUE(measured(kPi / 2, 0));
  EXPECT_FALSE(measured(1.6, 0.2));
  EXPECT_FALSE(measured(1, 1.1));
  EXPECT_FALSE(measured(1, -0.1));
  EXPECT_FALSE(measured(std::nan(""), 0.1));
}

// Few cells of directions around such a point need a distance: they were divided until memory did not suffice.
TEST(ThicknessInside, FewDistancesEndTheSearchAtAPointFarFromTheBoundary) {
  const IndexedMesh mesh = indexed(prepare_mesh(make_torus(1, 0.4, 12, 8)).value());
  const std::vector<Point> points = {{0.91602537, 0.22605296, 0.30151356}, {0.91602537, -0.22605296, 0.30151356}};
  ThicknessOptions options;
  options.width = 0.1;
  const std::vector<Thickness> all = measure_thickness(mesh, points, options).value();
  options.queries = 50;
  const std::vector<Thickness> few = measure_thickness(mesh, points, options).value();
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(few[i].diameter.lower, all[i].diameter.upper);
    EXPECT_LE(all[i].diameter.lower, few[i].diameter.upper);
    EXPECT_GT(few[i].diameter.lower, 0.5);
  }
}

}  // namespace
}  // namespace medial_vk::test
