#include "cpu_reference/ball_union.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace medial_vk::reference {
namespace {

constexpr double kPi = std::numbers::pi;

struct Disk {
  double x, y, radius;
};

/// The interval of angles [from, to] of the circle of `disk` that `other` covers, with `from` in [-pi, pi); no value if
/// it covers none, and the whole circle if it covers all.
std::optional<std::pair<double, double>> covered(const Disk& disk, const Disk& other, bool other_is_first) {
  const double dx = other.x - disk.x, dy = other.y - disk.y, distance = std::hypot(dx, dy);
  const bool same = distance == 0 && disk.radius == other.radius;
  if (same ? other_is_first : distance + disk.radius <= other.radius) return {{-kPi, kPi}};
  if (same || distance >= disk.radius + other.radius || distance + other.radius <= disk.radius) return {};
  const double cosine =
      (distance * distance + disk.radius * disk.radius - other.radius * other.radius) / (2 * distance * disk.radius);
  const double middle = std::atan2(dy, dx), half = std::acos(std::clamp(cosine, -1.0, 1.0));
  return {{middle - half, middle + half}};
}

/// Green's theorem along the circle of a disk: the integral of (x dy - y dx) / 2.
double rim(const Disk& disk, double from, double to) {
  return 0.5 * disk.radius *
         (disk.radius * (to - from) + disk.x * (std::sin(to) - std::sin(from)) -
          disk.y * (std::cos(to) - std::cos(from)));
}

double union_area(const std::vector<Disk>& disks) {
  double area = 0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    std::vector<std::pair<double, double>> arcs;
    for (std::size_t j = 0; j < disks.size(); ++j) {
      if (j == i) continue;
      const auto arc = covered(disks[i], disks[j], j < i);
      if (!arc) continue;
      const double from = std::remainder(arc->first, 2 * kPi), to = from + (arc->second - arc->first);
      arcs.emplace_back(from, std::min(to, kPi));
      if (to > kPi) arcs.emplace_back(-kPi, to - 2 * kPi);
    }
    std::sort(arcs.begin(), arcs.end());
    double reached = -kPi;
    for (const auto& [from, to] : arcs) {
      if (from > reached) area += rim(disks[i], reached, from);
      reached = std::max(reached, to);
    }
    if (reached < kPi) area += rim(disks[i], reached, kPi);
  }
  return area;
}

double slice(const std::vector<UnionBall>& spheres, double z) {
  std::vector<Disk> disks;
  for (const UnionBall& sphere : spheres) {
    const double height = z - sphere.centre.z();
    const double squared = (sphere.radius - height) * (sphere.radius + height);
    if (squared > 0) disks.push_back({sphere.centre.x(), sphere.centre.y(), std::sqrt(squared)});
  }
  return union_area(disks);
}

struct Circle {
  Eigen::Vector3d centre, normal;
  double radius;
};

std::optional<Circle> circle_of(const UnionBall& a, const UnionBall& b) {
  const Eigen::Vector3d between = b.centre - a.centre;
  const double distance = between.norm();
  if (distance == 0) return {};
  const double along = (distance * distance + a.radius * a.radius - b.radius * b.radius) / (2 * distance);
  const double squared = a.radius * a.radius - along * along;
  if (squared <= 0) return {};
  const Eigen::Vector3d normal = between / distance;
  return Circle{a.centre + along * normal, normal, std::sqrt(squared)};
}

void add_points(const Circle& circle, const UnionBall& sphere, std::vector<double>& heights) {
  const Eigen::Vector3d towards = sphere.centre - circle.centre;
  const Eigen::Vector3d in_plane = towards - towards.dot(circle.normal) * circle.normal;
  const double reach = in_plane.norm();
  if (reach == 0) return;
  const double offset =
      (circle.radius * circle.radius + towards.squaredNorm() - sphere.radius * sphere.radius) / (2 * reach);
  const double squared = circle.radius * circle.radius - offset * offset;
  if (squared < 0) return;
  const Eigen::Vector3d u = in_plane / reach, v = circle.normal.cross(u);
  for (const double side : {-1.0, 1.0}) {
    heights.push_back((circle.centre + offset * u + side * std::sqrt(squared) * v).z());
  }
}

/// The heights at which slices change shape, ascending.
std::vector<double> critical_heights(const std::vector<UnionBall>& spheres) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    for (const double side : {-1.0, 1.0}) heights.push_back(spheres[i].centre.z() + side * spheres[i].radius);
    for (std::size_t j = i + 1; j < spheres.size(); ++j) {
      const auto circle = circle_of(spheres[i], spheres[j]);
      if (!circle) continue;
      const double rise = circle->radius * std::hypot(circle->normal.x(), circle->normal.y());
      for (const double side : {-1.0, 1.0}) heights.push_back(circle->centre.z() + side * rise);
      for (std::size_t k = j + 1; k < spheres.size(); ++k) add_points(*circle, spheres[k], heights);
    }
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

/// Double exponential quadrature (H. Takahasi, M. Mori, 1974) with step 1/16; beyond |t| = 3.2 the weights are below
/// 1e-15 of the interval.
template <class Function>
double integrate(double from, double to, const Function& f) {
  const double half = 0.5 * (to - from), step = 1.0 / 16;
  double sum = 0;
  for (int n = -51; n <= 51; ++n) {
    const double t = step * n, u = 0.5 * kPi * std::sinh(t);
    const double weight = 0.5 * kPi * std::cosh(t) / (std::cosh(u) * std::cosh(u));
    // Measured from the nearer end, so that no digits are lost there: 1 - tanh(u) = 2 / (1 + exp(2 u)).
    const double gap = half * 2 / (1 + std::exp(2 * std::fabs(u)));
    sum += weight * f(t < 0 ? from + gap : to - gap);
  }
  return half * step * sum;
}

}  // namespace

double union_volume_by_slices(const std::vector<UnionBall>& spheres) {
  const std::vector<double> heights = critical_heights(spheres);
  double volume = 0;
  for (std::size_t k = 1; k < heights.size(); ++k) {
    if (heights[k] > heights[k - 1]) {
      volume += integrate(heights[k - 1], heights[k], [&](double z) { return slice(spheres, z); });
    }
  }
  return volume;
}

}  // namespace medial_vk::reference
