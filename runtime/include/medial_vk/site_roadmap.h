// The roadmap of greatest clearance between sites: the points of their surface as a graph, each link with a proved
// width, and widest paths on it (docs/theory.md, "Between sites").
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "medial_vk/progress.h"
#include "medial_vk/result.h"
#include "medial_vk/site_voronoi.h"

namespace medial_vk {

/// A straight line between two points of the surface in voxels that share a corner, an edge or a face.
struct RoadmapLink {
  std::array<std::uint32_t, 2> points = {};  ///< Of SiteVoronoi::points, ascending.
  double length = 0;                         ///< In input units, as all lengths here.
  double width = 0;  ///< No point of the line is nearer to a site, by proof: a ball of this radius passes.
};

/// A path from a place to another one. A ball of radius `width` around its points meets no site.
struct SitePath {
  static constexpr std::uint32_t kNoPoint = 0xffffffffu;

  std::vector<Point> line;            ///< From the first place to the last.
  std::vector<std::uint32_t> points;  ///< By point of the line: that of SiteVoronoi::points; kNoPoint of others.
  double width = 0;
  double length = 0;
};

struct SiteRoadmapOptions {
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// The graph. Copies share their data; calls may come from several threads at once.
class SiteRoadmap {
 public:
  /// Of the surface between these sites. Lines whose width cannot be proved to be positive are no links. Errors: those
  /// of find_site_voronoi() about sites, kOutOfMemory, kInterrupted.
  static Result<SiteRoadmap> build(std::span<const VoronoiSite> sites, const SiteVoronoi& voronoi,
                                   const SiteRoadmapOptions& options = {}, const ProgressCallback& progress = {},
                                   const std::stop_token& stop = {});

  const std::vector<RoadmapLink>& links() const;  ///< In the order of their points.
  const std::vector<std::uint32_t>& component_of_point() const;
  std::uint32_t components() const;

  /// Of the paths on the graph with the greatest width, the shortest, from and to any place. A path beside the graph
  /// may be wider. Lines join a place to points around it, and to a few places farther from the nearest site; if there
  /// is no path then, all points are tried. None: no such lines are found, or both ends are in different components.
  /// Errors: kUsage (a place that is not finite or beyond 1e75, inside of a solid or on a site), kOutOfMemory.
  Result<std::optional<SitePath>> widest_path(const Point& from, const Point& to) const;

 private:
  struct Impl;
  explicit SiteRoadmap(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

  std::shared_ptr<const Impl> impl_;
};

/// Tests the ends of a path before a roadmap is made. Errors: those of find_site_voronoi() about sites, and those of
/// widest_path() about ends, except for places within a few roundings of a site.
Status check_path_ends(std::span<const VoronoiSite> sites, const Point& from, const Point& to, unsigned threads = 0);

}  // namespace medial_vk
