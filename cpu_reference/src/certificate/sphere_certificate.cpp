#include "cpu_reference/sphere_certificate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

constexpr double kUnit = 0x1p-53;
constexpr int kHalvings = 44;
constexpr int kMostPieces = 500'000;  // of one triangle

std::string description(const char* what, std::size_t number, const Vector3d& at) {
  char text[160];
  std::snprintf(text, sizeof text, "%s %zu at (%.9g, %.9g, %.9g)", what, number, at.x(), at.y(), at.z());
  return text;
}

/// One condition: records the count, the least margin and the first failure.
class Row {
 public:
  Row(std::string condition, std::string unit) {
    line_.condition = std::move(condition);
    line_.unit = std::move(unit);
    line_.worst = std::numeric_limits<double>::infinity();
  }

  /// Negative margins, and nan, fail.
  void test(double margin, const char* what, std::size_t number, const Vector3d& at) {
    ++line_.tested;
    if (!(margin >= line_.worst)) line_.worst = margin;
    if (!(margin >= 0) && line_.failed++ == 0) line_.first_failure = description(what, number, at);
  }

  CertificateLine line() const {
    CertificateLine copy = line_;
    if (copy.tested == 0) copy.worst = 0;
    return copy;
  }

 private:
  CertificateLine line_;
};

using Corners = std::array<Vector3d, 3>;

/// Cuts a triangle at the middle of its longest side until each part is in one ball.
class TriangleParts {
 public:
  explicit TriangleParts(const std::vector<UnionBall>& balls) : balls_(balls) {}

  /// The margin by which the worst part is inside its ball; negative: a part is in none, and `where` lies in it.
  double cover(const Corners& triangle, const std::vector<int>& near, double moved, Vector3d& where) {
    left_ = kMostPieces;
    moved_ = moved;
    least_ = std::numeric_limits<double>::infinity();
    where_ = triangle[0];
    if (!cut(triangle, near, 0)) least_ = -1;
    where = where_;
    return least_;
  }

 private:
  /// A ball holds a triangle if it holds its corners. Every cut may round a corner by half a unit in the last place of
  /// each coordinate; a distance is wrong by some units in its last place.
  double depth_in(const UnionBall& ball, const Corners& part) const {
    double farthest = 0;
    for (const Vector3d& corner : part) farthest = std::max(farthest, (corner - ball.centre).norm());
    return ball.radius - farthest - 8 * kUnit * ball.radius - moved_;
  }

  bool cut(const Corners& part, const std::vector<int>& near, int depth) {
    const Vector3d middle = (part[0] + part[1] + part[2]) / 3;
    double around = 0, best = -std::numeric_limits<double>::infinity();
    for (const Vector3d& corner : part) around = std::max(around, (corner - middle).norm());
    std::vector<int> nearer;
    bool middle_is_in = false;
    for (const int i : near) {
      const double gap = (middle - balls_[i].centre).norm() - balls_[i].radius;
      if (gap <= 0) middle_is_in = true;
      if (gap <= around) nearer.push_back(i);
      best = std::max(best, depth_in(balls_[i], part));
    }
    if (best >= 0) {
      least_ = std::min(least_, best);
      return true;
    }
    where_ = middle;
    if (!middle_is_in || depth == kHalvings || --left_ < 0) return false;
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
      if ((part[k] - part[(k + 1) % 3]).norm() > (part[longest] - part[(longest + 1) % 3]).norm()) longest = k;
    }
    const Vector3d &a = part[longest], &b = part[(longest + 1) % 3], &c = part[(longest + 2) % 3];
    const Vector3d half = (a + b) / 2;
    return cut({a, half, c}, nearer, depth + 1) && cut({half, b, c}, nearer, depth + 1);
  }

  const std::vector<UnionBall>& balls_;
  double moved_ = 0, least_ = 0;
  int left_ = 0;
  Vector3d where_;
};

