#include "support/solids/mesh_guarantees.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "cpu_reference/queries.h"
#include "support/reference_mesh.h"

namespace medial_vk::test {
namespace {

using Eigen::Vector3d;

/// The position of a medial point of the mesh near a smooth one, and its contacts.
struct Neighbourhood {
  double reach = 0;  // s above
  std::vector<int> contacts;
};

Neighbourhood around(const reference::Tree& tree, const SmoothMedialPoint& m, double deviation) {
  Neighbourhood near;
  near.reach = 8.0 / 3 * deviation / std::sin(m.object_angle());
  near.contacts = tree.gather(m.point, m.radius + deviation + near.reach);
  return near;
}

double sheet_angle(const reference::Tree& tree, const SmoothMedialPoint& m, const std::vector<int>& contacts) {
  const Vector3d other = m.spoke - 2 * m.axis.dot(m.spoke) * m.axis;
  double half_off = 0, other_half_off = 0;
  for (int t : contacts) {
    const double off = reference::half_angle(tree.normal(t), m.spoke);
    const double other_off = reference::half_angle(tree.normal(t), other);
    double& worst = off < other_off ? half_off : other_half_off;
    worst = std::max(worst, std::min(off, other_off));
  }
  return m.object_angle() - half_off - other_half_off;
}

double curve_angle(const reference::Tree& tree, const SmoothMedialPoint& m, const std::vector<int>& contacts) {
  const double cone = std::acos(m.spoke.dot(m.axis));
  double off = 0;
  for (int t : contacts) off = std::max(off, std::abs(std::acos(tree.normal(t).dot(m.axis)) - cone));
  return std::asin(std::sqrt(0.75) * std::sin(std::max(m.object_angle() - off, 0.0)));
}

/// Climbs to the deepest point of the section across a curve. Where the climb stalls, on a ridge, contacts tie too.
Vector3d deepest_in_section(const reference::Tree& tree, const SmoothMedialPoint& m, const Neighbourhood& near,
                            double precision) {
  const auto depth = [&](const Vector3d& p) {
    double squared = std::numeric_limits<double>::infinity();
    for (int t : near.contacts) squared = std::min(squared, tree.closest_on(t, p).squared_distance);
    return squared;
  };
  const Vector3d right = m.axis.unitOrthogonal(), up = m.axis.cross(right);
  constexpr int kDirections = 12;
  Vector3d best = m.point;
  double best_depth = depth(best);
  for (double step = near.reach / 2; step > precision;) {
    const Vector3d from = best;
    for (int i = 0; i < kDirections; ++i) {
      const double phi = 2 * std::numbers::pi * i / kDirections;
      const Vector3d p = from + step * (std::cos(phi) * right + std::sin(phi) * up);
      const double p_depth = depth(p);
      if (p_depth > best_depth) {
        best = p;
        best_depth = p_depth;
      }
    }
    if (best == from) step /= 2;
  }
  return best;
}

/// The object angle that the mesh itself has in the section across a curve; 0 if its deepest point is elsewhere.
double section_angle(const reference::Tree& tree, const SmoothMedialPoint& m, const Neighbourhood& near) {
  const double precision = 1e-7 * m.radius;
  const Vector3d deepest = deepest_in_section(tree, m, near, precision);
  if ((deepest - m.point).norm() > near.reach) return 0;
  const double radius = tree.closest(deepest).distance;
  std::vector<Vector3d> spokes;
  for (int t : tree.gather(deepest, radius + 4 * precision)) {
    spokes.push_back((tree.closest_on(t, deepest).point - deepest).normalized());
  }
  double widest = 0;
  for (const Vector3d& a : spokes) {
    for (const Vector3d& b : spokes) widest = std::max(widest, reference::half_angle(a, b));
  }
  return widest;
}

}  // namespace

std::vector<Guarantee> guarantees_of(const SmoothSolid& solid, const Mesh& mesh, double deviation, double spacing) {
  const reference::Tree tree(to_reference(mesh));
  std::vector<Guarantee> guarantees;
  for (const SmoothMedialPoint& m : solid.medial_points(spacing)) {
    const Neighbourhood near = around(tree, m, deviation);
    if (near.reach > m.radius * std::sin(m.object_angle()) / 2) continue;
    double angle = 0;
    if (m.on_curve) {
      angle = std::max(curve_angle(tree, m, near.contacts), section_angle(tree, m, near));
    } else {
      angle = sheet_angle(tree, m, near.contacts);
    }
    guarantees.push_back({m.point, near.reach, angle});
  }
  return guarantees;
}

double farthest_off(const MedialSphere& s, double deviation, double epsilon) {
  const double near = s.radius, far = near + 2 * deviation + 2 * epsilon;
  const double gain = near - far * std::cos(static_cast<double>(s.object_angle));
  return gain > 0 ? (far * far - near * near) / (2 * gain) : std::numeric_limits<double>::infinity();
}

}  // namespace medial_vk::test
