#include "dismissal/common_corner.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The error of unit vectors and spokes of two carriers: normals and derived directions are right to 1e-9, and faces
// hold the spokes to their flat edges.
constexpr double kDirectionSlack = 2 * (kFaceAngle + 2 * kNormalSlack);

/// A face, or an edge with the spokes to it, as seen from a vertex that it leaves.
struct Leaving {
  bool is_face;
  Vector3d toward;    // face: unit normal towards points that touch it
  Vector3d walls[2];  // face: in its plane, unit, across the sides that leave the vertex, into the triangle
  Vector3d along;     // edge: unit, from the vertex
  Vector3d middle;    // edge: of the arc of spokes
  double arc = 0;     // edge: half of that
};

Leaving leave(const Carrier& c, int corner) {
  const Vector3d here = c.corners[corner];
  Leaving out = {c.corner_count == 3, Vector3d::Zero(), {Vector3d::Zero(), Vector3d::Zero()}, {}, {}, 0};
  if (out.is_face) {
    out.toward = -c.normals[0];
    for (const int k : {0, 1}) {
      const Vector3d side = c.corners[(corner + 1 + k) % 3] - here, other = c.corners[(corner + 2 - k) % 3] - here;
      const Vector3d wall = side.cross(out.toward).normalized();
      out.walls[k] = wall.dot(other) < 0 ? Vector3d(-wall) : wall;
    }
    return out;
  }
  out.along = (c.corners[1 - corner] - here).normalized();
  if (c.arc != nullptr) {
    out.middle = c.arc->middle;
    out.arc = c.arc->angle;
  } else {
    out.middle = (c.normals[0] + c.normals[1]).normalized();
    out.arc = half_angle(c.normals[0], c.normals[1]) + kNormalSlack;
  }
  return out;
}

/// Conditions v.y >= r on the unit vectors y across an axis: each holds on an arc of their circle.
class CornerCircle {
 public:
  explicit CornerCircle(const Vector3d& axis) : first_(axis.unitOrthogonal()), second_(axis.cross(first_)) {}

  void demand(const Vector3d& v, double r) { arcs_.push_back({{v.dot(first_), v.dot(second_)}, r}); }

  /// True if some y meets all conditions. Then either none of them has an end, or an end of one is in all others.
  /// Computed ends are wrong by 1e-15 over the sine of half the arc, but by no more than the root of that.
  bool has_point() const {
    bool free = true;
    for (const Condition& c : arcs_) {
      const double size = c.v.norm();
      if (c.r > size) return false;
      if (c.r <= -size) continue;
      free = false;
      const double cosine = c.r / size, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
      const Vector2d middle = c.v / size, across(-middle.y(), middle.x());
      for (const double sign : {1.0, -1.0}) {
        const Vector2d end = cosine * middle + sign * sine * across;
        const auto holds = [&](const Condition& other) {
          return &other == &c || other.v.dot(end) >= other.r - kEndSlack * other.v.norm();
        };
        if (std::all_of(arcs_.begin(), arcs_.end(), holds)) return true;
      }
    }
    return free;
  }

 private:
  static constexpr double kEndSlack = 1e-7;
  struct Condition {
    Vector2d v;
    double r;
  };
  Vector3d first_, second_;
  std::vector<Condition> arcs_;
};

bool faces_can_meet(const Leaving& a, const Leaving& b) {
  const Vector3d across = a.toward - b.toward;
  const double size = across.norm();
  if (size < 1e-3) return true;  // no spokes that differ by 2 theta, for any theta of interest
  const double slack = kDirectionSlack * (1 + 1 / size);
  CornerCircle x(across / size);
  x.demand(a.toward + b.toward, -2 * slack);
  for (const Leaving* face : {&a, &b}) {
    for (const Vector3d& wall : face->walls) x.demand(wall, -slack);
  }
  return x.has_point();
}

bool edge_can_meet_face(const Leaving& edge, const Leaving& face, double angle) {
  const double slack = 10 * kDirectionSlack, rise = edge.along.dot(face.toward);
  if (rise < -slack) return false;
  CornerCircle s(edge.along);
  s.demand(edge.middle, std::cos(edge.arc) - slack);
  s.demand(face.toward, -std::cos(2 * angle) - slack);
  for (const Vector3d& wall : face.walls) {
    const double along = wall.dot(edge.along);
    s.demand(along * face.toward - rise * wall, -along - slack);
  }
  return s.has_point();
}

bool edges_can_meet(const Leaving& a, const Leaving& b, double angle) {
  const double slack = 10 * kDirectionSlack, apart = std::max(0.0, 1 - a.along.dot(b.along));
  CornerCircle s(a.along);
  s.demand(a.middle, std::cos(a.arc) - slack);
  s.demand(-b.along, std::sin(angle) * std::sqrt(2 * std::max(0.0, apart - slack)) - slack);
  s.demand(apart * b.middle + a.along.dot(b.middle) * b.along, apart * std::cos(b.arc) - slack);
  return s.has_point();
}

bool is_tested(const Carrier& c) {
  if (c.corner_count == 1) return false;
  return c.normal_count > 0 || (c.corner_count == 2 && c.arc != nullptr);
}

}  // namespace

bool can_meet_at_corner(const Carrier& a, const Carrier& b, double angle) {
  if (!is_tested(a) || !is_tested(b)) return true;
  for (int i = 0; i < a.corner_count; ++i) {
    for (int j = 0; j < b.corner_count; ++j) {
      if (a.vertices[i] < 0 || a.vertices[i] != b.vertices[j]) continue;
      const Leaving p = leave(a, i), q = leave(b, j);
      if (p.is_face && q.is_face) return faces_can_meet(p, q);
      if (!p.is_face && !q.is_face) return edges_can_meet(p, q, angle);
      return p.is_face ? edge_can_meet_face(q, p, angle) : edge_can_meet_face(p, q, angle);
    }
  }
  return true;
}

}  // namespace medial_vk::reference