/// The points that three spheres have in common.
///
/// A cavity of the union has, in every direction u, a farthest point, with u in the cone of the inward unit normals w
/// of three spheres there. Let their centres be on one line but for the sine s at the smallest ball. The balls meet, so
/// that |det w| <= 4 s. If the spheres' common circle has a radius of at least g / 100, g the greatest radius, the
/// sides a, b, c of the spherical triangle of the w have 1 + cos a + cos b + cos c >= 4 / 100^2, so that it has an area
/// of at most 2 * 4 s / (4 / 100^2) = 2 * 10^4 s. With s < 10^-12, both points of 10^8 such triples serve less than a
/// third of all u. So these points need no test, and rounding, which decides where they are, has no say. Smaller
/// circles are tested.
class Corner {
 public:
  Corner(const UnionBall& one, const UnionBall& two, const UnionBall& three) : spheres_{&one, &two, &three} {
    std::sort(spheres_.begin(), spheres_.end(),
              [](const UnionBall* left, const UnionBall* right) { return left->radius < right->radius; });
    // Two planes of equal power, and their common line.
    const UnionBall &a = *spheres_[0], &b = *spheres_[1], &c = *spheres_[2];
    const Vector3d n1 = b.centre - a.centre, n2 = c.centre - a.centre;
    if (n1.isZero(0) || n2.isZero(0)) return;
    const double k1 = (n1.squaredNorm() + (a.radius - b.radius) * (a.radius + b.radius)) / 2;
    const double k2 = (n2.squaredNorm() + (a.radius - c.radius) * (a.radius + c.radius)) / 2;
    const Vector3d along = n1.cross(n2);
    const double sine = along.norm() / (n1.norm() * n2.norm());
    if (sine < kCollinear) {
      touch(n1.normalized(), k1 / n1.norm(), k2 / n2.dot(n1.normalized()));
      return;
    }
    Eigen::Matrix3d planes;  // of unit normals: the rank does not depend on the unit of length
    planes << n1.normalized().transpose(), n2.normalized().transpose(), along.normalized().transpose();
    const Vector3d foot = planes.fullPivLu().solve(Vector3d(k1 / n1.norm(), k2 / n2.norm(), 0));
    const double foot_error = 32 * kUnit * c.radius / sine;
    const double squared = (a.radius - foot.norm()) * (a.radius + foot.norm());
    if (squared < -(1e-9 * c.radius + 2 * foot_error) * c.radius) return;
    const Vector3d up = std::sqrt(std::max(0.0, squared)) * along.normalized();
    points_ = {a.centre + foot + up, a.centre + foot - up};
    exists_ = true;
  }

  bool exists() const { return exists_; }
  /// The points stand for a small circle around the line of the centres: error() reaches it.
  bool is_circle() const { return is_circle_; }
  const std::array<Vector3d, 2>& points() const { return points_; }

  /// A bound of the distance of the true point from a computed one: the residual of the equations, through the inverse
  /// of their directions; at most that to the point where the spheres only touch.
  double error(const Vector3d& at) const {
    Eigen::Matrix3d directions;
    double left = 0, greatest = 0;
    for (int k = 0; k < 3; ++k) {
      const Vector3d to = at - spheres_[k]->centre;
      directions.row(k) = to.transpose() / to.norm();
      left = std::max(left, std::abs(to.norm() - spheres_[k]->radius));
      greatest = std::max(greatest, spheres_[k]->radius);
    }
    left += 16 * kUnit * (greatest + at.norm());
    const bool has_inverse = !is_circle_ && directions.fullPivLu().isInvertible();
    const double inverse = has_inverse ? directions.inverse().norm() : std::numeric_limits<double>::infinity();
    return std::min(2 * left * inverse, 4 * std::sqrt((left + 1e-9 * greatest) * greatest));
  }

 private:
  static constexpr double kCollinear = 1e-12;

  /// Spheres with their centres on one line: `first` and `second` are the places, from the smallest ball along the
  /// line, of its circles with the others. The point on the line stands for circles that are small: error() reaches
  /// them.
  void touch(const Vector3d& along, double first, double second) {
    const UnionBall& a = *spheres_[0];
    const double greatest = spheres_[2]->radius;
    const double squared = (a.radius - first) * (a.radius + first);
    const double small = 1e-4 * greatest * greatest, rounding = 1e-9 * greatest * greatest;
    if (squared < -rounding || squared > small) return;
    if (std::abs(first - second) > 4 * std::sqrt(std::max(0.0, squared) + rounding)) return;
    points_ = {a.centre + first * along, a.centre + first * along};
    exists_ = is_circle_ = true;
  }

  std::array<const UnionBall*, 3> spheres_;
  std::array<Vector3d, 2> points_;
  bool exists_ = false, is_circle_ = false;
};

class CoverCheck {
 public:
  CoverCheck(const Mesh& mesh, const std::vector<UnionBall>& balls) : mesh_(mesh), balls_(balls), tree_(mesh) {
    for (const Vector3d& v : mesh.vertices) magnitude_ = std::max(magnitude_, v.cwiseAbs().maxCoeff());
  }

