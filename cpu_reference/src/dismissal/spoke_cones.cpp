#include "dismissal/spoke_cones.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

// A cross product of two exact edges is wrong by less than 4 * 2^-53 of the product of their lengths. Above this sine
// of the angle between them its direction is right to 4 * 2^-53 / 1e-6 < 5e-10.
constexpr double kLeastCornerSine = 1e-6;
// Above the error of (n x m) . e for two normals and a unit edge (2 * 5e-10, and rounding): a certain turn.
constexpr double kTurnSlack = 1e-8;
// Unit edges from rounded differences are right to 1e-15, and a ray across two of them to 1e-15 / kLeastRaySine.
constexpr double kLeastRaySine = 1e-6;
constexpr double kRaySlack = 1e-8;
// If normals are farther than this from the axis, slopes of the graph over it are not used.
constexpr double kLeastGraphCosine = 0.1;

/// The triangles around a vertex, with the data of Lemma D; in any order.
struct Fan {
  std::vector<Vector3d> normals;
  std::vector<Vector3d> edges;     // unit, leaving the vertex; the one of a triangle has it on the left
  std::vector<Vector3d> on_right;  // the normal on the other side of that edge
  std::vector<double> turns;       // at that edge
};

/// The slope of the plane with normal n, as a graph over the plane across the axis.
Vector3d slope(const Vector3d& n, const Vector3d& axis) { return axis - n / n.dot(axis); }

// Near a trusted vertex the boundary is the graph of f over the plane across an axis near all normals, with the solid
// below it (Lemma B). A ball that touches the vertex from below has its tangent plane, the graph of l, below f. In
// polar coordinates f - l = r h(t), h >= 0, where h'' + h vanishes except at the edges: there h' jumps by the jump of
// slope, negative if the edge is convex. Over the whole circle the integral of h'' is 0, so the jumps sum up to that of
// h, which is not negative. At convex vertices, and at many others, the sum is negative. Normals within 5e-10 put
// slopes off by 2 * 5e-10 / kLeastGraphCosine^2 = 1e-7 per edge: ten times that is allowed.
bool cannot_be_touched(const Fan& fan, const Cap& cap) {
  if (cap.cosine < kLeastGraphCosine) return false;
  double sum = 0;
  for (std::size_t i = 0; i < fan.edges.size(); ++i) {
    const double jump = (slope(fan.normals[i], cap.axis) - slope(fan.on_right[i], cap.axis)).norm();
    sum += (fan.turns[i] > 0 ? -jump : jump) + 1e-6;
  }
  return sum < 0;
}

/// The extreme rays of the cone s . e >= 0 for all edges e; nothing if edges are too nearly parallel to decide.
std::vector<Vector3d> rays_across(const std::vector<Vector3d>& edges) {
  std::vector<Vector3d> rays;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Vector3d ray = edges[i].cross(edges[j]);
      const double sine = ray.norm();
      if (sine < kLeastRaySine) return {};
      for (const double sign : {1.0, -1.0}) {
        const Vector3d s = sign / sine * ray;
        const auto along = [&](const Vector3d& e) { return s.dot(e) >= -kRaySlack; };
        if (std::all_of(edges.begin(), edges.end(), along)) rays.push_back(s);
      }
    }
  }
  return rays;
}

// Lemma D: spokes at a vertex are within every cap that holds the normals, and do not point away from any edge. The
// cone of such directions is spanned by its extreme rays: it lies in a cap around those, and is empty on the axis' side
// if all of them point to the other side.
std::optional<Cap> vertex_spokes(const Fan& fan) {
  Cap spokes = cap_around(fan.normals);
  if (spokes.holds_all()) return spokes;
  if (cannot_be_touched(fan, spokes)) return std::nullopt;
  const std::vector<Vector3d> rays = rays_across(fan.edges);
  if (rays.empty()) return spokes;
  const auto away = [&](const Vector3d& ray) { return ray.dot(spokes.axis) < -kRaySlack; };
  if (std::all_of(rays.begin(), rays.end(), away)) return std::nullopt;
  const Cap by_edges = cap_around(rays);
  if (by_edges.angle < spokes.angle) spokes = by_edges;
  return spokes;
}

// Lemma I on an edge, seen along it: the half circle of directions that do not point away from the first triangle,
// restricted to those that do not point away from the others. Directions d across the edge are right to 1e-9
// (kLeastCornerSine).
std::optional<Arc> arc_across(const Vector3d& along, std::span<const Vector3d> towards) {
  constexpr double kRightAngle = std::numbers::pi / 2;
  const Vector3d u = towards.front(), v = along.cross(u);
  double from = -kRightAngle, to = kRightAngle;  // angles from u
  for (const Vector3d& d : towards) {
    const double at = std::atan2(d.dot(v), d.dot(u));  // within pi of 0, as is the remainder: no turn to add
    from = std::max(from, at - kRightAngle);
    to = std::min(to, at + kRightAngle);
  }
  // Two triangles in a plane keep their normals, which count as spokes to their faces.
  const double half = (to - from) / 2, middle = (to + from) / 2;
  if (half <= kFlatAngle / 2) return std::nullopt;
  return Arc{along, std::cos(middle) * u + std::sin(middle) * v, std::min(half + kNormalSlack, kRightAngle)};
}

