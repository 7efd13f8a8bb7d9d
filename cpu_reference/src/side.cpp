#include "side.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <tuple>

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

/// One number per place: vertices at the same coordinates are the same.
std::vector<int> places(const Mesh& mesh) {
  const auto key = [&](int v) {
    const Vector3d& p = mesh.vertices[v];
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  std::vector<int> order(mesh.vertices.size()), place(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
  }
  return place;
}

/// Edges whose triangles' directions do not cancel, each as often as they fail to.
std::map<std::pair<int, int>, int> open_edges(const Mesh& mesh) {
  const std::vector<int> place = places(mesh);
  std::map<std::pair<int, int>, int> net;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = place[t[k]], b = place[t[(k + 1) % 3]];
      if (a < b) ++net[{a, b}];
      if (b < a) --net[{b, a}];
    }
  }
  std::erase_if(net, [](const auto& edge) { return edge.second == 0; });
  return net;
}

}  // namespace

Sides::Sides(const Mesh& mesh, const Tree& tree) : mesh_(mesh), tree_(tree) {
  if (mesh.closed) return;
  Mesh rim;
  rim.vertices = mesh.vertices;
  for (const auto& [edge, times] : open_edges(mesh)) {
    rim.triangles.emplace_back(edge.first, edge.second, edge.second);
    rim_length_ += std::abs(times) * (mesh.vertices[edge.first] - mesh.vertices[edge.second]).norm();
  }
  if (!rim.triangles.empty()) rim_ = std::make_unique<Tree>(rim);
}

// Where there is no boundary point the winding number is smooth, and its gradient is that of the solid angle of a
// surface spanning the open edges: by the law of Biot and Savart at most (length of the rim) / (4 pi d^2), d the
// distance to the rim. A closed mesh has no rim, and the winding number is constant. `way` is the length of a segment
// without boundary points from a point at distance `rim_gap` from the rim.
double Sides::change(double way, double rim_gap) const {
  if (!rim_) return 0;
  const double gap = rim_gap - way;
  return gap > 0 ? way * rim_length_ / (4 * std::numbers::pi * gap * gap) : std::numeric_limits<double>::infinity();
}

Sides::Known Sides::ask(const Vector3d& p, double empty, double tolerance) const {
  const double winding = winding_number(tree_, p, tolerance);
  const double rim_gap = rim_ ? rim_->closest(p).distance : 0;
  Known known = {p, empty, rim_gap, winding - tolerance, winding + tolerance};
  memory_[next_++ % memory_.size()] = known;
  return known;
}

/// The tightest bounds at p that follow from a remembered point whose empty ball holds p.
Sides::Known Sides::recall(const Vector3d& p) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Known best = {p, 0, 0, -kInfinity, kInfinity};
  for (const Known& known : memory_) {
    const double way = (known.point - p).norm();
    if (way >= known.empty) continue;
    const double more = change(way, known.rim_gap);
    if (known.high - known.low + 2 * more >= best.high - best.low) continue;
    best = {p, known.empty - way, rim_ ? known.rim_gap - way : 0, known.low - more, known.high + more};
  }
  return best;
}

Side Sides::of_ball(const Vector3d& centre, double radius, const Closest& nearest) const {
  if (nearest.distance <= radius) return Side::kMixed;
  if (!rim_) return inside(centre, nearest) ? Side::kInside : Side::kOutside;
  if (change(radius, rim_->closest(centre).distance) >= 0.5) return Side::kMixed;
  const auto side = [&](const Known& known) {
    const double more = change(radius, known.rim_gap);
    if (known.low - more >= 0.5) return Side::kInside;
    return known.high + more < 0.5 ? Side::kOutside : Side::kMixed;
  };
  Side found = side(recall(centre));
  for (double tolerance : {0.1, 0.01}) {
    if (found == Side::kMixed) found = side(ask(centre, nearest.distance, tolerance));
  }
  return found;
}

// A trusted triangle has the inside behind it and the outside in front, and the segment from p to the nearest point
// meets the boundary there only. At an edge or a corner that argument needs all the neighbours: ask the winding number.
bool Sides::inside(const Vector3d& p, const Closest& nearest) const {
  if (!mesh_.trusted.empty() && mesh_.trusted[nearest.triangle] && nearest.feature == Feature::kFace) {
    return (p - nearest.point).dot(tree_.normal(nearest.triangle)) < 0;
  }
  Known known = recall(p);
  for (double tolerance : {0.2, 0.02, 0.002}) {
    if (known.low >= 0.5 || known.high < 0.5) return known.low >= 0.5;
    known = ask(p, nearest.distance, tolerance);
  }
  if (known.low >= 0.5 || known.high < 0.5) return known.low >= 0.5;
  return winding_number(tree_, p) >= 0.5;
}

}  // namespace medial_vk::reference
