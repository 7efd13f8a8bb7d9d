// The generalised winding number, exact and fast.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

/// Solid angle of a triangle seen from p, positive if p lies behind it (van Oosterom and Strackee 1983).
double solid_angle(const Vector3d& p, const Vector3d& corner_a, const Vector3d& corner_b, const Vector3d& corner_c) {
  const Vector3d a = corner_a - p, b = corner_b - p, c = corner_c - p;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  const double volume = a.dot(b.cross(c));
  const double spread = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return 2 * std::atan2(volume, spread);
}

}  // namespace

void Tree::add_moments(Node& node) const {
  double area = 0;
  Vector3d weighted = Vector3d::Zero();
  node.area_normal.setZero();
  for (int i = node.first; i < node.last; ++i) {
    const int t = order_[i];
    area += areas_[t];
    weighted += areas_[t] * (corners_[t][0] + corners_[t][1] + corners_[t][2]) / 3;
    node.area_normal += areas_[t] * normals_[t];
  }
  node.area = area;
  node.centre = area > 0 ? Vector3d(weighted / area) : Vector3d((node.lower + node.upper) / 2);
  node.moment.setZero();
  for (int i = node.first; i < node.last; ++i) {
    const int t = order_[i];
    const Vector3d centroid = (corners_[t][0] + corners_[t][1] + corners_[t][2]) / 3;
    node.moment += areas_[t] * (centroid - node.centre) * normals_[t].transpose();
    for (const Vector3d& corner : corners_[t]) node.reach = std::max(node.reach, (corner - node.centre).norm());
  }
}

double winding_number(const Tree& tree, const Vector3d& p) {
  double sum = 0;
  for (int t = 0; t < tree.triangle_count(); ++t) {
    sum += solid_angle(p, tree.corner(t, 0), tree.corner(t, 1), tree.corner(t, 2));
  }
  return tree.far_number() + sum / (4 * std::numbers::pi);
}

// w(p) is the integral of f(x) . n / 4 pi with f(x) = (x - p) / |x - p|^3. Around a node's centre, at distance d, f is
// replaced by its first two Taylor terms. f is minus the gradient of 1/|x - p|, whose third derivatives are bounded
// by 3! / |x - p|^4, so the rest is at most reach^2 / 2 * 6 / (d - reach)^4 on the node: an error of
// area * 3 reach^2 / (4 pi (d - reach)^4). Nodes with reach <= opening * d are used, and their errors added up.
double Tree::winding_number_by_moments(const Vector3d& p, double opening, double& error) const {
  double sum = 0;
  error = 0;
  std::array<int, 128> stack;
  int size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    const Vector3d r = node.centre - p;
    const double d = r.norm();
    if (node.reach <= opening * d && d > 0) {
      const double d3 = d * d * d;
      const double gap2 = (d - node.reach) * (d - node.reach);
      sum += (r.dot(node.area_normal) + node.moment.trace() - 3 * r.dot(node.moment * r) / (d * d)) / d3;
      error += 3 * node.area * node.reach * node.reach / (4 * std::numbers::pi * gap2 * gap2);
    } else if (node.left >= 0) {
      stack[size++] = node.right;
      stack[size++] = node.left;
    } else {
      for (int i = node.first; i < node.last; ++i) {
        const auto& [a, b, c] = corners_[order_[i]];
        sum += solid_angle(p, a, b, c);
      }
    }
  }
  return sum / (4 * std::numbers::pi);
}

// The sum of area / d^2 over a mesh is about 4 pi per layer seen from p, so the errors add up to about
// 3 opening^2 / (1 - opening)^4 per layer; the first opening allows for two layers or so.
double winding_number(const Tree& tree, const Vector3d& p, double tolerance) {
  double opening = 0.3 * std::sqrt(tolerance);
  while (opening > 1e-3) {
    double error;
    const double sum = tree.winding_number_by_moments(p, opening, error);
    if (error <= tolerance) return tree.far_number() + sum;
    opening *= 0.6;
  }
  return winding_number(tree, p);
}

// A closed mesh has only integers, so the first tolerance decides.
bool is_inside(const Tree& tree, const Vector3d& p) {
  for (double tolerance : {0.2, 0.02, 0.002}) {
    const double estimate = winding_number(tree, p, tolerance);
    if (std::abs(estimate - 0.5) > tolerance) return estimate > 0.5;
  }
  return winding_number(tree, p) >= 0.5;
}

}  // namespace medial_vk::reference
