#include "site_voronoi/faces.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

#include "base/disjoint_sets.h"
#include "base/voxel_order.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNoPoint = 0xffffffffu;

/// Which points are at the place of an earlier one.
std::vector<std::uint32_t> first_at_place(const std::vector<SitePoint>& points) {
  std::vector<std::uint32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return points[i].point; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && points[order[i]].point == points[order[i - 1]].point;
    first[order[i]] = is_same ? first[order[i - 1]] : order[i];
  }
  return first;
}

double area_of(const Point& a, const Point& b, const Point& c) { return 0.5 * length(cross(b - a, c - a)); }

/// Of two triangles beside the shorter diagonal.
double area_of(const SiteFace& face, const std::vector<SitePoint>& points) {
  std::array<Point, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = points[face.corners[i]].point;
  const Point across = p[2] - p[0], other = p[3] - p[1];
  if (dot(across, across) <= dot(other, other)) return area_of(p[0], p[1], p[2]) + area_of(p[0], p[2], p[3]);
  return area_of(p[0], p[1], p[3]) + area_of(p[1], p[2], p[3]);
}

class FaceMaker {
 public:
  FaceMaker(const std::vector<SitePoint>& of_voxels, const std::vector<std::uint32_t>& kept)
      : of_voxels_(of_voxels), kept_(kept) {}

  /// Of four points, three different ones at least.
  std::optional<SiteFace> face_around(const GridEdge& edge) const {
    constexpr std::array<std::array<std::uint32_t, 2>, 4> kBefore = {{{1, 1}, {0, 1}, {0, 0}, {1, 0}}};
    const std::size_t u = (edge.axis + 1) % 3, v = (edge.axis + 2) % 3;
    SiteFace face;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<std::uint32_t, 3> voxel = edge.voxel;
      if (voxel[u] < kBefore[i][0] || voxel[v] < kBefore[i][1]) return std::nullopt;
      voxel[u] -= kBefore[i][0];
      voxel[v] -= kBefore[i][1];
      face.corners[i] = point_in(voxel);
      if (face.corners[i] == kNoPoint) return std::nullopt;
    }
    std::array<std::uint32_t, 4> sorted = face.corners;
    std::ranges::sort(sorted);
    if (std::unique(sorted.begin(), sorted.end()) - sorted.begin() < 3) return std::nullopt;
    face.sites = edge.sites;
    if (face.sites[0] > face.sites[1]) {
      std::swap(face.sites[0], face.sites[1]);
      std::reverse(face.corners.begin(), face.corners.end());
    }
    return face;
  }

 private:
  std::uint32_t point_in(const std::array<std::uint32_t, 3>& voxel) const {
    const auto at = std::lower_bound(
        of_voxels_.begin(), of_voxels_.end(), voxel,
        [](const SitePoint& p, const std::array<std::uint32_t, 3>& v) { return is_earlier_voxel(p.voxel, v); });
    if (at == of_voxels_.end() || at->voxel != voxel) return kNoPoint;
    return kept_[static_cast<std::size_t>(at - of_voxels_.begin())];
  }

  const std::vector<SitePoint>& of_voxels_;
  const std::vector<std::uint32_t>& kept_;
};

/// Joins the faces of one pair that have a common point.
DisjointSets connected_faces(const std::vector<SiteFace>& faces) {
  struct Corner {
    std::array<std::uint32_t, 2> sites;
    std::uint32_t point, face;
  };
  std::vector<Corner> corners;
  corners.reserve(4 * faces.size());
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    for (const std::uint32_t point : faces[f].corners) corners.push_back({faces[f].sites, point, f});
  }
  std::ranges::sort(corners, [](const Corner& a, const Corner& b) {
    return std::tie(a.sites, a.point, a.face) < std::tie(b.sites, b.point, b.face);
  });
  DisjointSets sets(faces.size());
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Corner &a = corners[i - 1], &b = corners[i];
    if (a.sites == b.sites && a.point == b.point) sets.join(a.face, b.face);
  }
  return sets;
}

void make_pieces(SiteVoronoi& voronoi) {
  DisjointSets sets = connected_faces(voronoi.faces);
  for (std::uint32_t f = 0; f < voronoi.faces.size(); ++f) {
    SiteFace& face = voronoi.faces[f];
    const std::uint32_t first = sets.of(f);  // of the piece, at most f
    if (first == f) {
      face.piece = static_cast<std::uint32_t>(voronoi.pieces.size());
      voronoi.pieces.push_back({face.sites, 0, 0, std::numeric_limits<double>::infinity(), 0});
    } else {
      face.piece = voronoi.faces[first].piece;
    }
    SitePiece& piece = voronoi.pieces[face.piece];
    ++piece.faces;
    piece.area += area_of(face, voronoi.points);
    for (const std::uint32_t corner : face.corners) {
      piece.least_clearance = std::min(piece.least_clearance, voronoi.points[corner].distance);
      piece.greatest_clearance = std::max(piece.greatest_clearance, voronoi.points[corner].distance);
    }
  }
}

}  // namespace

void make_surface(std::vector<SitePoint> points, std::vector<GridEdge> edges, const LoopWatch& watch,
                  SiteVoronoi& voronoi) {
  std::ranges::sort(points, [](const SitePoint& a, const SitePoint& b) { return is_earlier_voxel(a.voxel, b.voxel); });
  watch.check();
  std::ranges::sort(edges, [](const GridEdge& a, const GridEdge& b) {
    return a.voxel != b.voxel ? is_earlier_voxel(a.voxel, b.voxel) : a.axis < b.axis;
  });
  watch.check();
  const std::vector<std::uint32_t> first = first_at_place(points);
  std::vector<std::uint32_t> kept(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (first[i] != i) {
      kept[i] = kept[first[i]];
      continue;
    }
    kept[i] = static_cast<std::uint32_t>(voronoi.points.size());
    voronoi.points.push_back(points[i]);
  }
  watch.check();
  const FaceMaker maker(points, kept);
  for (const GridEdge& edge : edges) {
    if (const std::optional<SiteFace> face = maker.face_around(edge)) voronoi.faces.push_back(*face);
  }
  watch.check();
  make_pieces(voronoi);
}

}  // namespace medial_vk
