#include "support/solids/extruded_polygon.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/queries.h"

namespace medial_vk::test {

using Eigen::Vector2d;
using Eigen::Vector3d;

// A ray to the right crosses the outline an odd number of times.
bool ExtrudedPolygon::base_contains(const Vector2d& p) const {
  bool inside = false;
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const Vector2d &a = base_[i], &b = base_[(i + 1) % base_.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

bool ExtrudedPolygon::contains(const Vector3d& p) const {
  return p.z() > 0 && p.z() < height_ && base_contains(p.head<2>());
}

Vector3d ExtrudedPolygon::nearest(const Vector3d& p) const {
  Vector3d best(p.x(), p.y(), p.z() < height_ / 2 ? 0 : height_);
  double least = (p - best).squaredNorm();
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const Vector2d a = base_[i], edge = base_[(i + 1) % base_.size()] - a;
    const double along = std::clamp((p.head<2>() - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    const Vector2d q = a + along * edge;
    const double squared = (p.head<2>() - q).squaredNorm();
    if (squared >= least) continue;
    least = squared;
    best = {q.x(), q.y(), p.z()};
  }
  return best;
}

ExtrudedPolygon::MedialPoint ExtrudedPolygon::medial_point_behind(const Vector3d& p) const {
  const Vector3d contact = nearest(p);
  const double distance = (contact - p).norm();
  const Vector3d away = (p - contact) / distance;
  // The ball touches its contact at distance + s; it has met another part as soon as the boundary is closer. Distances
  // of coordinates near 1 are accurate to a few 1e-16.
  const auto grows = [&](double s) {
    const Vector3d m = p + s * away;
    return contains(m) && (nearest(m) - m).norm() >= distance + s - 1e-13;
  };
  double low = 0, high = height_;  // no ball in the prism is wider
  for (int i = 0; i < 44; ++i) (grows((low + high) / 2) ? low : high) = (low + high) / 2;
  const Vector3d centre = p + low * away;
  // Slightly beyond, the other contact is the nearest.
  const Vector3d beyond = p + (low + 1e-7) * away;
  const Vector3d other = nearest(beyond);
  return {centre, distance + low, reference::half_angle(-away, (other - centre).normalized()), low};
}

std::vector<Vector3d> ExtrudedPolygon::boundary_samples(double step) const {
  constexpr double kInside = 1e-6;  // above rounding, far below any voxel
  std::vector<Vector3d> out;
  const auto middles = [&](double length) {
    std::vector<double> steps;
    const auto count = static_cast<int>(std::ceil(length / step));
    for (int i = 0; i < count; ++i) steps.push_back(length * (i + 0.5) / count);
    return steps;
  };
  for (std::size_t i = 0; i < base_.size(); ++i) {
    const Vector2d a = base_[i], edge = base_[(i + 1) % base_.size()] - a;
    const Vector2d along = edge.normalized(), inward(-along.y(), along.x());
    for (const double x : middles(edge.norm())) {
      const Vector2d q = a + x * along + kInside * inward;
      for (const double z : middles(height_)) out.emplace_back(q.x(), q.y(), z);
    }
  }
  Vector2d lower = base_[0], upper = base_[0];
  for (const Vector2d& p : base_) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  for (const double x : middles(upper.x() - lower.x())) {
    for (const double y : middles(upper.y() - lower.y())) {
      const Vector2d q = lower + Vector2d(x, y);
      if (!base_contains(q)) continue;
      out.emplace_back(q.x(), q.y(), kInside);
      out.emplace_back(q.x(), q.y(), height_ - kInside);
    }
  }
  return out;
}

}  // namespace medial_vk::test