// Lemma I at a vertex: the cone s . e >= 0 for all edges e. Nothing if it is empty; all directions if no cap holds it.
std::optional<Cap> cone_across(const std::vector<Vector3d>& edges) {
  constexpr std::size_t kMostEdges = 40;  // the time for the rays grows with the cube of it
  if (edges.size() > kMostEdges) return Cap::all();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (edges[i].cross(edges[j]).norm() < kLeastRaySine) return Cap::all();
    }
  }
  if (edges.size() < 2) return Cap::all();
  const std::vector<Vector3d> rays = rays_across(edges);
  if (rays.empty()) return std::nullopt;
  return cap_around(rays);
}

}  // namespace

Cap Cap::around(const Vector3d& axis, double angle) {
  if (angle >= std::numbers::pi / 2) return all();
  return {axis, angle, std::cos(angle), std::sin(angle)};
}

Cap Cap::all() { return {Vector3d::UnitZ(), std::numbers::pi, -1, 0}; }

// Moves the axis towards the direction farthest from it, by decreasing steps (Badoiu and Clarkson 2003), and keeps the
// best; for two directions, the mean.
Cap cap_around(std::span<const Vector3d> directions) {
  constexpr int kSteps = 30;
  Vector3d axis = Vector3d::Zero(), best = Vector3d::Zero();
  double best_cosine = -1;
  for (const Vector3d& d : directions) axis += d;
  if (axis.squaredNorm() < 1e-12) return Cap::all();
  axis.normalize();
  for (int i = 0; i < kSteps; ++i) {
    const auto less_along = [&](const Vector3d& a, const Vector3d& b) { return a.dot(axis) < b.dot(axis); };
    const Vector3d& farthest = *std::min_element(directions.begin(), directions.end(), less_along);
    if (farthest.dot(axis) > best_cosine) {
      best_cosine = farthest.dot(axis);
      best = axis;
    }
    axis = (axis + (farthest - axis) / (i + 2.5)).normalized();
  }
  double angle = 0;
  for (const Vector3d& d : directions) angle = std::max(angle, 2 * half_angle(best, d));
  return Cap::around(best, angle + kNormalSlack);
}

SpokeCones::SpokeCones(const Mesh& mesh, const Tree& tree) {
  for (const Eigen::Vector3i& t : mesh.triangles) corners_.push_back({t[0], t[1], t[2]});
  find_neighbours(mesh);
  distrust(mesh, tree);
  measure_turns(tree);
  edges_.assign(trusted_.size(), {-1, -1, -1});
  vertices_.assign(trusted_.size(), {-1, -1, -1});
  add_edges(tree);
  add_vertices(mesh, tree);
  arcs_of_ = cones_ = std::vector<std::array<int, 3>>(trusted_.size(), {-1, -1, -1});
  add_arcs(mesh, tree);
  add_cones(mesh);
}

int SpokeCones::add(const Cap& cap) {
  caps_.push_back(cap);
  return static_cast<int>(caps_.size()) - 1;
}

void SpokeCones::find_neighbours(const Mesh& mesh) {
  const int count = static_cast<int>(mesh.triangles.size());
  std::vector<std::tuple<int, int, int>> half_edges;  // from, to, triangle
  half_edges.reserve(3 * mesh.triangles.size());
  for (int t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) half_edges.emplace_back(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3], t);
  }
  std::sort(half_edges.begin(), half_edges.end());
  neighbours_.assign(mesh.triangles.size(), {-1, -1, -1});
  for (int t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k], to = mesh.triangles[t][(k + 1) % 3];
      const auto other = std::lower_bound(half_edges.begin(), half_edges.end(), std::tuple(to, from, -1));
      if (other == half_edges.end() || std::get<0>(*other) != to || std::get<1>(*other) != from) continue;
      neighbours_[t][k] = std::get<2>(*other);
    }
  }
}

void SpokeCones::distrust(const Mesh& mesh, const Tree& tree) {
  trusted_ = mesh.trusted;
  trusted_.resize(mesh.triangles.size(), 0);
  has_sides_.assign(mesh.triangles.size(), 0);
  for (int t = 0; t < static_cast<int>(trusted_.size()); ++t) {
    const Vector3d a = tree.corner(t, 1) - tree.corner(t, 0), b = tree.corner(t, 2) - tree.corner(t, 0);
    const bool sure = a.cross(b).norm() > kLeastCornerSine * a.norm() * b.norm();
    const auto& across = neighbours_[t];
    has_sides_[t] = sure ? 1 : 0;
    if (!sure || *std::min_element(across.begin(), across.end()) < 0) trusted_[t] = 0;
  }
}

void SpokeCones::measure_turns(const Tree& tree) {
  turns_.assign(trusted_.size(), {0, 0, 0});
  for (int t = 0; t < static_cast<int>(trusted_.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int u = neighbours_[t][k];
      if (u < 0) continue;
      const Vector3d along = (tree.corner(t, (k + 1) % 3) - tree.corner(t, k)).normalized();
      turns_[t][k] = tree.normal(t).cross(tree.normal(u)).dot(along);
    }
  }
}

