#include "mesh/crossings/cut_triangle.h"

#include <cmath>
#include <deque>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {

CutTriangle::CutTriangle(ExactGeometry& geometry, const GridTriangle& corners)
    : geometry_(geometry), axis_(projection_axis(corners)), sign_(geometry.normal_sign(corners, axis_)) {
  for (const Point& corner : corners) points_.push_back(geometry.vertex(corner));
  add({0, 1, 2});
}

std::vector<std::array<std::uint32_t, 3>> CutTriangle::triangles() const { return triangles_; }

std::uint32_t CutTriangle::left_of(std::uint32_t a, std::uint32_t b) const {
  const auto found = left_.find(key(a, b));
  return found == left_.end() ? kNone : found->second;
}

std::uint32_t CutTriangle::apex(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const {
  for (const std::uint32_t c : triangles_[triangle]) {
    if (c != a && c != b) return c;
  }
  return kNone;
}

void CutTriangle::put(std::uint32_t triangle, const Corners& corners) {
  triangles_[triangle] = corners;
  for (std::size_t k = 0; k < 3; ++k) left_[key(corners[k], corners[(k + 1) % 3])] = triangle;
}

void CutTriangle::add(const Corners& corners) {
  triangles_.emplace_back();
  put(static_cast<std::uint32_t>(triangles_.size() - 1), corners);
}

void CutTriangle::remove_edges(std::uint32_t triangle) {
  const Corners c = triangles_[triangle];
  for (std::size_t k = 0; k < 3; ++k) left_.erase(key(c[k], c[(k + 1) % 3]));
}

bool CutTriangle::insert(const ExactPoint& point) {
  const auto number = static_cast<std::uint32_t>(points_.size());
  points_.push_back(point);
  // A walk towards the point, which may circle; then every triangle is tried.
  auto at = static_cast<std::uint32_t>(triangles_.size() - 1);
  for (std::size_t steps = 0; steps < 2 * triangles_.size() + 8; ++steps) {
    const Corners& c = triangles_[at];
    std::uint32_t next = at;
    for (std::size_t k = 0; k < 3 && next == at; ++k) {
      const std::size_t first = (k + steps) % 3;
      const std::uint32_t a = c[first], b = c[(first + 1) % 3];
      if (turn(a, b, number) < 0) next = left_of(b, a);
    }
    if (next == kNone) break;
    if (next == at) return split(at, number);
    at = next;
  }
  for (at = 0; at < triangles_.size(); ++at) {
    const Corners& c = triangles_[at];
    if (turn(c[0], c[1], number) >= 0 && turn(c[1], c[2], number) >= 0 && turn(c[2], c[0], number) >= 0)
      return split(at, number);
  }
  return false;
}

bool CutTriangle::split(std::uint32_t triangle, std::uint32_t point) {
  const Corners c = triangles_[triangle];
  int edge = -1;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (turn(c[i], c[(i + 1) % 3], point) != 0) continue;
    if (edge >= 0) return false;  // at a corner
    edge = k;
  }
  if (edge >= 0) {
    const auto i = static_cast<std::size_t>(edge);
    split_edge(c[i], c[(i + 1) % 3], point);
    return true;
  }
  remove_edges(triangle);
  put(triangle, {c[0], c[1], point});
  add({c[1], c[2], point});
  add({c[2], c[0], point});
  return true;
}

void CutTriangle::split_edge(std::uint32_t a, std::uint32_t b, std::uint32_t point) {
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    const std::uint32_t triangle = left_of(from, to);
    if (triangle == kNone) continue;
    const std::uint32_t c = apex(triangle, from, to);
    remove_edges(triangle);
    put(triangle, {from, point, c});
    add({point, to, c});
  }
}

/// Replaces the edge by the other diagonal of its two triangles, if they form a convex quadrilateral.
bool CutTriangle::flip(std::uint32_t a, std::uint32_t b, std::array<std::uint32_t, 2>& made) {
  const std::uint32_t left = left_of(a, b), right = left_of(b, a);
  if (left == kNone || right == kNone) return false;
  const std::uint32_t c = apex(left, a, b), d = apex(right, a, b);
  if (turn(a, d, c) <= 0 || turn(d, b, c) <= 0) return false;
  remove_edges(left);
  remove_edges(right);
  put(left, {a, d, c});
  put(right, {d, b, c});
  made = {c, d};
  return true;
}