  void surface() {
    TriangleParts parts(balls_);
    const double moved = kHalvings * 1.7320508075688775 * kUnit * magnitude_;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const Eigen::Vector3i& c = mesh_.triangles[t];
      const Corners corners = {mesh_.vertices[c[0]], mesh_.vertices[c[1]], mesh_.vertices[c[2]]};
      const Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3;
      double around = 0;
      for (const Vector3d& corner : corners) around = std::max(around, (corner - middle).norm());
      std::vector<int> near;
      for (std::size_t i = 0; i < balls_.size(); ++i) {
        if ((balls_[i].centre - middle).norm() - balls_[i].radius <= around) near.push_back(static_cast<int>(i));
      }
      Vector3d where;
      const double margin = parts.cover(corners, near, moved, where);
      surface_.test(margin, "triangle", t, where);
    }
  }

  void corners() {
    for (std::size_t a = 0; a < balls_.size(); ++a) {
      if (is_hidden(a)) continue;
      // Later balls that meet it; earlier ones may hold its points too.
      std::vector<std::size_t> later, all;
      for (std::size_t b = 0; b < balls_.size(); ++b) {
        if (b == a || !meet(a, b)) continue;
        all.push_back(b);
        if (b > a) later.push_back(b);
      }
      for (std::size_t i = 0; i < later.size(); ++i) {
        for (std::size_t j = i + 1; j < later.size(); ++j) {
          if (meet(later[i], later[j])) corner(a, later[i], later[j], all);
        }
      }
    }
  }

  void closed() { closed_.test(mesh_.closed ? 0 : -1, "mesh", 0, Vector3d::Zero()); }

  Certificate rows() const { return {{surface_.line(), corners_.line(), closed_.line()}}; }

 private:
  bool meet(std::size_t a, std::size_t b) const {
    const double gap = (balls_[a].centre - balls_[b].centre).norm();
    const double room = 1e-9 * (balls_[a].radius + balls_[b].radius);
    return gap <= balls_[a].radius + balls_[b].radius + room &&
           gap >= std::abs(balls_[a].radius - balls_[b].radius) - room;
  }

  bool is_held(const Vector3d& at, const std::vector<std::size_t>& by) const {
    return std::any_of(by.begin(), by.end(), [&](std::size_t i) {
      return (at - balls_[i].centre).norm() < balls_[i].radius - 1e-10 * (balls_[i].radius + at.norm());
    });
  }

  /// True if a ball besides the three holds all points that are no farther away than `reach`.
  bool is_held_by_others(const Vector3d& at, const std::vector<std::size_t>& by,
                         const std::array<std::size_t, 3>& three, double reach) const {
    return std::any_of(by.begin(), by.end(), [&](std::size_t i) {
      const bool is_other = std::find(three.begin(), three.end(), i) == three.end();
      return is_other && (at - balls_[i].centre).norm() + reach < balls_[i].radius * (1 - 1e-10);
    });
  }

  void corner(std::size_t a, std::size_t b, std::size_t c, const std::vector<std::size_t>& near) {
    const Corner corner(balls_[a], balls_[b], balls_[c]);
    if (!corner.exists()) return;
    for (const Vector3d& at : corner.points()) {
      if (corner.is_circle() ? is_held_by_others(at, near, {a, b, c}, corner.error(at)) : is_held(at, near)) continue;
      const double distance = tree_.closest(at).distance - 2 * tree_.rounding();
      const double margin = is_inside(tree_, at) ? -1 : distance - corner.error(at);
      corners_.test(margin, "corner of ball", a, at);
    }
  }

  /// True if a ball holds all of this one's sphere, and more.
  bool is_hidden(std::size_t a) const {
    return std::any_of(balls_.begin(), balls_.end(), [&](const UnionBall& other) {
      const double room = 1e-9 * (other.radius + balls_[a].radius);
      return (balls_[a].centre - other.centre).norm() + balls_[a].radius < other.radius - room;
    });
  }

  const Mesh& mesh_;
  const std::vector<UnionBall>& balls_;
  const Tree tree_;
  double magnitude_ = 0;
  Row surface_{"the balls cover every triangle", "length"};
  Row corners_{"no corner of the balls' surface is in the solid: no cavity", "length"};
  Row closed_{"the mesh is closed: what its boundary encloses is the solid", "of 1"};
};

bool all_finite(const std::vector<UnionBall>& balls, Row& row) {
  bool good = true;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const bool here = balls[i].centre.allFinite() && std::isfinite(balls[i].radius) && balls[i].radius >= 0;
    row.test(here ? 0 : -1, "ball", i, balls[i].centre);
    good = good && here;
  }
  return good;
}

}  // namespace

Certificate check_inside(const Mesh& mesh, const std::vector<UnionBall>& balls) {
  const Tree tree(mesh);
  Row finite("finite numbers", "of 1"), inside("centre inside (winding number at least 1/2)", "of 1"),
      below("radius <= exact distance", "length");
  if (all_finite(balls, finite)) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
      inside.test(is_inside(tree, balls[i].centre) ? 0 : -1, "ball", i, balls[i].centre);
      below.test(tree.closest(balls[i].centre).distance - balls[i].radius, "ball", i, balls[i].centre);
    }
  }
  return {{finite.line(), inside.line(), below.line()}};
}

Certificate check_cover(const Mesh& mesh, const std::vector<UnionBall>& balls) {
  Row finite("finite numbers", "of 1");
  if (!all_finite(balls, finite)) return {{finite.line()}};
  CoverCheck check(mesh, balls);
  check.surface();
  check.corners();
  check.closed();
  Certificate rows = check.rows();
  rows.lines.insert(rows.lines.begin(), finite.line());
  return rows;
}

}  // namespace medial_vk::reference
