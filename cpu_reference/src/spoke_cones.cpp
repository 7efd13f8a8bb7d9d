#include "spoke_cones.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kSlack = 1e-9;
constexpr double kTouchSlack = 1e-7;  // directions of edges, from rounded corners

double angle_between(const Vector3d& a, const Vector3d& b) { return 2 * half_angle(a, b); }

const Cap kAll = {Vector3d::UnitZ(), 4.0};
const Cap kNone = {Vector3d::UnitZ(), -1.0};

Cap cap_around(const std::vector<Vector3d>& directions) {
  Vector3d axis = Vector3d::Zero();
  for (const Vector3d& d : directions) axis += d;
  if (axis.squaredNorm() < 1e-12) return kAll;
  axis.normalize();
  for (int i = 0; i < 30; ++i) {
    const auto worst = std::min_element(directions.begin(), directions.end(), [&](const auto& a, const auto& b) { return a.dot(axis) < b.dot(axis); });
    axis = (axis + (*worst - axis) / (i + 2.5)).normalized();
  }
  double angle = 0;
  for (const Vector3d& d : directions) angle = std::max(angle, angle_between(axis, d));
  if (angle >= kPi / 2) return kAll;
  return {axis, angle + kSlack};
}

/// The spokes that a ball inside can have at an edge where `other` lies on t's outer side (reflex), between the normals.
Cap edge_cap(const Vector3d& n, const Vector3d& m, double apex_height) {
  if (apex_height < 0) return kNone;
  return cap_around({n, m});
}

Cap vertex_cap(const std::vector<Vector3d>& edges, const std::vector<Vector3d>& normals, double& cosine) {
  const Cap by_normals = cap_around(normals);
  cosine = by_normals.angle < kPi / 2 ? std::cos(by_normals.angle) : 0;
  if (by_normals.angle > kPi) return kAll;
  std::vector<Vector3d> rays;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vector3d r = edges[i].cross(edges[j]);
      if (r.norm() < 1e-6) return by_normals;  // nearly parallel edges: directions too uncertain
      r.normalize();
      for (int sign : {1, -1}) {
        const Vector3d s = sign * r;
        if (std::all_of(edges.begin(), edges.end(), [&](const Vector3d& e) { return s.dot(e) >= -kTouchSlack; }))
          rays.push_back(s);
      }
    }
  if (std::all_of(rays.begin(), rays.end(), [&](const Vector3d& r) { return r.dot(by_normals.axis) <= 0; }))
    return kNone;
  const Cap by_edges = cap_around(rays);
  return by_edges.angle < by_normals.angle ? by_edges : by_normals;
}

}  // namespace

SpokeCones::SpokeCones(const Mesh& mesh, const Tree& tree) : mesh_triangles_(mesh.triangles) {
  const int count = static_cast<int>(mesh.triangles.size());
  const auto trusted = [&](int t) { return !mesh.trusted.empty() && mesh.trusted[t] != 0; };
  std::map<std::pair<int, int>, int> half_edges;
  fans_.resize(mesh.vertices.size());
  for (int t = 0; t < count; ++t)
    for (int k = 0; k < 3; ++k) {
      half_edges[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = t;
      fans_[mesh.triangles[t][k]].push_back(t);
    }
  edges_.assign(count, {kAll, kAll, kAll});
  neighbours_.assign(count, {-1, -1, -1});
  for (int t = 0; t < count; ++t)
    for (int k = 0; k < 3; ++k) {
      const auto other = half_edges.find({mesh.triangles[t][(k + 1) % 3], mesh.triangles[t][k]});
      if (other == half_edges.end()) continue;
      const int u = other->second;
      neighbours_[t][k] = u;
      if (!trusted(t) || !trusted(u)) continue;
      double height = 0, scale = 0;
      for (int j = 0; j < 3; ++j) {
        const Vector3d d = tree.corner(u, j) - tree.corner(t, k);
        const double h = tree.normal(t).dot(d);
        if (std::abs(h) > std::abs(height)) height = h;
        scale = std::max(scale, d.norm());
      }
      edges_[t][k] = edge_cap(tree.normal(t), tree.normal(u), height + kTouchSlack * scale);
    }
  corners_.assign(mesh.vertices.size(), kAll);
  normal_cosines_.assign(mesh.vertices.size(), 0.0);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (fans_[v].empty() || !std::all_of(fans_[v].begin(), fans_[v].end(), trusted)) continue;
    std::vector<Vector3d> edges, normals;
    for (int t : fans_[v]) {
      normals.push_back(tree.normal(t));
      for (int k = 0; k < 3; ++k)
        if (mesh.triangles[t][k] == static_cast<int>(v)) edges.push_back((tree.corner(t, (k + 1) % 3) - tree.corner(t, k)).normalized());
    }
    corners_[v] = vertex_cap(edges, normals, normal_cosines_[v]);
  }
}

