#include "support/site_voronoi/arrangements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "medial_vk/prepare.h"
#include "support/solids/solids.h"

namespace medial_vk::test {
namespace {

using Long = std::array<long double, 3>;

Long minus(const Point& a, const Point& b) {
  return {static_cast<long double>(a[0]) - b[0], static_cast<long double>(a[1]) - b[1],
          static_cast<long double>(a[2]) - b[2]};
}
long double product(const Long& a, const Long& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Long across(const Long& a, const Long& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

long double distance_to_edge(const Point& p, const Point& a, const Point& b) {
  const Long edge = minus(b, a), from_a = minus(p, a);
  const long double square = product(edge, edge);
  const long double t = square > 0 ? std::clamp(product(from_a, edge) / square, 0.0L, 1.0L) : 0.0L;
  Long rest;
  for (std::size_t k = 0; k < 3; ++k) rest[k] = from_a[k] - t * edge[k];
  return std::sqrt(product(rest, rest));
}

class Random {
 public:
  explicit Random(std::uint32_t seed) : generator_(seed) {}

  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  Point in_cube(double half) {
    Point p;
    for (double& x : p) x = between(-half, half);
    return p;
  }

 private:
  std::mt19937 generator_;
};

Mesh turned(Mesh mesh, const Point& axis, double angle, const Point& offset) {
  rotate(mesh, axis, angle);
  return moved(std::move(mesh), offset);
}

/// The triangles of a mesh whose corners are all at or below a height.
Mesh below(const Mesh& mesh, double height) {
  Mesh part;
  part.vertices = mesh.vertices;
  for (const Triangle& t : mesh.triangles) {
    const bool is_below = std::ranges::all_of(t, [&](std::uint32_t v) { return mesh.vertices[v][2] <= height; });
    if (is_below) part.triangles.push_back(t);
  }
  return part;
}

std::vector<VoronoiSite> random_points(std::uint32_t count) {
  Random random(33);
  std::vector<VoronoiSite> sites;
  for (std::uint32_t i = 0; i < count; ++i) sites.push_back(site_of_point(random.in_cube(1)));
  return sites;
}

std::vector<VoronoiSite> random_segments(std::uint32_t count) {
  Random random(34);
  std::vector<VoronoiSite> sites;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point a = random.in_cube(1);
    const Point b = random.in_cube(1);
    sites.push_back(site_of_segment(a, b));
  }
  return sites;
}

std::vector<VoronoiSite> random_triangles(std::uint32_t count) {
  Random random(35);
  std::vector<VoronoiSite> sites;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point middle = random.in_cube(1);
    std::array<Point, 3> corners;
    for (Point& corner : corners) {
      const Point off = random.in_cube(0.4);
      for (std::size_t k = 0; k < 3; ++k) corner[k] = middle[k] + off[k];
    }
    sites.push_back(site_of_triangle(corners[0], corners[1], corners[2]));
  }
  return sites;
}

std::vector<VoronoiSite> mixed_sites(std::uint32_t detail) {
  std::vector<VoronoiSite> sites;
  sites.push_back(site_of_mesh(make_torus(1, 0.3, detail / 2, detail)));
  sites.push_back(site_of_mesh(turned(make_box({0.6, 0.5, 0.4}), {1, 2, 3}, 0.7, {1.2, 1.1, 0.6})));
  sites.push_back(site_of_segment({0.05, 0.02, -1.2}, {-0.1, 0.04, 1.1}));
  sites.push_back(site_of_point({-1.3, 0.9, 0.8}));
  sites.push_back(site_of_triangle({-1.5, -1.4, 0.6}, {0.2, -1.6, 1.1}, {-0.6, -0.3, 1.4}));
  // A site of two parts.
  VoronoiSite pair = site_of_point({0.4, -1.9, -0.7});
  pair.segments.push_back({Point{1.2, -1.2, -0.9}, Point{1.7, 0.1, -1.1}});
  sites.push_back(pair);
  return sites;
}

}  // namespace

VoronoiSite site_of_mesh(Mesh mesh) {
  Result<PreparedMesh> prepared = prepare_mesh(std::move(mesh));
  if (!prepared) throw std::runtime_error(prepared.error().message);
  Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value());
  if (!indexed) throw std::runtime_error(indexed.error().message);
  VoronoiSite site;
  site.mesh = std::move(indexed).value();
  return site;
}

VoronoiSite site_of_point(const Point& p) {
  VoronoiSite site;
  site.points = {p};
  return site;
}

