#include "proximity/surface_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "proximity/groups/smallest_ball_centre.h"

namespace medial_vk {
namespace {

/// Chooses the balls of a tree. Triangles are given by their indices.
class BallsOfTriangles {
 public:
  using Chosen = std::span<const std::uint32_t>;

  BallsOfTriangles(const Solid& solid, const Point& origin)
      : solid_(solid), mesh_(solid.mesh().mesh), origin_(origin) {}

  FloatBall around(Chosen triangles) const {
    FloatBall ball = float_ball_at(deepest_centre(triangles) - origin_);
    const Point centre = point_of(ball);
    double radius = 0, size = 0;
    for_corners(triangles, [&](const Point& corner) {
      const Point relative = corner - origin_;
      radius = std::max(radius, length(relative - centre));
      size = std::max(size, length(relative));
    });
    ball.radius = rounded_up(radius + 0x1p-52 * size);
    const double depth =
        triangles.size() == 1 ? 0 : depth_of(centre + origin_) - 0x1p-52 * (length(centre) + length(origin_));
    ball.excess = rounded_up(ball.radius - (depth > 0 ? depth : -static_cast<double>(ball.radius)));
    return ball;
  }

 private:
  template <class Visit>
  void for_corners(Chosen triangles, const Visit& visit) const {
    for (const std::uint32_t t : triangles) {
      for (const std::uint32_t v : mesh_.triangles[t]) visit(mesh_.vertices[v]);
    }
  }

  /// A ball of this radius is known to lie in the solid; 0: none is. Where a mesh is open, the solid of a body is its
  /// surface.
  double depth_of(const Point& c) const {
    const double depth = solid_.distance(c) - solid_.rounding();
    return depth > 0 && solid_.mesh().report.closed && solid_.contains(c) ? depth : 0;
  }

  /// The distances from a point to the nearest and to the farthest corner.
  struct Reaches {
    double nearest, farthest;
  };
  Reaches reaches_from(const Point& c, Chosen triangles) const {
    double least_squared = std::numeric_limits<double>::infinity(), greatest_squared = 0;
    for_corners(triangles, [&](const Point& corner) {
      const Point away = corner - c;
      const double squared = dot(away, away);
      least_squared = std::min(least_squared, squared);
      greatest_squared = std::max(greatest_squared, squared);
    });
    return {std::sqrt(least_squared), std::sqrt(greatest_squared)};
  }

  /// A centre with the least excess that was found so far.
  struct Best {
    Point centre;
    double excess;
  };

  /// A centre outside the solid gets a smaller excess than it has. That costs time, and no truth. One outside the box
  /// is none: farther and farther away the ball becomes a half-space, and its numbers lose their digits.
  bool improve(Chosen triangles, const Point& c, Best& best) const {
    const MeshReport& report = solid_.mesh().report;
    if (least(c, report.lower) != report.lower || greatest(c, report.upper) != report.upper) return false;
    const auto [nearest, farthest] = reaches_from(c, triangles);
    // The first triangle that is too near ends most tests.
    const double required = farthest - best.excess;
    if (required >= nearest || (required > 0 && solid_.bvh().any_within(c, required))) return false;
    const BvhHit hit = solid_.bvh().closest(c, nearest);
    const double distance = hit.triangle == BvhHit().triangle ? nearest : std::sqrt(hit.squared_distance);
    const double excess = farthest - distance;
    if (!(excess < best.excess)) return false;
    best = {c, excess};
    return true;
  }

  /// From the middle of the patch ever deeper below it while the excess becomes smaller, then also aside. Single
  /// triangles, which are most of the work and are compared by planes before their balls, have shallow balls.
  Point deepest_centre(Chosen triangles) const {
    const Point middle = middle_of(triangles), inwards = inwards_from(triangles);
    const double radius = reaches_from(middle, triangles).farthest;
    Best best = {middle, radius};  // the boundary is near
    if (!(radius > 0) || inwards == Point{0, 0, 0}) return middle;
    if (triangles.size() == 1) {
      for (const double share : {0.5, 1.0}) improve(triangles, middle + share * radius * inwards, best);
      return best.centre;
    }
    double depth = 0.5 * radius;
    while (improve(triangles, middle + depth * inwards, best)) depth *= 2;
    improve(triangles, middle + 0.75 * depth * inwards, best);
    look_around(triangles, 0.25 * depth, best);
    return best.centre;
  }