namespace {

struct Carrier {
  Cap spokes;
  std::array<Vector3d, 3> points;  // corners of the carrier (repeated)
  std::array<int, 8> planes;       // triangles with it on their border
  int plane_count;                 // 0: any
  int corner_count = 3;
  double plane_cosine = 1;
  double distance = 0;
  Vector3d direction = Vector3d::Zero();
};

// A third carrier that is nearer than a and b wherever they tie.
bool beaten(std::span<const Carrier> all, const Carrier& a, const Carrier& b, double half, double slack) {
  const double reach2 = 3 * half * half;
  const Vector3d ab = b.direction - a.direction;
  for (const Carrier& c : all) {
    if (&c == &a || &c == &b || c.distance <= 0) continue;
    const double share = ab.squaredNorm() > 0 ? std::clamp(ab.dot(c.direction - a.direction) / ab.squaredNorm(), 0.0, 1.0) : 0.5;
    const Vector3d g = a.direction + share * ab - c.direction;
    const double d = a.distance + share * (b.distance - a.distance) - c.distance;
    if (d - 2 * slack > half * g.cwiseAbs().sum() + reach2 / (2 * c.distance)) return true;
  }
  return false;
}

/// Can a chord from f to h make the angle with a spoke at f that the object angle asks for?
bool faces(const Tree& tree, const Carrier& f, const Carrier& h, double sine, double slack) {
  if (f.plane_count == 0) return true;
  std::array<Vector3d, 9> chords;
  int count = 0;
  Vector3d mean = Vector3d::Zero();
  for (int i = 0; i < f.corner_count; ++i)
    for (int j = 0; j < h.corner_count; ++j) {
      const Vector3d d = h.points[j] - f.points[i];
      if (d.squaredNorm() == 0) continue;
      chords[count++] = d;
      mean += d.normalized();
    }
  if (count == 0) return false;
  if (mean.squaredNorm() > 0) mean.normalize();
  for (int p = 0; p < f.plane_count; ++p) {
    const Vector3d& n = tree.normal(f.planes[p]);
    double most = 0;
    for (int i = 0; i < count; ++i) {
      const double behind = -n.dot(chords[i]) + slack, along = chords[i].dot(mean) - slack;
      if (behind <= 2 * slack) { if (along <= 0) most = std::max(most, 0.0); continue; }
      most = along > 0 ? std::max(most, behind / along) : 2.0;
    }
    bool bounded = true;
    for (int i = 0; i < count; ++i) bounded = bounded && chords[i].dot(mean) > slack;
    if (most > 0 && (!bounded || most >= sine * f.plane_cosine)) return true;
  }
  return false;
}

}  // namespace

