// The salient part of a Voronoi diagram of sites in the plane: nodes, and the arcs between them.
#pragma once

#include <vector>

#include "plane/diagram/leaf_diagram.h"

namespace medial_vk::plane {

enum class NodeKind : std::uint8_t {
  kMeeting,    ///< Equally far from three contacts or more.
  kCorner,     ///< A corner of the boundary, of radius 0.
  kThreshold,  ///< An arc ends where it is no longer salient.
  kBorder      ///< An arc leaves the square that was searched.
};

struct DiagramNode {
  Circle circle;
  double object_angle = 0;
  NodeKind kind = NodeKind::kMeeting;
};

/// A part of a bisector, from t[0] at nodes[0] to t[1] at nodes[1], with t[0] < t[1].
struct DiagramArc {
  ContactPair contacts;
  Bisector curve;
  std::array<std::uint32_t, 2> nodes = {};
  std::array<double, 2> t = {};
};

struct Diagram {
  std::vector<DiagramNode> nodes;
  std::vector<DiagramArc> arcs;
  std::size_t cells = 0;
  /// Of the largest cell in which sites were taken to be equally far; 0 if there is none.
  double clustered = 0;
};

/// Throws std::bad_alloc and LoopStopped.
Diagram find_diagram(const SiteSet& sites, const DiagramQuery& query, LoopWatch& watch);

}  // namespace medial_vk::plane
