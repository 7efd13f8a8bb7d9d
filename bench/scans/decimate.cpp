#include "decimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "base/point_ops.h"

namespace medial_vk::bench {
namespace {

/// x -> x.A x + 2 b.x + c, with A symmetric: xx, xy, xz, yy, yz, zz.
struct Quadric {
  std::array<double, 6> a{};
  Point b{};
  double c = 0;

  void add(const Quadric& other) {
    for (std::size_t i = 0; i < 6; ++i) a[i] += other.a[i];
    b = b + other.b;
    c += other.c;
  }
  double at(const Point& x) const {
    const double square = a[0] * x[0] * x[0] + a[3] * x[1] * x[1] + a[5] * x[2] * x[2] +
                          2 * (a[1] * x[0] * x[1] + a[2] * x[0] * x[2] + a[4] * x[1] * x[2]);
    return std::max(square + 2 * dot(b, x) + c, 0.0);
  }
  /// Where the value is least; false if that is not one point.
  bool minimum(Point& x) const {
    const Point r0 = {a[0], a[1], a[2]}, r1 = {a[1], a[3], a[4]}, r2 = {a[2], a[4], a[5]};
    const double volume = dot(r0, cross(r1, r2)), scale = a[0] + a[3] + a[5];
    if (!(std::abs(volume) > 1e-5 * scale * scale * scale)) return false;
    x = (-1 / volume) * (b[0] * cross(r1, r2) + b[1] * cross(r2, r0) + b[2] * cross(r0, r1));
    return true;
  }
};

Quadric plane_quadric(const Point& a, const Point& b, const Point& c) {
  const Point across = cross(b - a, c - a);
  const double twice_area = length(across);
  if (!(twice_area > 0)) return {};
  const Point n = (1 / twice_area) * across;
  const double d = -dot(n, a), w = twice_area / 2;
  return {{w * n[0] * n[0], w * n[0] * n[1], w * n[0] * n[2], w * n[1] * n[1], w * n[1] * n[2], w * n[2] * n[2]},
          w * d * n,
          w * d * d};
}

class Decimation {
 public:
  explicit Decimation(const Mesh& mesh) : mesh_(mesh), left_(mesh.triangles.size()) {
    faces_.resize(mesh.vertices.size());
    quadrics_.resize(mesh.vertices.size());
    version_.resize(mesh.vertices.size());
    is_gone_.resize(mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.triangles[t];
      const Quadric quadric = plane_quadric(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
      for (const std::uint32_t v : mesh.triangles[t]) {
        faces_[v].push_back(t);
        quadrics_[v].add(quadric);
      }
    }
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      for (const std::uint32_t other : neighbours(v)) {
        if (v < other) push(v, other);
      }
    }
  }

  Mesh run(std::size_t triangles) {
    while (left_ > triangles && !queue_.empty()) {
      const Candidate best = queue_.top();
      queue_.pop();
      if (version_[best.a] == best.version_a && version_[best.b] == best.version_b) collapse(best);
    }
    return compact();
  }

 private:
  struct Candidate {
    double error;
    std::uint32_t a, b, version_a, version_b;
    Point at;
    bool operator<(const Candidate& other) const {
      return std::pair(error, a) > std::pair(other.error, other.a);  // the least on top
    }
  };

  std::vector<std::uint32_t> neighbours(std::uint32_t v) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : faces_[v]) {
      for (const std::uint32_t other : mesh_.triangles[t]) {
        if (other != v) found.push_back(other);
      }
    }
    std::ranges::sort(found);
    const auto repeated = std::ranges::unique(found);
    found.erase(repeated.begin(), repeated.end());
    return found;
  }

  void push(std::uint32_t a, std::uint32_t b) {
    Quadric sum = quadrics_[a];
    sum.add(quadrics_[b]);
    const Point &p = mesh_.vertices[a], &q = mesh_.vertices[b];
    Point at = 0.5 * (p + q);
    for (const Point& end : {p, q}) {
      if (sum.at(end) < sum.at(at)) at = end;
    }
    // A minimum far away comes from planes that are nearly parallel.
    if (Point least; sum.minimum(least) && length(least - 0.5 * (p + q)) < 2 * length(p - q)) at = least;
    queue_.push({sum.at(at), a, b, version_[a], version_[b], at});
  }

  void collapse(const Candidate& c) {
    const std::vector<std::uint32_t> around_a = neighbours(c.a), around_b = neighbours(c.b);
    std::vector<std::uint32_t> common;
    std::ranges::set_intersection(around_a, around_b, std::back_inserter(common));
    if (common.size() != 2 || around_a.size() + around_b.size() <= 7) return;  // no manifold would be left
    if (turns_over(c.a, c.b, c.at) || turns_over(c.b, c.a, c.at)) return;
    mesh_.vertices[c.a] = c.at;
    quadrics_[c.a].add(quadrics_[c.b]);
    for (const std::uint32_t t : faces_[c.b]) {
      Triangle& triangle = mesh_.triangles[t];
      if (std::ranges::count(triangle, c.a) > 0) {
        is_gone_[t] = 1;
        --left_;
        for (const std::uint32_t v : triangle) {
          if (v != c.b) std::erase(faces_[v], t);
        }
      } else {
        std::ranges::replace(triangle, c.b, c.a);
        faces_[c.a].push_back(t);
      }
    }
    faces_[c.b].clear();
    ++version_[c.a];
    ++version_[c.b];
    for (const std::uint32_t other : neighbours(c.a)) push(c.a, other);
  }

  /// Whether a triangle at v, but not at `other`, turns by more than about 80 degrees if v moves.
  bool turns_over(std::uint32_t v, std::uint32_t other, const Point& at) const {
    return std::ranges::any_of(faces_[v], [&](std::uint32_t t) {
      const Triangle& triangle = mesh_.triangles[t];
      if (std::ranges::count(triangle, other) > 0) return false;
      std::array<Point, 3> before, after;
      for (std::size_t k = 0; k < 3; ++k) {
        before[k] = mesh_.vertices[triangle[k]];
        after[k] = triangle[k] == v ? at : before[k];
      }
      const Point n = cross(before[1] - before[0], before[2] - before[0]);
      const Point m = cross(after[1] - after[0], after[2] - after[0]);
      return !(dot(n, m) > 0.2 * length(n) * length(m));
    });
  }

  Mesh compact() const {
    Mesh out;
    std::vector<std::uint32_t> number(mesh_.vertices.size(), std::numeric_limits<std::uint32_t>::max());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (is_gone_[t] != 0) continue;
      Triangle triangle = mesh_.triangles[t];
      for (std::uint32_t& v : triangle) {
        if (number[v] == std::numeric_limits<std::uint32_t>::max()) {
          number[v] = static_cast<std::uint32_t>(out.vertices.size());
          out.vertices.push_back(mesh_.vertices[v]);
        }
        v = number[v];
      }
      out.triangles.push_back(triangle);
    }
    return out;
  }

  Mesh mesh_;
  std::size_t left_;
  std::vector<std::vector<std::uint32_t>> faces_;  // of each vertex
  std::vector<Quadric> quadrics_;
  std::vector<std::uint32_t> version_;  // a candidate with another one is out of date
  std::vector<char> is_gone_;
  std::priority_queue<Candidate> queue_;
};

}  // namespace

Mesh decimate(const Mesh& mesh, std::size_t triangles) { return Decimation(mesh).run(triangles); }

}  // namespace medial_vk::bench
