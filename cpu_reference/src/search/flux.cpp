// Spiral samples, outward flux, retraction: Sections 2.3.1, 2.3.2 and Algorithm 1.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {

using Eigen::Vector3d;

// Latitudes h_k divide the axis evenly; the longitude advances by 3.6 / sqrt(N (1 - h_k^2)), so that neighbours on a
// turn are as far apart as neighbouring turns (Saff and Kuijlaars 1997, after Rakhmanov, Saff and Zhou 1994).
std::vector<Vector3d> spiral_points(int n) {
  std::vector<Vector3d> points;
  points.reserve(n);
  double longitude = 0;
  for (int k = 0; k < n; ++k) {
    const bool pole = k == 0 || k == n - 1;
    const double h = n > 1 ? -1 + 2.0 * k / (n - 1) : -1;
    const double across = pole ? 0.0 : std::sqrt(1 - h * h);
    longitude = pole ? 0.0 : longitude + 3.6 / (std::sqrt(static_cast<double>(n)) * across);
    points.emplace_back(across * std::cos(longitude), across * std::sin(longitude), h);
  }
  return points;
}

Vector3d opposite(const Vector3d& centre, const Vector3d& p, const Vector3d& direction) {
  return p - 2 * (p - centre).dot(direction) * direction;  // tangent: p itself, as in Definition 2.3
}

Flux outward_flux(const Tree& tree, const Vector3d& centre, double radius, const std::vector<Vector3d>& directions,
                  double same) {
  return outward_flux([&](const Vector3d& p) { return tree.closest(p); }, centre, radius, directions, same);
}

Flux outward_flux(const ClosestFunction& closest, const Vector3d& centre, double radius,
                  const std::vector<Vector3d>& directions, double same) {
  Flux flux;
  flux.samples = static_cast<int>(directions.size());
  for (const Vector3d& normal : directions) {
    const Vector3d p = centre + radius * normal;
    const Closest nearest = closest(p);
    const Vector3d gradient = direction_to(p, nearest);
    flux.greatest_distance = std::max(flux.greatest_distance, nearest.distance);
    if (nearest.feature != Feature::kFace) {
      const Vector3d q = opposite(centre, p, gradient);
      if ((direction_to(q, closest(q)) - gradient).norm() <= same) {
        ++flux.fans;
        continue;
      }
    }
    flux.sum += gradient.dot(normal);
  }
  if (flux.fans < flux.samples) flux.average = flux.sum / (flux.samples - flux.fans);
  return flux;
}

// B(m) != B(p) is tested for the computed points. On the segment B(p) stays the same point up to rounding, so a
// difference above 1e-9 of the box is a different contact. The case "m is equidistant from two points" needs no branch:
// the tree returns one of them and the interval still shrinks around m.
Retraction retract(const Tree& tree, const Vector3d& p, const Vector3d& q, double epsilon) {
  const double same = 1e-9 * tree.longest_side();
  return retract([&](const Vector3d& x) { return tree.closest(x); }, p, q, epsilon, same);
}

Retraction retract(const ClosestFunction& closest, Vector3d p, Vector3d q, double epsilon, double same) {
  Closest at_p = closest(p), at_q = closest(q);
  while ((p - q).norm() > epsilon) {
    const Vector3d m = (p + q) / 2;
    const Closest at_m = closest(m);
    if ((at_m.point - at_p.point).norm() > same) {
      q = m;
      at_q = at_m;
    } else {
      p = m;
      at_p = at_m;
    }
  }
  return {p, q, at_p.distance, direction_to(p, at_p), direction_to(q, at_q)};
}

double half_angle(const Vector3d& a, const Vector3d& b) { return std::atan2((a - b).norm(), (a + b).norm()); }

}  // namespace medial_vk::reference
