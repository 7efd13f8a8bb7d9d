// Arrangements of sites in space, and their distances by other ways than those of the library's search.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"
#include "medial_vk/site_voronoi.h"

namespace medial_vk::test {

/// A prepared mesh as a site.
VoronoiSite site_of_mesh(Mesh mesh);
VoronoiSite site_of_point(const Point& p);
VoronoiSite site_of_segment(const Point& a, const Point& b);
VoronoiSite site_of_triangle(const Point& a, const Point& b, const Point& c);

struct SiteArrangement {
  std::string name;
  std::vector<VoronoiSite> sites;
};

/// Ten arrangements: lines, points, segments, triangles, boxes, balls, linked tori, mixed sites, open meshes, and
/// solids that overlap. Their meshes have some `detail` edges around.
std::vector<SiteArrangement> site_arrangements(std::uint32_t detail);

/// The elements of a site as triangles, those of points and segments with equal corners.
std::vector<std::array<Point, 3>> elements_of_site(const VoronoiSite& site);

/// The least distance of the plane of a triangle from the origin: of a polyhedron with corners on a sphere around it,
/// the radius of the ball inside.
double inner_radius(const Mesh& mesh);

/// The distance of p to a triangle by the least of the distances to its plane, where p is above it, its edges and its
/// corners; in long double.
long double distance_to_triangle(const Point& p, const std::array<Point, 3>& triangle);
/// The least of these distances to the elements of a site.
long double distance_to_site(const Point& p, const VoronoiSite& site);

}  // namespace medial_vk::test