/// The edges that the segment crosses, up to the first point on it, which `on_the_way` receives.
bool CutTriangle::collect_crossed(std::uint32_t from, std::uint32_t to,
                                  std::vector<std::array<std::uint32_t, 2>>& edges, std::uint32_t& on_the_way) {
  on_the_way = kNone;
  std::array<std::uint32_t, 2> edge = {kNone, kNone};
  for (const Corners& c : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (c[k] != from) continue;
      const std::uint32_t a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      const int of_a = turn(from, a, to), of_b = turn(from, b, to);
      if (of_a > 0 && of_b < 0) edge = {a, b};
      // A neighbour in the direction of `to`: the other corner is beside the line through both.
      if (of_a == 0 && of_b < 0) on_the_way = a;
      if (of_b == 0 && of_a > 0) on_the_way = b;
    }
  }
  if (on_the_way != kNone) return true;
  while (edge[0] != kNone) {
    edges.push_back(edge);
    const std::uint32_t next = left_of(edge[1], edge[0]);
    if (next == kNone || edges.size() > 3 * triangles_.size()) return false;
    const std::uint32_t c = apex(next, edge[0], edge[1]);
    const int side = c == to ? 0 : turn(from, to, c);
    if (side == 0) {
      on_the_way = c;
      return true;
    }
    edge = side > 0 ? std::array{edge[0], c} : std::array{c, edge[1]};
  }
  return false;
}

bool CutTriangle::add_segment(std::uint32_t from, std::uint32_t to) {
  while (from != to) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::uint32_t end = to;
    if (left_of(from, to) == kNone && left_of(to, from) == kNone && !collect_crossed(from, to, edges, end))
      return false;
    std::deque<std::array<std::uint32_t, 2>> crossed(edges.begin(), edges.end());
    for (std::size_t flips = 0; !crossed.empty(); ++flips) {
      if (flips > 16 * (edges.size() + 4) * (edges.size() + 4)) return false;
      const auto [a, b] = crossed.front();
      crossed.pop_front();
      if (segments_.contains(undirected(a, b))) return false;
      std::array<std::uint32_t, 2> made;
      if (!flip(a, b, made)) {
        crossed.push_back({a, b});
        continue;
      }
      const auto [c, d] = made;
      if (c == from || c == end || d == from || d == end) continue;
      if (turn(from, end, c) * turn(from, end, d) < 0) crossed.push_back(made);
    }
    segments_.insert(undirected(from, end));
    from = end;
  }
  return true;
}

double CutTriangle::cotangent(std::uint32_t at, std::uint32_t a, std::uint32_t b) const {
  const Point to_a = points_[a].near - points_[at].near, to_b = points_[b].near - points_[at].near;
  const double area = length(cross(to_a, to_b));
  return area > 0 ? dot(to_a, to_b) / area : 1e300;
}

bool CutTriangle::should_flip(std::uint32_t a, std::uint32_t b) const {
  if (segments_.contains(undirected(a, b))) return false;
  const std::uint32_t left = left_of(a, b), right = left_of(b, a);
  if (left == kNone || right == kNone) return false;
  return cotangent(apex(left, a, b), a, b) + cotangent(apex(right, a, b), a, b) < -1e-9;
}

void CutTriangle::improve() {
  std::vector<std::array<std::uint32_t, 2>> pending;
  for (const Corners& c : triangles_) {
    for (std::size_t k = 0; k < 3; ++k) pending.push_back({c[k], c[(k + 1) % 3]});
  }
  // In exact arithmetic the flips end by themselves; rounding could let them circle.
  std::size_t left = 64 + 16 * triangles_.size();
  while (!pending.empty() && left > 0) {
    const auto [a, b] = pending.back();
    pending.pop_back();
    std::array<std::uint32_t, 2> made;
    if (!should_flip(a, b) || !flip(a, b, made)) continue;
    --left;
    const auto [c, d] = made;
    pending.insert(pending.end(), {{a, d}, {d, b}, {b, c}, {c, a}});
  }
}

}  // namespace medial_vk
