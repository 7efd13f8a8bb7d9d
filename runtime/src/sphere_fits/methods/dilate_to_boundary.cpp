// Section 8.2 of the source as published.
#include <algorithm>
#include <cmath>
#include <new>
#include <set>

#include "base/host_memory.h"
#include "base/point_ops.h"
#include "sphere_fits/methods/dilation.h"

namespace medial_vk {
namespace {

class Growth {
 public:
  Growth(const Solid& solid, const std::vector<Ball>& balls) : solid_(solid), balls_(balls), radii_(balls.size()) {
    for (std::size_t i = 0; i < balls.size(); ++i) radii_[i] = balls[i].radius;
  }

  /// The balls that form a point of the envelope grow to the boundary point nearest to it.
  template <class Indices>
  void reach(const Point& at, const Indices& makers) {
    const Point target = solid_.closest(at).point;
    for (const std::uint32_t i : makers) radii_[i] = std::max(radii_[i], length(target - balls_[i].centre));
  }

  /// Two opposite points of the circle in which two spheres meet.
  void reach_circle(const std::array<std::uint32_t, 2>& edge) {
    const Ball &a = balls_[edge[0]], &b = balls_[edge[1]];
    const Point between = b.centre - a.centre;
    const double gap = length(between);
    if (gap == 0) return;
    const Point axis = (1 / gap) * between;
    const double along = (gap * gap + (a.radius - b.radius) * (a.radius + b.radius)) / (2 * gap);
    const double squared = std::max(0.0, (a.radius - along) * (a.radius + along));
    const Point out = std::sqrt(squared) * perpendicular_to(axis);
    const Point middle = a.centre + along * axis;
    reach(middle + out, edge);
    reach(middle - out, edge);
  }

  std::vector<Ball> grown() const {
    std::vector<Ball> balls = balls_;
    for (std::size_t i = 0; i < balls.size(); ++i) balls[i].radius = radii_[i];
    return balls;
  }

 private:
  const Solid& solid_;
  const std::vector<Ball>& balls_;
  std::vector<double> radii_;
};

std::set<std::array<std::uint32_t, 2>> edges_of(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const auto& [a, b, c] : triangles) edges.insert({{a, b}, {a, c}, {b, c}});
  return edges;
}

}  // namespace

Result<SphereSet> dilate_to_boundary(const Solid& solid, SphereSet inside, unsigned threads) {
  try {
    const Result<BallUnion> measured = measure_ball_union(inside.balls, {threads, true});
    if (!measured) return measured.error();
    const BallUnion& all = measured.value();
    Growth growth(solid, inside.balls);
    for (const EnvelopeVertex& vertex : all.vertices) growth.reach(vertex.at, vertex.balls);
    const std::set<std::array<std::uint32_t, 2>> edges = edges_of(all.complex.triangles);
    for (const auto& edge : all.complex.edges) {
      if (edges.count(edge) == 0) growth.reach_circle(edge);
    }
    return SphereSet{growth.grown()};
  } catch (const std::bad_alloc&) {
    return out_of_memory("growing the balls");
  }
}

}  // namespace medial_vk