bool no_pair_of_features(const Tree& tree, const SpokeCones& cones, const Vector3d& centre, double half,
                         const Closest& nearest, std::span<const Contact> contacts, double angle, std::vector<Aim>* aims) {
  const double reach = half * std::sqrt(3.0);
  const double slack = 8 * tree.rounding();
  std::array<Vector3d, 8> corner;
  std::array<double, 8> bound;
  for (int k = 0; k < 8; ++k) {
    corner[k] = half * Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    bound[k] = std::sqrt(tree.closest_on(nearest.triangle, centre + corner[k]).squared_distance) + slack;
  }
  // Lemmas A and C for a convex carrier whose nearest point is p; narrows `spokes`.
  const auto touches = [&](const Vector3d& p, Cap& spokes) {
    const Vector3d v = p - centre;
    const double d = v.norm();
    if (d <= reach) return true;
    const Vector3d g = v / d;
    bool contact = false;
    for (int k = 0; k < 8; ++k) contact = contact || d - g.dot(corner[k]) <= bound[k];
    if (!contact) return false;
    const double wander = std::asin(reach / d) + kSlack;
    if (spokes.angle < kPi && angle_between(g, spokes.axis) > wander + spokes.angle) return false;
    if (wander < spokes.angle) spokes = {g, wander};
    return true;
  };
  static const int mode = std::getenv("M") ? std::atoi(std::getenv("M")) : 0;
  std::vector<Carrier> features;
  for (const Contact& c : contacts) {
    const int t = c.triangle;
    const std::array<Vector3d, 3> abc = {tree.corner(t, 0), tree.corner(t, 1), tree.corner(t, 2)};
    Cap cap = c.trusted ? Cap{tree.normal(t), kSlack} : kAll;
    if (touches(centre + c.distance * c.direction, cap)) features.push_back({cap, abc, {t}, c.trusted ? 1 : 0});
    if (!c.trusted) continue;
    for (int k = 0; k < 3; ++k) {
      const int u = cones.neighbour(t, k);
      if (u >= 0 && u < t && std::any_of(contacts.begin(), contacts.end(), [&](const Contact& o) { return o.triangle == u; })) continue;
      cap = cones.edge(t, k);
      if (cap.angle >= 0) {
        const Vector3d a = abc[k], e = abc[(k + 1) % 3] - a;
        const double s = std::clamp(e.dot(centre - a) / e.squaredNorm(), 0.0, 1.0);
        const double cosine = cap.angle < kPi / 2 ? std::cos(cap.angle) : 0;
        if (touches(a + s * e, cap)) features.push_back({cap, {a, a + e, a}, {t, u}, u >= 0 && cosine > 0 ? 2 : 0, 2, cosine});
      }
    }
    for (int k = 0; k < 3; ++k) {
      const int v = cones.vertex(t, k);
      const auto& fan = cones.fan(v);
      if (std::any_of(contacts.begin(), contacts.end(), [&](const Contact& o) { return o.triangle < t && std::find(fan.begin(), fan.end(), o.triangle) != fan.end(); })) continue;
      cap = cones.corner(t, k);
      if (cap.angle >= 0 && touches(abc[k], cap)) {
        Carrier f = {cap, {abc[k], abc[k], abc[k]}, {}, 0, 1, cones.normal_cosine(v)};
        if (!std::getenv("NV") && f.plane_cosine > 0 && fan.size() <= 8) { f.plane_count = fan.size(); std::copy(fan.begin(), fan.end(), f.planes.begin()); }
        features.push_back(f);
      }
    }
  }
  if (features.size() > 400) return false;
  bool none = true;
  for (Carrier& f : features) {
    // nearest point of the carrier
    Vector3d p;
    if (f.points[0] == f.points[2] || f.points[0] == f.points[1]) { const Vector3d e = f.points[1] - f.points[0]; const double s = e.squaredNorm() > 0 ? std::clamp(e.dot(centre - f.points[0]) / e.squaredNorm(), 0.0, 1.0) : 0; p = f.points[0] + s * e; }
    else p = closest_point_on_triangle(centre, f.points[0], f.points[1], f.points[2]).point;
    f.distance = (p - centre).norm(); f.direction = (p - centre) / std::max(f.distance, 1e-300);
  }
  for (std::size_t i = 0; i < features.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Carrier &a = features[i], &b = features[j];
      if (angle_between(a.spokes.axis, b.spokes.axis) + a.spokes.angle + b.spokes.angle < 2 * angle) continue;
      if (!faces(tree, a, b, std::sin(angle), slack) || !faces(tree, b, a, std::sin(angle), slack)) continue;
      if ((mode & 16) && beaten(features, a, b, half, slack)) continue;
      none = false;
      if (!aims) return false;
      const Vector3d w = b.direction - a.direction;
      const double c = b.distance - a.distance, wv = half * w.cwiseAbs().sum();
      if (w.norm() < 0.1 || std::abs(c) > 1.2 * wv) continue;
      Vector3d x = w * c / w.squaredNorm();
      if (x.cwiseAbs().maxCoeff() > half) x = std::clamp(c / wv, -1.0, 1.0) * half * Vector3d(w.x() > 0 ? 1 : -1, w.y() > 0 ? 1 : -1, w.z() > 0 ? 1 : -1);
      aims->push_back({x, w.normalized(), std::max(a.distance - a.direction.dot(x), b.distance - b.direction.dot(x))});
    }
  if (aims) std::sort(aims->begin(), aims->end(), [](const Aim& a, const Aim& b) { return a.key < b.key; });
  return none;
}

}  // namespace medial_vk::reference
