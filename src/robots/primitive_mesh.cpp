#include "robots/primitive_mesh.h"

#include <cmath>
#include <numbers>

namespace medial_vk {
namespace {

using std::numbers::pi;

Mesh make_box(const Point& size) {
  Mesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.push_back({(corner & 1 ? 0.5 : -0.5) * size[0], (corner & 2 ? 0.5 : -0.5) * size[1],
                             (corner & 4 ? 0.5 : -0.5) * size[2]});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A solid of revolution about z from the rings (radius, height), from the lowest to the highest, closed by flat lids
/// or by single points where the radius is 0.
class Revolution {
 public:
  void add_ring(double radius, double height) {
    if (radius == 0) {
      add_point(height);
      return;
    }
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (std::uint32_t i = 0; i < kCircleSides; ++i) {
      const double angle = 2 * pi * i / kCircleSides;
      mesh_.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
    }
    if (!rings_.empty()) join(rings_.back(), {first, kCircleSides});
    rings_.push_back({first, kCircleSides});
  }

  Mesh close() {
    for (const bool top : {false, true}) {
      const Ring ring = top ? rings_.back() : rings_.front();
      for (std::uint32_t i = 2; i < ring.size; ++i) {
        add_triangle(ring.first, ring.first + i - (top ? 1 : 0), ring.first + i - (top ? 0 : 1));
      }
    }
    return std::move(mesh_);
  }

 private:
  struct Ring {
    std::uint32_t first, size;
  };

  void add_point(double height) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    mesh_.vertices.push_back({0, 0, height});
    if (!rings_.empty()) join(rings_.back(), {first, 1});
    rings_.push_back({first, 1});
  }

  void join(const Ring& below, const Ring& above) {
    for (std::uint32_t i = 0; i < kCircleSides; ++i) {
      const std::uint32_t next = (i + 1) % kCircleSides;
      const std::uint32_t a = below.first + i % below.size, b = below.first + next % below.size;
      const std::uint32_t c = above.first + i % above.size, d = above.first + next % above.size;
      if (a != b) add_triangle(a, b, c);
      if (c != d) add_triangle(b, d, c);
    }
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh_.triangles.push_back({a, b, c}); }

  Mesh mesh_;
  std::vector<Ring> rings_;
};

/// Allowance for rounding, as a share of the radius: of sines and products, a few 2^-53 of it each, and of the sum with
/// half the length.
double room(const Geometry& geometry) { return 0x1p-48 + 0x1p-52 * geometry.size[1] / geometry.size[0]; }

}  // namespace

// Chords of a circle cut in n are at least cos(pi/n) of the radius from its centre. A facet of a sphere cut by n
// meridians and by rings a quarter turn / m apart lies, seen along the middle of its two meridians, on a chord of the
// ellipse with axes cos(pi/n) and 1; compression of one axis brings a chord no nearer than that factor times its
// distance cos(pi/4m) from the centre of the circle. With m = n/4 the two are equal.
double facet_share(GeometryKind kind) {
  static_assert(4 * kCapRings == kCircleSides);
  const double chord = std::cos(pi / kCircleSides);
  if (kind == GeometryKind::kCylinder) return 1 - chord;
  return kind == GeometryKind::kCapsule ? 1 - chord * chord : 0;
}

Mesh make_primitive(const Geometry& geometry, FacetSide side) {
  if (geometry.kind == GeometryKind::kBox) return make_box(geometry.size);
  const bool around = side == FacetSide::kCircumscribed;
  const bool is_sphere = geometry.kind == GeometryKind::kSphere;  // a capsule of length 0, with one equator
  const double share = facet_share(is_sphere ? GeometryKind::kCapsule : geometry.kind);
  const double radius = geometry.size[0] * (around ? (1 + room(geometry)) / (1 - share) : 1 - room(geometry));
  const double half = is_sphere ? 0 : 0.5 * geometry.size[1];
  Revolution mesh;
  if (geometry.kind == GeometryKind::kCylinder) {
    mesh.add_ring(radius, -half);
    mesh.add_ring(radius, half);
    return mesh.close();
  }
  for (int end : {-1, 1}) {
    for (std::uint32_t i = is_sphere && end > 0 ? 1 : 0; i <= kCapRings; ++i) {
      const double turn = 0.5 * pi * (end < 0 ? kCapRings - i : i) / kCapRings;
      const bool is_pole = end < 0 ? i == 0 : i == kCapRings;
      const double height = half + radius * std::sin(turn);
      mesh.add_ring(is_pole ? 0 : radius * std::cos(turn), end * height);
    }
  }
  return mesh.close();
}

double primitive_volume(const Geometry& geometry) {
  const Point& size = geometry.size;
  const double disc = pi * size[0] * size[0], ball = 4.0 / 3 * disc * size[0];
  switch (geometry.kind) {
    case GeometryKind::kBox:
      return size[0] * size[1] * size[2];
    case GeometryKind::kCylinder:
      return disc * size[1];
    case GeometryKind::kSphere:
      return ball;
    case GeometryKind::kCapsule:
      return ball + disc * size[1];
    case GeometryKind::kMesh:
      break;
  }
  return 0;
}

}  // namespace medial_vk
