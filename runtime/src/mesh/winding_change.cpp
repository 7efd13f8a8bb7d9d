#include "mesh/winding_change.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
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
    int balance = 0;
    for (const std::uint32_t t : topology.triangles_of(edge)) balance += runs_upwards(mesh.triangles[t], ends) ? 1 : -1;
    if (balance == 0) continue;
    edges_.push_back({mesh.vertices[ends[0]], mesh.vertices[ends[1]], static_cast<double>(std::abs(balance))});
    too_many_ = edges_.size() > kMostEdges;
  }
}

double WindingChange::radius(const Point& p, double most) const {
  if (too_many_) return 0;
  if (edges_.empty()) return std::numeric_limits<double>::infinity();
  struct Seen {
    double distance, reach;  // how much of the edge counts
  };
  std::vector<Seen> seen;
  seen.reserve(edges_.size());
  double nearest = std::numeric_limits<double>::infinity();
  for (const OpenEdge& e : edges_) {
    const Point along = e.to - e.from, to_p = p - e.from;
    const double squared = dot(along, along);
    const double at = squared > 0 ? std::clamp(dot(to_p, along) / squared, 0.0, 1.0) : 0;
    const double distance = length(to_p - at * along);
    seen.push_back({distance, e.times * std::min(std::sqrt(squared), std::numbers::pi * distance)});
    nearest = std::min(nearest, distance);
  }
  constexpr int kHalvings = 8;
  double radius = nearest / 2;
  for (int i = 0; i < kHalvings; ++i, radius /= 2) {
    double slope = 0;
    for (const Seen& s : seen) slope += s.reach / ((s.distance - radius) * (s.distance - radius));
    if (radius * slope / (4 * std::numbers::pi) <= most) return radius;
  }
  return 0;
}

}  // namespace medial_vk
