#include "output/site_shapes/site_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace medial_vk {
namespace {

using Eigen::Vector3d;

constexpr double kThickness = 0.006;  // of segments and points, as a share of the diagonal of the box
constexpr double kSpeck = 0.02;       // of that

Vector3d vector_of(const Point& p) { return Vector3d(p.data()); }
Point point_of(const Vector3d& v) { return {v[0], v[1], v[2]}; }

/// Triangles that stand for sites of any kind.
class SitesMesh {
 public:
  explicit SitesMesh(const SiteGrid& grid) : radius_(kThickness * diagonal_of(grid)) {}

  void mark_corners(const SiteGrid& grid) {
    const Point upper = grid.corner(grid.size);
    for (unsigned i = 0; i < 8; ++i) {
      Point corner = grid.origin;
      for (std::size_t k = 0; k < 3; ++k) corner[k] = ((i >> k) & 1u) != 0 ? upper[k] : corner[k];
      const Point beside = {corner[0] + kSpeck * radius_, corner[1], corner[2]};
      triangle(corner, beside, {corner[0], corner[1] + kSpeck * radius_, corner[2]});
    }
  }

  void add(const VoronoiSite& site) {
    if (site.mesh) {
      const Mesh& other = site.mesh->prepared().mesh;
      for (const auto& [a, b, c] : other.triangles) triangle(other.vertices[a], other.vertices[b], other.vertices[c]);
    }
    for (const auto& [a, b, c] : site.triangles) triangle(a, b, c);
    for (const auto& [a, b] : site.segments) spindle(vector_of(a), vector_of(b));
    for (const Point& p : site.points) {
      const Vector3d up(0, 0, 2 * radius_);
      spindle(vector_of(p) - up, vector_of(p) + up);
    }
  }

  Mesh take() { return std::move(mesh_); }

 private:
  void triangle(const Point& a, const Point& b, const Point& c) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.insert(mesh_.vertices.end(), {a, b, c});
    mesh_.triangles.push_back({first, first + 1, first + 2});
  }

  /// A prism with six sides and pointed ends.
  void spindle(const Vector3d& a, const Vector3d& b) {
    constexpr int kSides = 6;
    const Vector3d along = b - a;
    if (!(along.norm() > 0)) return;
    const Vector3d u = along.unitOrthogonal(), v = along.normalized().cross(u);
    const Vector3d inset = std::min(radius_, 0.4 * along.norm()) * along.normalized();
    const auto ring = [&](int i, const Vector3d& middle) {
      const double angle = 2 * std::numbers::pi * i / kSides;
      return Vector3d(middle + radius_ * (std::cos(angle) * u + std::sin(angle) * v));
    };
    for (int i = 0; i < kSides; ++i) {
      const Point low = point_of(ring(i, a + inset)), next_low = point_of(ring(i + 1, a + inset));
      const Point high = point_of(ring(i, b - inset)), next_high = point_of(ring(i + 1, b - inset));
      triangle(point_of(a), next_low, low);
      triangle(low, next_low, next_high);
      triangle(low, next_high, high);
      triangle(point_of(b), high, next_high);
    }
  }

  Mesh mesh_;
  double radius_ = 0;
};

}  // namespace

Mesh mesh_of_sites(const SiteGrid& grid, std::span<const VoronoiSite> sites, BoxCorners corners) {
  SitesMesh mesh(grid);
  if (corners == BoxCorners::kMarked) mesh.mark_corners(grid);
  for (const VoronoiSite& site : sites) mesh.add(site);
  return mesh.take();
}

double diagonal_of(const SiteGrid& grid) { return (vector_of(grid.corner(grid.size)) - vector_of(grid.origin)).norm(); }

}  // namespace medial_vk
