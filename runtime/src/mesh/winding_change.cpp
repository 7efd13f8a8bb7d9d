#include "mesh/winding_change.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace medial_vk {
namespace {

/// A walk of the tree takes about as long as a sum over so many edges.
constexpr std::size_t kMostEdges = 4096;

}  // namespace

WindingChange::WindingChange(const Mesh& mesh, const MeshTopology& topology) {
  for (std::uint32_t edge = 0; edge < topology.edge_count() && !too_many_; ++edge) {
    const auto& ends = topology.ends(edge);
    const std::int64_t balance = balance_at(mesh, topology, edge);
    if (balance == 0) continue;
    edges_.push_back({mesh.vertices[ends[0]], mesh.vertices[ends[1]], std::abs(static_cast<double>(balance))});
    too_many_ = edges_.size() > kMostEdges;
  }
}

double WindingChange::radius(const Point& p, double most, double least) const {
  if (too_many_) return 0;
  if (edges_.empty()) return std::numeric_limits<double>::infinity();
  struct Seen {
    double distance, reach;  // how much of the edge counts
  };
  std::vector<Seen> seen;
  seen.reserve(edges_.size());
  double nearest = std::numeric_limits<double>::infinity(), slope_at_p = 0;
  for (const OpenEdge& e : edges_) {
    const Point along = e.to - e.from, to_p = p - e.from;
    const double squared = dot(along, along);
    const double at = squared > 0 ? std::clamp(dot(to_p, along) / squared, 0.0, 1.0) : 0;
    const double distance = length(to_p - at * along);
    seen.push_back({distance, e.times * std::min(std::sqrt(squared), std::numbers::pi * distance)});
    slope_at_p += seen.back().reach / std::max(distance * distance, 1e-300);
    nearest = std::min(nearest, distance);
  }
  // The slope within a radius is at least that at the point, so most triangles near open edges end here.
  for (double radius = std::min(nearest / 2, 4 * std::numbers::pi * most / slope_at_p); radius >= least; radius /= 2) {
    double slope = 0;
    for (const Seen& s : seen) slope += s.reach / ((s.distance - radius) * (s.distance - radius));
    if (radius * slope / (4 * std::numbers::pi) <= most) return radius;
  }
  return 0;
}

}  // namespace medial_vk
