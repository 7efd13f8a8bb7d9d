#include "search/side.h"

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

constexpr std::size_t kMostEdges = 16384;  // limit of a sum over single edges

/// By vertex: the first of the vertices at its position.
std::vector<int> first_at_position(const Mesh& mesh) {
  const auto key = [&](int v) {
    const Vector3d& p = mesh.vertices[v];
    return std::make_tuple(p.x(), p.y(), p.z());
  };
  std::vector<int> order(mesh.vertices.size()), first(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// Edges whose triangles' directions do not cancel, with the number of uncancelled directions.
std::map<std::pair<int, int>, int> open_edges(const Mesh& mesh) {
  const std::vector<int> first = first_at_position(mesh);
  std::map<std::pair<int, int>, int> net;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int a = first[t[k]], b = first[t[(k + 1) % 3]];
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
    rim_.push_back({mesh.vertices[edge.first], mesh.vertices[edge.second], std::abs(times)});
    rim.triangles.emplace_back(edge.first, edge.second, edge.second);
    rim_length_ += std::abs(times) * (mesh.vertices[edge.first] - mesh.vertices[edge.second]).norm();
  }
  if (rim_.size() > kMostEdges) rim_tree_ = std::make_unique<Tree>(rim);
}

// Away from the boundary the winding number is smooth, and its gradient is that of the solid angle of a surface
// spanning the open edges: by the law of Biot and Savart at most the integral of 1 / 4 pi d^2 along these edges, d the
// distance to them. Of an edge that is longer than pi times its distance no more than that counts (docs/theory.md,
// "Outside"). A closed mesh has no open edges, and the winding number is constant.
double Sides::slope_within(const Vector3d& p, double way) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kPi = std::numbers::pi;
  if (rim_tree_) {
    const double gap = rim_tree_->closest(p).distance - way;
    return gap > 0 ? rim_length_ / (4 * kPi * gap * gap) : kInfinity;
  }
  double sum = 0;
  for (const Edge& e : rim_) {
    const Vector3d along = e.to - e.from;
    const double size = along.norm(), share = std::clamp(along.dot(p - e.from) / along.squaredNorm(), 0.0, 1.0);
    const double away = (e.from + share * along - p).norm(), gap = away - way;
    if (!(gap > 0)) return kInfinity;
    sum += e.times * std::min(size, kPi * away) / (gap * gap);
  }
  return (1 + 1e-9) * sum / (4 * kPi);
}

Sides::Known Sides::evaluate(const Vector3d& p, double empty, double tolerance) const {
  const double winding = winding_number(tree_, p, tolerance), reach = empty / 2;
  Known known = {p, reach, slope_within(p, reach), winding - tolerance, winding + tolerance};
  memory_[next_++ % memory_.size()] = known;
  return known;
}

/// The tightest bounds at p that follow from a remembered point, if there are any.
Sides::Known Sides::recall(const Vector3d& p) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Known best = {p, 0, 0, -kInfinity, kInfinity};
  for (const Known& known : memory_) {
    const double way = (known.point - p).norm();
    if (!(way < known.reach)) continue;
    const double more = way > 0 ? way * known.slope : 0;
    if (known.high - known.low + 2 * more < best.high - best.low) best = {p, 0, 0, known.low - more, known.high + more};
  }
  return best;
}

Side Sides::of_ball(const Vector3d& centre, double radius, const Closest& nearest) const {
  if (nearest.distance <= radius) return Side::kMixed;
  if (rim_.empty()) return inside(centre, nearest) ? Side::kInside : Side::kOutside;
  const double more = radius * slope_within(centre, radius);
  if (!(more < 0.5)) return Side::kMixed;
  const auto side = [&](const Known& known) {
    if (known.low - more >= 0.5) return Side::kInside;
    return known.high + more < 0.5 ? Side::kOutside : Side::kMixed;
  };
  Side found = side(recall(centre));
  for (double tolerance : {0.1, 0.01}) {
    if (found == Side::kMixed) found = side(evaluate(centre, nearest.distance, tolerance));
  }
  return found;
}

// A trusted triangle has the inside behind it and the outside in front, and the segment from p to the nearest point
// meets the boundary only there. At an edge or a corner this argument requires all the neighbours, and on an open mesh
// the winding number changes along the segment; in these cases the winding number is computed.
bool Sides::inside(const Vector3d& p, const Closest& nearest) const {
  if (rim_.empty() && !mesh_.trusted.empty() && mesh_.trusted[nearest.triangle] && nearest.feature == Feature::kFace) {
    return (p - nearest.point).dot(tree_.normal(nearest.triangle)) < 0;
  }
  Known known = recall(p);
  for (double tolerance : {0.2, 0.02, 0.002}) {
    if (known.low >= 0.5 || known.high < 0.5) return known.low >= 0.5;
    known = evaluate(p, nearest.distance, tolerance);
  }
  if (known.low >= 0.5 || known.high < 0.5) return known.low >= 0.5;
  return winding_number(tree_, p) >= 0.5;
}

}  // namespace medial_vk::reference
