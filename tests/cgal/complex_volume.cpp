#include "cgal/complex_volume.h"

#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <vector>

#include "ball_unions/unions/simplex_lists.h"

namespace medial_vk::test {
namespace {

using Real = boost::multiprecision::cpp_bin_float_quad;
using Vector = std::array<Real, 3>;

Vector operator-(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator+(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator*(const Real& s, const Vector& a) { return {s * a[0], s * a[1], s * a[2]}; }
Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real length(const Vector& a) { return sqrt(dot(a, a)); }
Real pi() { return boost::math::constants::pi<Real>(); }

struct Both {
  Real volume = 0, area = 0;
  void add(const Real& share, const Both& other) {
    volume += share * other.volume;
    area += share * other.area;
  }
};

struct Sphere {
  Vector centre;
  Real radius;
};

Both of_ball(const Real& r) { return {4 * pi() / 3 * r * r * r, 4 * pi() * r * r}; }

/// The cap that a plane at `height` above the centre cuts off a ball.
Both of_cap(const Real& r, const Real& height) {
  const Real rise = r - height;
  return {pi() * rise * rise * (3 * r - rise) / 3, 2 * pi() * r * rise};
}

/// The intersection of two balls, neither of which lies in the other.
Both of_lens(const Sphere& a, const Sphere& b) {
  const Real distance = length(b.centre - a.centre);
  const Real height = (distance + (a.radius - b.radius) * (a.radius + b.radius) / distance) / 2;
  Both sum = of_cap(a.radius, height);
  sum.add(1, of_cap(b.radius, distance - height));
  return sum;
}

/// The solid angle at p of the tetrahedron p, q, r, s, as a share of the sphere (van Oosterom and Strackee 1983).
Real corner_share(const Vector& p, const Vector& q, const Vector& r, const Vector& s) {
  const Vector a = q - p, b = r - p, c = s - p;
  const Real u = length(a), v = length(b), w = length(c);
  const Real below = u * v * w + dot(a, b) * w + dot(b, c) * u + dot(c, a) * v;
  return 2 * atan2(abs(dot(a, cross(b, c))), below) / (4 * pi());
}

/// The angle at the edge pq between r and s, as a share of the circle.
Real edge_share(const Vector& p, const Vector& q, const Vector& r, const Vector& s) {
  const Vector m = cross(q - p, r - p), n = cross(q - p, s - p);
  return atan2(length(cross(m, n)), dot(m, n)) / (2 * pi());
}

Real tetrahedron_volume(const Vector& p, const Vector& q, const Vector& r, const Vector& s) {
  return abs(dot(q - p, cross(r - p, s - p))) / 6;
}

/// A point that lies on all three spheres; false if there is none except by rounding.
bool find_apex(const Sphere& a, const Sphere& b, const Sphere& c, Vector& apex) {
  const Vector u = b.centre - a.centre, v = c.centre - a.centre, n = cross(u, v);
  const Real of_u = (dot(u, u) + (a.radius - b.radius) * (a.radius + b.radius)) / 2;
  const Real of_v = (dot(v, v) + (a.radius - c.radius) * (a.radius + c.radius)) / 2;
  const Real scale = 1 / dot(n, n);
  const Vector foot = (of_u * scale) * cross(v, n) + (of_v * scale) * cross(n, u);
  const Real height_squared = a.radius * a.radius - dot(foot, foot);
  if (height_squared <= 0) return false;
  apex = a.centre + foot + sqrt(height_squared * scale) * n;
  return true;
}

/// The intersection of three balls. The sum of this file also holds for the tetrahedron of the three and a fourth ball
/// of radius 0 on their spheres, and gives half of the volume.
Both of_triple(const Sphere& a, const Sphere& b, const Sphere& c) {
  Vector apex;
  if (!find_apex(a, b, c, apex)) return {};
  Both sum = {tetrahedron_volume(a.centre, b.centre, c.centre, apex), 0};
  const std::array<const Sphere*, 3> s = {&a, &b, &c};
  for (std::size_t k = 0; k < 3; ++k) {
    const Sphere &p = *s[k], &q = *s[(k + 1) % 3], &r = *s[(k + 2) % 3];
    sum.add(-corner_share(p.centre, q.centre, r.centre, apex), of_ball(p.radius));
    sum.add(edge_share(p.centre, q.centre, r.centre, apex), of_lens(p, q));
  }
  return {2 * sum.volume, 2 * sum.area};
}

class Measuring {
 public:
  Measuring(std::span<const Ball> balls, const DualComplex& complex, bool rounded_squares)
      : complex_(complex),
        corners_(complex.vertices.size(), Real(1)),
        edges_(complex.edges.size(), Real(1)),
        triangles_(complex.triangles.size(), Real(1)) {
    for (const auto& [c, r] : balls) {
      spheres_.push_back({{Real(c[0]), Real(c[1]), Real(c[2])}, rounded_squares ? sqrt(Real(r * r)) : Real(r)});
    }
  }

  Measures run() {
    for (const auto& t : complex_.tetrahedra) take_tetrahedron(t);
    for (std::size_t v = 0; v < corners_.size(); ++v) {
      sum_.add(corners_[v], of_ball(spheres_[complex_.vertices[v]].radius));
    }
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto& [a, b] = complex_.edges[e];
      sum_.add(-edges_[e], of_lens(spheres_[a], spheres_[b]));
    }
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      const auto& [a, b, c] = complex_.triangles[f];
      if (triangles_[f] != 0) sum_.add(triangles_[f], of_triple(spheres_[a], spheres_[b], spheres_[c]));
    }
    return {static_cast<double>(sum_.volume), static_cast<double>(sum_.area)};
  }

 private:
  /// Adds the volume of the tetrahedron and subtracts its shares of directions from its faces.
  void take_tetrahedron(const std::array<std::uint32_t, 4>& t) {
    const auto at = [&](std::size_t k) -> const Vector& { return spheres_[t[k]].centre; };
    sum_.volume += tetrahedron_volume(at(0), at(1), at(2), at(3));
    for (std::size_t k = 0; k < 4; ++k) {
      triangles_[index_in(complex_.triangles, face(t, k))] -= Real(0.5);
      corners_[index_in(complex_.vertices, t[k])] -=
          corner_share(at(k), at((k + 1) % 4), at((k + 2) % 4), at((k + 3) % 4));
      for (std::size_t j = k + 1; j < 4; ++j) {
        std::array<std::size_t, 2> others;
        for (std::size_t m = 0, n = 0; m < 4; ++m) {
          if (m != k && m != j) others[n++] = m;
        }
        edges_[index_in(complex_.edges, std::array{t[k], t[j]})] -=
            edge_share(at(k), at(j), at(others[0]), at(others[1]));
      }
    }
  }

  const DualComplex& complex_;
  std::vector<Sphere> spheres_;
  std::vector<Real> corners_, edges_, triangles_;  // remaining shares of directions
  Both sum_;
};

}  // namespace

Measures measure_by_complex(std::span<const Ball> balls, const DualComplex& complex, bool rounded_squares) {
  return Measuring(balls, complex, rounded_squares).run();
}

}  // namespace medial_vk::test
