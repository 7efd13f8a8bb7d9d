// The roadmap of greatest clearance between sites in the plane: the curves between them as a graph, each link with a
// proved width, and widest paths on it (docs/theory.md, "Between sites").
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "medial_vk/plane_axis.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// An arc of the curves, of the same number.
struct PlaneRoadmapLink {
  std::uint32_t arc = 0;
  double length = 0;  ///< In input units, as all lengths here.
  double width = 0;   ///< No point of the arc is nearer to a site, by proof: a disc of this radius passes.
};

/// A path from a place to another one. A disc of radius `width` around its points meets no site.
struct PlanePath {
  std::vector<PlanePoint> line;  ///< From the first place to the last.
  double width = 0;
  double length = 0;
};

struct PlaneRoadmapOptions {
  unsigned threads = 0;  ///< Of the host, 0: one per core. The result does not depend on it.
};

/// The graph. Copies share their data; calls may come from several threads at once.
class PlaneRoadmap {
 public:
  /// Of the curves that find_plane_voronoi() has found between these sites. Arcs whose width cannot be proved to be
  /// positive are no links. Errors: those of find_plane_voronoi() about sites, kInvalidMesh (a coordinate beyond 1e75),
  /// kOutOfMemory.
  static Result<PlaneRoadmap> build(const PlaneSites& sites, const PlaneAxis& curves,
                                    const PlaneRoadmapOptions& options = {});

  const std::vector<PlaneRoadmapLink>& links() const;  ///< In the order of arcs.
  const std::vector<std::uint32_t>& component_of_node() const;
  std::uint32_t components() const;

  /// Of the paths on the graph with the greatest width, the shortest, from and to any place; straight lines join a
  /// place to nodes, to the points of arcs that are nearest to it, and to a few places farther from the nearest site. A
  /// path beside the graph may be wider. Arcs are polylines in the path, whose width is that of the polyline, less than
  /// that of the arcs by a thousandth at most. None: no such lines are found, or both ends are in different components.
  /// Errors: kUsage (a place that is not finite or beyond 1e75, or on a site), kOutOfMemory.
  Result<std::optional<PlanePath>> widest_path(const PlanePoint& from, const PlanePoint& to) const;

 private:
  struct Impl;
  explicit PlaneRoadmap(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

  std::shared_ptr<const Impl> impl_;
};

}  // namespace medial_vk