// Lemma D: convex edges are never touched from inside; at others spokes lie on the arc between the two normals, which a
// cap below pi/2 around both holds.
void SpokeCones::add_edges(const Tree& tree) {
  for (int t = 0; t < static_cast<int>(trusted_.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int u = neighbours_[t][k];
      if (u < t || trusted_[t] == 0 || trusted_[u] == 0 || turns_[t][k] > kTurnSlack) continue;
      const std::array<Vector3d, 2> normals = {tree.normal(t), tree.normal(u)};
      const Cap spokes = cap_around(normals);
      if (spokes.angle > kFlatAngle) edges_[t][k] = add(spokes);
    }
  }
}

void SpokeCones::add_arcs(const Mesh& mesh, const Tree& tree) {
  std::map<std::pair<int, int>, std::vector<std::pair<int, int>>> edges;  // of triangle, number; smallest first
  for (int t = 0; t < static_cast<int>(trusted_.size()); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      edges[std::minmax(a, b)].emplace_back(t, k);
    }
  }
  for (const auto& [ends, sides] : edges) {
    const auto is_untrusted = [&](const auto& side) { return trusted_[side.first] == 0; };
    const auto has_sides = [&](const auto& side) { return has_sides_[side.first] != 0; };
    const auto owner = std::find_if(sides.begin(), sides.end(), is_untrusted);
    if (owner == sides.end() || !std::all_of(sides.begin(), sides.end(), has_sides)) continue;
    const auto [t, k] = *owner;
    const Vector3d along = (tree.corner(t, (k + 1) % 3) - tree.corner(t, k)).normalized();
    std::vector<Vector3d> towards;
    towards.reserve(sides.size());
    for (const auto& [u, j] : sides) {
      const Vector3d across = tree.normal(u).cross(along);
      const double sign = across.dot(tree.corner(u, (j + 2) % 3) - tree.corner(u, j)) > 0 ? 1 : -1;
      towards.emplace_back(sign * across);
    }
    const std::optional<Arc> arc = arc_across(along, towards);
    if (!arc) continue;
    arcs_of_[t][k] = static_cast<int>(arcs_.size());
    arcs_.push_back(*arc);
  }
}

void SpokeCones::add_cones(const Mesh& mesh) {
  std::vector<std::vector<std::pair<int, int>>> corners(mesh.vertices.size());  // triangle, corner; smallest first
  for (int t = 0; t < static_cast<int>(trusted_.size()); ++t) {
    for (int k = 0; k < 3; ++k) corners[mesh.triangles[t][k]].emplace_back(t, k);
  }
  for (const auto& around : corners) {
    const auto is_untrusted = [&](const auto& corner) { return trusted_[corner.first] == 0; };
    const auto has_sides = [&](const auto& corner) { return has_sides_[corner.first] != 0; };
    const auto owner = std::find_if(around.begin(), around.end(), is_untrusted);
    if (owner == around.end() || !std::all_of(around.begin(), around.end(), has_sides)) continue;
    std::set<int> ends;
    for (const auto& [t, k] : around) {
      ends.insert(mesh.triangles[t][(k + 1) % 3]);
      ends.insert(mesh.triangles[t][(k + 2) % 3]);
    }
    const auto [t, k] = *owner;
    const Vector3d& here = mesh.vertices[mesh.triangles[t][k]];
    std::vector<Vector3d> edges;
    edges.reserve(ends.size());
    for (const int end : ends) edges.push_back((mesh.vertices[end] - here).normalized());
    if (const std::optional<Cap> cone = cone_across(edges)) cones_[t][k] = add(*cone);
  }
}

void SpokeCones::add_vertices(const Mesh& mesh, const Tree& tree) {
  std::vector<std::vector<std::pair<int, int>>> corners(mesh.vertices.size());  // triangle, corner; smallest first
  for (int t = 0; t < static_cast<int>(trusted_.size()); ++t) {
    for (int k = 0; k < 3; ++k) corners[mesh.triangles[t][k]].emplace_back(t, k);
  }
  for (const auto& around : corners) {
    const auto is_trusted = [&](const auto& corner) { return trusted_[corner.first] != 0; };
    if (around.empty() || !std::all_of(around.begin(), around.end(), is_trusted)) continue;
    Fan fan;
    for (const auto& [t, k] : around) {
      fan.normals.push_back(tree.normal(t));
      fan.edges.push_back((tree.corner(t, (k + 1) % 3) - tree.corner(t, k)).normalized());
      fan.on_right.push_back(tree.normal(neighbours_[t][k]));
      fan.turns.push_back(turns_[t][k]);
    }
    const std::optional<Cap> spokes = vertex_spokes(fan);
    const auto [t, k] = around.front();
    if (spokes && spokes->angle > kFlatAngle) vertices_[t][k] = add(*spokes);
  }
}

}  // namespace medial_vk::reference