VoronoiSite site_of_segment(const Point& a, const Point& b) {
  VoronoiSite site;
  site.segments.push_back({a, b});
  return site;
}

VoronoiSite site_of_triangle(const Point& a, const Point& b, const Point& c) {
  VoronoiSite site;
  site.triangles.push_back({a, b, c});
  return site;
}

std::vector<SiteArrangement> site_arrangements(std::uint32_t detail) {
  const std::uint32_t triangles = detail * detail / 2;
  std::vector<SiteArrangement> all;
  all.push_back({"three lines",
                 {site_of_segment({-1, -0.3, -0.3}, {1, -0.3, -0.3}), site_of_segment({0.3, -1, 0.3}, {0.3, 1, 0.3}),
                  site_of_segment({-0.3, 0.4, -1}, {-0.3, 0.4, 1})}});
  all.push_back({"40 points", random_points(40)});
  all.push_back({"12 segments", random_segments(12)});
  all.push_back({"10 triangles", random_triangles(10)});
  all.push_back(
      {"three boxes",
       {site_of_mesh(make_box({1, 1, 1})), site_of_mesh(turned(make_box({1, 2, 0.5}), {1, 1, 2}, 0.6, {2, 0.3, 0.2})),
        site_of_mesh(moved(make_box({3, 0.2, 2}), {0, -1, -0.4}))}});
  all.push_back({"five balls", {}});
  for (int i = 0; i < 5; ++i) {
    all.back().sites.push_back(
        site_of_mesh(moved(make_sphere(0.3 + 0.05 * i, triangles), {1.1 * i, 0.7 * (i % 2), 0.3 * i})));
  }
  all.push_back({"linked tori",
                 {site_of_mesh(make_torus(1, 0.3, detail / 2, detail)),
                  site_of_mesh(turned(make_torus(1, 0.25, detail / 2, detail), {1, 0.1, 0}, 1.5, {1, 0.05, 0.02}))}});
  all.push_back({"mixed sites", mixed_sites(detail)});
  const Mesh bowl = below(make_sphere(1, triangles), 0.3);
  all.push_back({"ball in a bowl, under a plate",
                 {site_of_mesh(bowl), site_of_mesh(moved(make_sphere(0.4, triangles), {0.1, 0.05, -0.2})),
                  site_of_triangle({-1, -1, 0.9}, {1.5, -0.6, 1.1}, {-0.2, 1.6, 1})}});
  all.push_back({"boxes that overlap, and a point",
                 {site_of_mesh(make_box({1, 1, 1})), site_of_mesh(moved(make_box({1, 0.7, 1.2}), {0.6, 0.3, 0.2})),
                  site_of_point({0.4, -0.8, 0.7})}});
  return all;
}

std::vector<std::array<Point, 3>> elements_of_site(const VoronoiSite& site) {
  std::vector<std::array<Point, 3>> elements = site.triangles;
  if (site.mesh) {
    const Mesh& mesh = site.mesh->prepared().mesh;
    for (const auto& [a, b, c] : mesh.triangles) {
      elements.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    }
  }
  for (const auto& [a, b] : site.segments) elements.push_back({a, b, b});
  for (const Point& p : site.points) elements.push_back({p, p, p});
  return elements;
}

double inner_radius(const Mesh& mesh) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point &first = mesh.vertices[a], &second = mesh.vertices[b], &third = mesh.vertices[c];
    const Long normal = across(minus(second, first), minus(third, first));
    least = std::min(least, std::fabs(product(normal, minus(first, {0, 0, 0}))) / std::sqrt(product(normal, normal)));
  }
  return static_cast<double>(least);
}

long double distance_to_triangle(const Point& p, const std::array<Point, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  long double least = std::min({distance_to_edge(p, a, b), distance_to_edge(p, b, c), distance_to_edge(p, c, a)});
  const Long normal = across(minus(b, a), minus(c, a));
  const long double square = product(normal, normal);
  if (!(square > 0)) return least;
  const std::array<const Point*, 4> ring = {&a, &b, &c, &a};
  for (std::size_t i = 0; i < 3; ++i) {
    if (product(across(minus(*ring[i + 1], *ring[i]), minus(p, *ring[i])), normal) < 0) return least;
  }
  return std::min(least, std::fabs(product(minus(p, a), normal)) / std::sqrt(square));
}

long double distance_to_site(const Point& p, const VoronoiSite& site) {
  long double least = std::numeric_limits<long double>::infinity();
  for (const auto& element : elements_of_site(site)) least = std::min(least, distance_to_triangle(p, element));
  return least;
}

}  // namespace medial_vk::test
