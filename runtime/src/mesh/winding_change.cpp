#include "mesh/winding_change.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace medial_vk {
namespace {

/// Their 2,048 groups take about as many operations as a walk of the tree, with its hundreds of triangles.
constexpr std::size_t kMostEdges = 65536;
constexpr std::size_t kEdgesOfGroup = 32;

/// Groups may add this share of the change that is permitted, each of them a tenth of what earlier ones have left.
constexpr double kShareOfGroups = 0.3, kShareOfGroup = 0.1;

/// Reorders edges so that those of each group lie near each other: halves them along the longest side of the box of
/// their middles, at a whole number of groups, until one group is left.
template <class Edge>
void order_in_groups(std::span<Edge> edges) {
  const std::size_t groups = (edges.size() + kEdgesOfGroup - 1) / kEdgesOfGroup;
  if (groups < 2) return;
  const auto middle = [](const Edge& e) { return 0.5 * (e.from + e.to); };
  Point lower = middle(edges.front()), upper = lower;
  for (const Edge& e : edges) {
    lower = least(lower, middle(e));
    upper = greatest(upper, middle(e));
  }
  const Point sides = upper - lower;
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
  const std::size_t half = groups / 2 * kEdgesOfGroup;
  std::ranges::nth_element(edges, edges.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [&](const Edge& e) { return middle(e)[axis]; });
  order_in_groups(edges.first(half));
  order_in_groups(edges.subspan(half));
}

}  // namespace

WindingChange::WindingChange(const Mesh& mesh, const MeshTopology& topology) {
  for (std::uint32_t edge = 0; edge < topology.edge_count(); ++edge) {
    const auto& ends = topology.ends(edge);
    const std::int64_t balance = balance_at(mesh, topology, edge);
    if (balance == 0) continue;
    edges_.push_back({mesh.vertices[ends[0]], mesh.vertices[ends[1]], std::abs(static_cast<double>(balance))});
    too_many_ = edges_.size() > kMostEdges;
    if (too_many_) return;
  }
  order_in_groups(std::span(edges_));
  for (std::size_t i = 0; i < edges_.size(); i += kEdgesOfGroup)
    add_group(i, std::min(i + kEdgesOfGroup, edges_.size()));
}

void WindingChange::add_group(std::size_t first, std::size_t end) {
  Group group{first, end, edges_[first].from, edges_[first].from};
  for (std::size_t i = first; i < end; ++i) {
    const OpenEdge& e = edges_[i];
    group.lower = least(group.lower, least(e.from, e.to));
    group.upper = greatest(group.upper, greatest(e.from, e.to));
    group.length += e.times * length(e.to - e.from);
  }
  groups_.push_back(group);
}

double WindingChange::distance(const Point& p, const OpenEdge& e) {
  const Point along = e.to - e.from, to_p = p - e.from;
  const double squared = dot(along, along);
  const double at = squared > 0 ? std::clamp(dot(to_p, along) / squared, 0.0, 1.0) : 0;
  return length(to_p - at * along);
}

double WindingChange::distance(const Point& p, const Group& group) {
  return length(greatest(greatest(group.lower - p, p - group.upper), {0, 0, 0}));
}

double WindingChange::distance_to_edges(const Point& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Group& group : groups_) {
    if (distance(p, group) >= nearest) continue;
    for (std::size_t i = group.first; i < group.end; ++i) nearest = std::min(nearest, distance(p, edges_[i]));
  }
  return nearest;
}

double WindingChange::change_within(const Point& p, double radius, double most) const {
  const double steepest = 4 * std::numbers::pi * most / radius;
  double slope = 0, rest = kShareOfGroups * steepest;
  for (const Group& group : groups_) {
    // No edge of the group is nearer than its box, and none counts for more than its length.
    const double gap = distance(p, group) - radius;
    const double of_group = gap > 0 ? group.length / (gap * gap) : std::numeric_limits<double>::infinity();
    if (of_group <= kShareOfGroup * rest) {
      slope += of_group;
      rest -= of_group;
      continue;
    }
    for (std::size_t i = group.first; i < group.end; ++i) {
      const OpenEdge& e = edges_[i];
      const double away = distance(p, e), reach = std::min(length(e.to - e.from), std::numbers::pi * away);
      if (away <= radius) return std::numeric_limits<double>::infinity();
      slope += e.times * reach / ((away - radius) * (away - radius));
    }
    if (slope > steepest) return std::numeric_limits<double>::infinity();
  }
  return radius * slope / (4 * std::numbers::pi);
}

bool WindingChange::stays_within(const Point& p, double most, double radius) const {
  return edges_.empty() || (!too_many_ && change_within(p, radius, most) <= most);
}

double WindingChange::radius(const Point& p, double most, double least) const {
  if (too_many_) return 0;
  if (edges_.empty()) return std::numeric_limits<double>::infinity();
  // The change grows with the radius, so most triangles near open edges end here.
  if (change_within(p, least, most) > most) return 0;
  double radius = distance_to_edges(p) / 2;
  while (radius > least && change_within(p, radius, most) > most) radius /= 2;
  return std::max(radius, least);
}

}  // namespace medial_vk
