#include "output/site_files/site_record.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace medial_vk {

std::array<VoxelsWithoutPoint, 3> voxels_without_point(const SiteVoronoi& voronoi) {
  return {{{"undecided", &voronoi.undecided}, {"tied", &voronoi.tied}, {"overlapping", &voronoi.overlapping}}};
}

std::vector<SitePair> pairs_of(const SiteVoronoi& voronoi) {
  std::map<std::array<std::uint32_t, 2>, SitePair> pairs;
  for (const SitePiece& piece : voronoi.pieces) {
    const bool is_first = !pairs.contains(piece.sites);
    SitePair& pair = pairs[piece.sites];
    pair.sites = piece.sites;
    ++pair.pieces;
    pair.faces += piece.faces;
    pair.area += piece.area;
    pair.least_clearance = is_first ? piece.least_clearance : std::min(pair.least_clearance, piece.least_clearance);
    pair.greatest_clearance = std::max(pair.greatest_clearance, piece.greatest_clearance);
  }
  std::vector<SitePair> sorted;
  sorted.reserve(pairs.size());
  for (const auto& [sites, pair] : pairs) sorted.push_back(pair);
  return sorted;
}

SiteCounts counts_of(const SiteVoronoi& voronoi) {
  SiteCounts counts;
  counts.points = voronoi.points.size();
  counts.least_clearance = voronoi.points.empty() ? 0 : std::numeric_limits<double>::infinity();
  for (const SitePoint& p : voronoi.points) {
    counts.on_curves += p.count == 3 ? 1 : 0;
    counts.meetings += p.count > 3 ? 1 : 0;
    counts.least_clearance = std::min(counts.least_clearance, p.distance);
    counts.greatest_clearance = std::max(counts.greatest_clearance, p.distance);
    counts.greatest_error = std::max(counts.greatest_error, p.error);
  }
  for (const SitePiece& piece : voronoi.pieces) counts.area += piece.area;
  return counts;
}

std::vector<std::uint32_t> corners_of(const SiteFace& face) {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t corner : face.corners) {
    if (std::ranges::find(corners, corner) == corners.end()) corners.push_back(corner);
  }
  return corners;
}

Point spoke_of(const SitePoint& point, std::size_t i) {
  Point spoke;
  for (std::size_t k = 0; k < 3; ++k) spoke[k] = point.contacts[i][k] - point.point[k];
  const double length = std::hypot(spoke[0], spoke[1], spoke[2]);
  for (double& x : spoke) x = length > 0 ? x / length : 0;
  return spoke;
}

std::vector<std::int32_t> piece_of_points(const SiteVoronoi& voronoi) {
  std::vector<std::int32_t> pieces(voronoi.points.size(), -1);
  for (const SiteFace& face : voronoi.faces) {
    for (const std::uint32_t corner : face.corners) {
      if (pieces[corner] < 0) pieces[corner] = static_cast<std::int32_t>(face.piece);
    }
  }
  return pieces;
}

}  // namespace medial_vk
