// Lemma J: carriers that leave one vertex, against points that are found to touch both of them by distances alone.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "cpu_reference/queries.h"
#include "dismissal/common_corner.h"
#include "unit/cpu_reference/random.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;
using reference::Arc;
using reference::Carrier;

/// A triangle with a corner at the origin, far larger than the points that are tried: only its wedge matters.
struct Wedge {
  std::array<Vector3d, 3> corners;
  Vector3d normal;
};

/// Directions between those of a plane and all directions: many sheets are nearly flat.
Wedge make_wedge(Random& random, double flatness) {
  const auto direction = [&] { return random.direction().cwiseProduct(Vector3d(1, 1, flatness)).normalized(); };
  Wedge w;
  do {
    w.corners = {Vector3d::Zero(), 1e3 * direction(), 1e3 * direction()};
    w.normal = w.corners[1].cross(w.corners[2]);
  } while (w.normal.norm() < 0.1 * 1e6);
  w.normal.normalize();
  return w;
}

/// The feature of a wedge that holds a foot.
struct Foot {
  int feature;  // 0: the face from behind, 1: from in front, 2 and 3: its edges at the origin; -1: the vertex
  Vector3d spoke;
  double distance;
};

Foot foot_of(const Wedge& w, const Vector3d& m) {
  const auto on = reference::closest_point_on_triangle(m, w.corners[0], w.corners[1], w.corners[2]);
  Foot foot = {-1, (on.point - m).normalized(), std::sqrt(on.squared_distance)};
  if (on.feature == reference::Feature::kFace) foot.feature = w.normal.dot(m) < 0 ? 0 : 1;
  for (int k = 1; k < 3 && on.feature == reference::Feature::kEdge; ++k) {
    if (on.point.cross(w.corners[k]).norm() < 1e-9 * w.corners[k].norm()) foot.feature = 1 + k;
  }
  return foot;
}

/// The carrier of a feature of the wedge, whose vertices are numbered from `first` on, except for the common one.
Carrier make_carrier(const Wedge& w, int feature, int first, Arc& arc) {
  Carrier c = {};
  c.spokes = reference::Cap::all();
  c.triangle_corners = {0, first, first + 1};
  if (feature < 2) {
    c.corners = w.corners;
    c.corner_count = 3;
    c.vertices = c.triangle_corners;
    c.normals = {feature == 0 ? w.normal : Vector3d(-w.normal), Vector3d::Zero()};
    c.normal_count = 1;
    return c;
  }
  const int end = feature - 1;
  const Vector3d along = w.corners[end].normalized(), other = w.corners[3 - end];
  arc = {along, (other - other.dot(along) * along).normalized(), std::numbers::pi / 2};
  c.corners = {w.corners[0], w.corners[end], w.corners[end]};
  c.corner_count = 2;
  c.vertices = {0, first + end - 1, first + end - 1};
  c.arc = &arc;
  return c;
}

/// A point equally far from both wedges: on an arc between two random ones, by bisection.
std::optional<Vector3d> find_tie(const Wedge& a, const Wedge& b, Random& random) {
  const Vector3d p = random.direction(), q = random.direction();
  const auto at = [&](double t) { return ((1 - t) * p + t * q).normalized().eval(); };
  const auto gap = [&](double t) { return foot_of(a, at(t)).distance - foot_of(b, at(t)).distance; };
  double low = 0, high = 1;
  if (gap(low) > 0 || gap(high) < 0) return std::nullopt;
  for (int i = 0; i < 60; ++i) (gap((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return at(low);
}

bool can_meet(const Wedge& a, int feature_a, const Wedge& b, int feature_b, double angle) {
  Arc arc_a, arc_b;
  const Carrier p = make_carrier(a, feature_a, 1, arc_a), q = make_carrier(b, feature_b, 3, arc_b);
  const bool answer = can_meet_at_corner(p, q, angle);
  EXPECT_EQ(answer, can_meet_at_corner(q, p, angle));
  return answer;
}

TEST(ReferenceCommonCorner, WhatTouchesBothIsNeverExcluded) {
  Random random(3);
  std::array<int, 3> seen = {0, 0, 0};  // by the number of edges
  for (int i = 0; i < 60'000; ++i) {
    const double flatness = i % 3 == 0 ? 1 : std::pow(10, random(-3, 0));
    const Wedge a = make_wedge(random, flatness), b = make_wedge(random, flatness);
    const std::optional<Vector3d> m = find_tie(a, b, random);
    if (!m) continue;
    const Foot p = foot_of(a, *m), q = foot_of(b, *m);
    const double angle = reference::half_angle(p.spoke, q.spoke);
    if (p.feature < 0 || q.feature < 0 || angle < 0.01 || p.distance < 1e-6) continue;
    ++seen[(p.feature >= 2 ? 1 : 0) + (q.feature >= 2 ? 1 : 0)];
    EXPECT_TRUE(can_meet(a, p.feature, b, q.feature, angle - 1e-9)) << p.feature << ' ' << q.feature << ' ' << angle;
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
}

// Power: of the pairs of features that are not excluded, most are observed to be touched at once. (Two faces are not
// tested for the angle between them, which caps cover.)
TEST(ReferenceCommonCorner, WhatIsNotExcludedExists) {
  constexpr double kAngle = 0.5;
  Random random(4);
  int allowed = 0, seen = 0, excluded = 0;
  for (int i = 0; i < 60; ++i) {
    const double flatness = i % 2 == 0 ? 1 : 0.1;
    const Wedge a = make_wedge(random, flatness), b = make_wedge(random, flatness);
    bool touched[4][4] = {};
    for (int k = 0; k < 3000; ++k) {
      const std::optional<Vector3d> m = find_tie(a, b, random);
      if (!m) continue;
      const Foot p = foot_of(a, *m), q = foot_of(b, *m);
      if (p.feature < 0 || q.feature < 0 || reference::half_angle(p.spoke, q.spoke) < kAngle) continue;
      touched[p.feature][q.feature] = true;
    }
    for (int p = 0; p < 4; ++p) {
      for (int q = 0; q < 4; ++q) {
        const bool is_allowed = can_meet(a, p, b, q, kAngle);
        excluded += is_allowed ? 0 : 1;
        allowed += is_allowed ? 1 : 0;
        seen += touched[p][q] ? 1 : 0;
        EXPECT_TRUE(is_allowed || !touched[p][q]);
      }
    }
  }
  EXPECT_GT(excluded, 400) << allowed;
  EXPECT_GT(seen, 0.8 * allowed) << allowed;
}

// Carriers without a common vertex are not tested, nor are vertices.
TEST(ReferenceCommonCorner, NeedsACommonVertex) {
  Random random(5);
  const Wedge a = make_wedge(random, 1), b = make_wedge(random, 1);
  Arc arc;
  const Carrier p = make_carrier(a, 0, 1, arc);
  Carrier q = make_carrier(b, 0, 3, arc);
  for (int& v : q.vertices) v += 10;
  EXPECT_TRUE(can_meet_at_corner(p, q, 0.5));
  q.vertices = p.vertices;
  q.corner_count = 1;
  EXPECT_TRUE(can_meet_at_corner(p, q, 0.5));
}

}  // namespace
}  // namespace medial_vk
