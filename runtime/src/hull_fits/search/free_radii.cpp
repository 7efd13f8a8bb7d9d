#include "hull_fits/search/free_radii.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "ball_hulls/triangle_gap.h"
#include "base/point_ops.h"
#include "bvh/triangle_distance.h"
#include "hull_fits/search/radius_program.h"

namespace medial_vk {
namespace {

/// Walks after which a hull is given up: each ends with a constraint that the last radii violated.
constexpr int kMostWalks = 24;

constexpr std::array<std::array<double, 3>, 10> kSamples = {{{.5, .5, 0},
                                                             {.25, .75, 0},
                                                             {.75, .25, 0},
                                                             {1. / 3, 1. / 3, 1. / 3},
                                                             {.5, 0, .5},
                                                             {0, .5, .5},
                                                             {0, .25, .75},
                                                             {0, .75, .25},
                                                             {.25, 0, .75},
                                                             {.75, 0, .25}}};

/// Weights of balls inside of the axis of a hull with so many balls.
std::span<const std::array<double, 3>> samples_of(std::uint32_t count) {
  return std::span(kSamples).first(count == 1 ? 0 : count == 2 ? 3 : kSamples.size());
}

}  // namespace

/// Passes over the triangles that may be in a hull.
class FreeRadii::Walk {
 public:
  Walk(const Bvh& bvh, const NodeSlabs& slabs) : bvh_(bvh), slabs_(slabs) {}

  /// The ball of the hull into which a triangle reaches deepest, if one is deeper than `tolerance`.
  std::optional<AxisPoint> deepest(const AxisQuery& query, double tolerance) const {
    const HullBounds box = bounds_of(query.hull());
    const TriangleGap gap(query);
    std::optional<AxisPoint> found;
    std::array<std::uint32_t, 2 * Bvh::kMaxDepth + 2> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const std::uint32_t index = stack[--size];
      const BvhNode& node = bvh_.nodes()[index];
      if (!meet(box, node.box) || slabs_.beside(index, query.hull(), tolerance)) continue;
      if (is_apart(query, node.box, tolerance)) continue;
      if (node.count == 0) {
        stack[size++] = node.first;
        stack[size++] = node.first + 1;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const std::array<Point, 3>& triangle = bvh_.corners()[i];
        if (is_apart(query, triangle, tolerance)) continue;
        const AxisPoint nearest = gap.nearest(triangle);
        if (!(nearest.distance < -tolerance)) continue;
        found = nearest;
        tolerance = -nearest.distance;  // the deepest so far
      }
    }
    return found;
  }

 private:
  static bool meet(const HullBounds& bounds, const BvhBox& box) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (box.lower[k] > bounds.upper[k] || box.upper[k] < bounds.lower[k]) return false;
    }
    return true;
  }

  static bool is_apart(const AxisQuery& query, const BvhBox& box, double tolerance) {
    // A plane between the ball that is nearest to the box, by two projections, and the box.
    Point in_box = 0.5 * (box.lower + box.upper);
    const double half = 0.5 * length(box.upper - box.lower);
    for (int i = 0; i < 2; ++i) {
      const AxisPoint nearest = query.nearest(in_box);
      if (i == 0 && nearest.distance + tolerance >= half) return true;
      const Ball ball = ball_at(query.hull(), nearest.weight);
      for (std::size_t k = 0; k < 3; ++k) in_box[k] = std::clamp(ball.centre[k], box.lower[k], box.upper[k]);
      const Point offset = in_box - ball.centre;
      const double distance = length(offset);
      if (distance <= ball.radius) return false;
      double least = 0;
      for (std::size_t k = 0; k < 3; ++k) least += std::min(offset[k] * box.lower[k], offset[k] * box.upper[k]);
      if (least + tolerance * distance >= greatest_product(query.hull(), offset, distance)) return true;
    }
    return false;
  }

  static bool is_apart(const AxisQuery& query, const std::array<Point, 3>& triangle, double tolerance) {
    const BallHull& hull = query.hull();
    const Point middle = (1.0 / 3) * (triangle[0] + triangle[1] + triangle[2]);
    const AxisPoint nearest = query.nearest(middle);
    // Signed distances change by no more than the distance of two points.
    double reach = 0;
    for (const Point& corner : triangle) reach = std::max(reach, dot(corner - middle, corner - middle));
    const double margin = nearest.distance + tolerance;
    if (margin >= 0 && margin * margin >= reach) return true;
    const Point offset = middle - ball_at(hull, nearest.weight).centre;
    const double distance = length(offset);
    const double least = std::min({dot(offset, triangle[0]), dot(offset, triangle[1]), dot(offset, triangle[2])});
    if (least + tolerance * distance >= greatest_product(hull, offset, distance)) return true;
    const Point normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double extent = length(normal);
    const double height = dot(normal, triangle[0]);
    if (height + tolerance * extent >= greatest_product(hull, normal, extent)) return true;
    return -height + tolerance * extent >= greatest_product(hull, -1.0 * normal, extent);
  }

  static double greatest_product(const BallHull& hull, const Point& direction, double extent) {
    double greatest = -std::numeric_limits<double>::infinity();
    for (const Ball& ball : hull.balls()) {
      greatest = std::max(greatest, dot(direction, ball.centre) + extent * ball.radius);
    }
    return greatest;
  }

  const Bvh& bvh_;
  const NodeSlabs& slabs_;
};

std::optional<BallHull> FreeRadii::fit(const std::array<Point, 3>& centres, std::uint32_t count, bool equal,
                                       const IsPromising& is_promising) const {
  BallHull hull;
  hull.count = count;
  std::array<double, 3> greatest = {};
  for (std::uint32_t i = 0; i < count; ++i) {
    hull.corners[i].centre = centres[i];
    greatest[i] = solid_.distance(centres[i]);
    if (greatest[i] < least_) return std::nullopt;
  }
  if (!solid_.contains(centres[0])) return std::nullopt;
  if (equal) greatest[0] = *std::min_element(greatest.begin(), greatest.begin() + count);
  RadiusProgram program(equal ? 1 : count, least_, greatest);
  const auto bound = [&](const std::array<double, 3>& weight, double radius) {
    return program.add(equal ? std::array<double, 3>{1, 0, 0} : weight, radius);
  };
  // Distances at a few balls inside of the axis leave little to the walks, and end most hopeless ones.
  for (const std::array<double, 3>& weight : samples_of(count)) {
    if (!bound(weight, solid_.distance(ball_at(hull, weight).centre))) return std::nullopt;
  }
  const Walk walk(solid_.bvh(), slabs_);
  for (int walks = 0; walks < kMostWalks; ++walks) {
    for (std::uint32_t i = 0; i < count; ++i) hull.corners[i].radius = program.radii()[equal ? 0 : i];
    if (walks == 0 && is_promising && !is_promising(hull)) return std::nullopt;
    const AxisQuery query(hull);
    const std::optional<AxisPoint> deepest = walk.deepest(query, tolerance_);
    if (!deepest) return hull;
    // |p - c(l)| - r(l) >= 0 is linear in the radii.
    if (!bound(deepest->weight, deepest->distance + ball_at(hull, deepest->weight).radius)) return std::nullopt;
  }
  return std::nullopt;
}

double FreeRadii::greatest_depth(const BallHull& hull) const {
  const std::optional<AxisPoint> deepest = Walk(solid_.bvh(), slabs_).deepest(AxisQuery(hull), 0);
  return deepest ? -deepest->distance : 0;
}

}  // namespace medial_vk