  /// Steps along the axes, which become shorter where none improves.
  void look_around(Chosen triangles, double step, Best& best) const {
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
      bool any = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const double by : {-step, step}) {
          Point c = best.centre;
          c[axis] += by;
          any = improve(triangles, c, best) || any;
        }
      }
      if (!any) step *= 0.5;
    }
  }

  Point middle_of(Chosen triangles) const {
    constexpr std::size_t kSteps = 32;
    return near_smallest_ball_centre(
        mesh_.vertices[mesh_.triangles[triangles.front()][0]], kSteps,
        [&](const auto& visit) { for_corners(triangles, [&](const Point& corner) { visit(corner, 0.0); }); });
  }

  /// A unit vector against the mean normal; null where there is none.
  Point inwards_from(Chosen triangles) const {
    Point normal = {0, 0, 0};
    for (const std::uint32_t t : triangles) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const Point& from = mesh_.vertices[a];
      normal = normal + cross(mesh_.vertices[b] - from, mesh_.vertices[c] - from);
    }
    const double size = length(normal);
    return size > 0 ? (-1 / size) * normal : Point{0, 0, 0};
  }

  const Solid& solid_;
  const Mesh& mesh_;
  Point origin_;
};

}  // namespace

SurfaceTree SurfaceTree::build(const Solid& solid, const Point& centre, unsigned threads, LoopWatch& watch) {
  SurfaceTree tree(solid.mesh().mesh);
  std::vector<Point> middles;
  middles.reserve(tree.size());
  for (std::uint32_t t = 0; t < tree.size(); ++t) {
    const auto [a, b, c] = tree.corners(t);
    middles.push_back((1.0 / 3) * (a + b + c));
  }
  const BallsOfTriangles balls(solid, centre);
  tree.nodes_ = NodeTree::build(
      middles, [&](std::span<const std::uint32_t> triangles) { return balls.around(triangles); }, threads, {}, &watch);
  tree.find_places();
  tree.collect_triangles(centre);
  tree.collect_boxes(centre, threads, watch);
  return tree;
}

void SurfaceTree::find_places() {
  std::uint32_t lowest = 0, others = 0;
  place_.reserve(nodes_.size());
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) place_.push_back(nodes_.node(i).is_lowest ? lowest++ : others++);
  triangles_.resize(lowest);
  boxes_.resize(others);
}

void SurfaceTree::collect_triangles(const Point& centre) {
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const BodyNode& node = nodes_.node(i);
    if (!node.is_lowest) continue;
    EightTriangles& triangles = triangles_[place_[i]];
    for (std::uint32_t k = 0; k < BodyNode::kWidth; ++k) {
      const Corners corners_of_slot = corners(node.below[k < node.count ? k : 0]);
      for (std::size_t c = 0; c < 3; ++c) {
        const std::array<float, 3> corner = float_ball_at(corners_of_slot[c] - centre).centre;
        for (std::size_t axis = 0; axis < 3; ++axis) triangles[c][axis][k] = corner[axis];
      }
    }
  }
}

void SurfaceTree::collect_boxes(const Point& centre, unsigned threads, LoopWatch& watch) {
  constexpr std::size_t kNodesOfBlock = 8;
  parallel_for(nodes_.size(), kNodesOfBlock, threads, [&](std::size_t i) {
    const BodyNode& node = nodes_.node(static_cast<std::uint32_t>(i));
    if (node.is_lowest) return;
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t k = 0; k < node.count; ++k) {
      watch.check();
      triangles.clear();
      add_triangles_below(node, k, triangles);
      boxes_[place_[i]].set(k, box_of(triangles, centre));
    }
  });
}

void SurfaceTree::add_triangles_below(const BodyNode& node, std::uint32_t slot,
                                      std::vector<std::uint32_t>& triangles) const {
  if (node.is_lowest) {
    triangles.push_back(node.below[slot]);
    return;
  }
  const BodyNode& below = nodes_.node(node.below[slot]);
  for (std::uint32_t k = 0; k < below.count; ++k) add_triangles_below(below, k, triangles);
}

FloatBox SurfaceTree::box_of(std::span<const std::uint32_t> triangles, const Point& centre) const {
  std::vector<Point> points;
  points.reserve(3 * triangles.size());
  Point normal = {0, 0, 0};
  for (const std::uint32_t t : triangles) {
    const auto [a, b, c] = corners(t);
    normal = normal + cross(b - a, c - a);
    for (const Point& corner : {a, b, c}) points.push_back(corner - centre);
  }
  return box_around(points, normal);
}

}  // namespace medial_vk
