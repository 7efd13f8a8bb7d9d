// What the files of `medial-vk voronoi` are made from.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "medial_vk/site_roadmap.h"
#include "medial_vk/site_voronoi.h"

namespace medial_vk {

/// A site as it was given.
struct NamedSite {
  std::string name;            ///< Of a mesh, the stem of its file.
  std::string kind;            ///< "solid", "surface", "point", "segment" or "triangle".
  std::uint64_t elements = 0;  ///< Triangles of a mesh; else 1.
};

struct SiteRecord {
  std::vector<NamedSite> sites;
  std::vector<std::string> assumptions;  ///< Of readers and of the preparation, with the file.
  SiteVoronoiOptions options;
  SiteVoronoi voronoi;
  std::optional<SiteRoadmap> roadmap;
  bool path_was_sought = false;
  std::array<Point, 2> path_ends = {};
  std::optional<SitePath> path;
};

/// Voxels of one kind without a point, but without a proof that they need none.
struct VoxelsWithoutPoint {
  const char* name;  ///< Of SiteVoronoi: "undecided", "tied" or "overlapping".
  const std::vector<std::array<std::uint32_t, 3>>* voxels;
};

/// Of all kinds; they point into `voronoi`.
std::array<VoxelsWithoutPoint, 3> voxels_without_point(const SiteVoronoi& voronoi);

/// Numbers of one pair of sites: its pieces together.
struct SitePair {
  std::array<std::uint32_t, 2> sites = {};
  std::uint64_t pieces = 0, faces = 0;
  double area = 0, least_clearance = 0, greatest_clearance = 0;
};

/// Ascending by sites.
std::vector<SitePair> pairs_of(const SiteVoronoi& voronoi);

struct SiteCounts {
  std::uint64_t points = 0, on_curves = 0, meetings = 0;  ///< Points of three sites, and of four.
  double area = 0, least_clearance = 0, greatest_clearance = 0, greatest_error = 0;
};
SiteCounts counts_of(const SiteVoronoi& voronoi);

/// The corners of a face, each once: three or four.
std::vector<std::uint32_t> corners_of(const SiteFace& face);

/// The unit vector from a point to contact `i`.
Point spoke_of(const SitePoint& point, std::size_t i);

/// The piece of a face at each point, the first; -1 of points without a face.
std::vector<std::int32_t> piece_of_points(const SiteVoronoi& voronoi);

}  // namespace medial_vk
