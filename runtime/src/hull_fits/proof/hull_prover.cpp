#include "hull_fits/proof/hull_prover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "ball_hulls/axis_point.h"
#include "ball_hulls/triangle_gap.h"
#include "base/point_ops.h"
#include "bvh/triangle_distance.h"
#include "hull_fits/proof/separation.h"

namespace medial_vk {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Directions that are tried for a box: it is divided where they do not suffice.
constexpr int kBoxDirections = 3;
/// The greatest number of parts of a hull whose sides are decided one by one beside an open boundary.
constexpr std::size_t kMostParts = 4096;

/// The planes between one hull and all triangles.
class Planes {
 public:
  Planes(const Bvh& bvh, const BallHull& hull) : bvh_(bvh), hull_(hull), query_(hull), gap_(query_) {}

  PlaneProof find() {
    std::array<std::uint32_t, 2 * Bvh::kMaxDepth + 2> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const BvhNode& node = bvh_.nodes()[stack[--size]];
      if (is_beside(node.box)) {
        ++proof_.planes;
      } else if (node.count == 0) {
        stack[size++] = node.first;
        stack[size++] = node.first + 1;
      } else {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) separate(bvh_.corners()[i]);
      }
    }
    return proof_;
  }

 private:
  /// Directions by projections to and fro: from the middle of the box to the nearest ball, and from there to the box.
  bool is_beside(const BvhBox& box) const {
    std::array<Point, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
      corners[i] = {(i & 1u) != 0 ? box.upper[0] : box.lower[0], (i & 2u) != 0 ? box.upper[1] : box.lower[1],
                    (i & 4u) != 0 ? box.upper[2] : box.lower[2]};
    }
    Point in_box = 0.5 * (box.lower + box.upper);
    for (int k = 0; k < kBoxDirections; ++k) {
      const Ball ball = ball_at(hull_, query_.nearest(in_box).weight);
      for (std::size_t i = 0; i < 3; ++i) in_box[i] = std::clamp(ball.centre[i], box.lower[i], box.upper[i]);
      const Point direction = in_box - ball.centre;
      if (!(dot(direction, direction) > ball.radius * ball.radius)) return false;
      if (separation(corners, hull_, direction) > 0) return true;
    }
    return false;
  }

  void separate(const std::array<Point, 3>& triangle) {
    ++proof_.planes;
    double best = best_of_normals(triangle);
    if (best > 0) return;
    const Ball ball = ball_at(hull_, gap_.nearest(triangle).weight);
    best = std::max(best, separation(triangle, hull_, nearest_on_triangle(ball.centre, triangle).offset));
    // A plane that only touches both proves nothing, and a lack of 0 would say that there is one.
    if (!(best > 0)) proof_.lack = std::max({proof_.lack, -best, std::numeric_limits<double>::denorm_min()});
  }

  /// Of the planes along the triangle, which are exact where a face of the hull lies along it.
  double best_of_normals(const std::array<Point, 3>& triangle) const {
    const Point normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double first = separation(triangle, hull_, normal);
    return first > 0 ? first : std::max(first, separation(triangle, hull_, -1.0 * normal));
  }

  const Bvh& bvh_;
  const BallHull& hull_;
  AxisQuery query_;
  TriangleGap gap_;
  PlaneProof proof_;
};

/// True if all of the hull is inside an open boundary that it does not meet: it is the union of the hulls of parts of
/// its axis, each of which is in a ball around its middle on which the side does not change.
bool is_inside_of_open(const Solid& solid, const BallHull& hull) {
  // Middles of parts are rounded at most kMostParts times, each by less than half a unit in the last place of the
  // greatest coordinate.
  double greatest = 0;
  for (const Ball& ball : hull.balls()) {
    for (const double x : ball.centre) greatest = std::max(greatest, std::fabs(x));
  }
  const double slack = 0x1p-40 * greatest;
  std::vector<BallHull> parts = {hull};
  for (std::size_t tested = 0; !parts.empty(); ++tested) {
    if (tested == kMostParts) return false;
    const BallHull part = parts.back();
    parts.pop_back();
    Point middle = part.corners[0].centre;
    for (std::uint32_t i = 1; i < part.count; ++i) middle = middle + part.corners[i].centre;
    middle = (1.0 / part.count) * middle;
    double reach = 0;
    for (const Ball& ball : part.balls()) reach = std::max(reach, length(ball.centre - middle) + ball.radius);
    // The computed middle, on whose side all depends, and the exact one, which the part holds, are on one side.
    if (!(solid.distance(middle) > slack + 2 * solid.rounding())) return false;
    const SolidSide side = solid.side_around(middle, reach * (1 + 0x1p-40) + slack);
    if (side == SolidSide::kOutside) return false;
    if (side == SolidSide::kInside) continue;
    if (part.count == 1) return false;
    // Halves across the longest edge of the axis.
    std::uint32_t from = 0, to = 1;
    for (const auto& [i, j] : {std::array<std::uint32_t, 2>{1, 2}, std::array<std::uint32_t, 2>{2, 0}}) {
      if (part.count < 3) break;
      if (length(part.corners[i].centre - part.corners[j].centre) >
          length(part.corners[from].centre - part.corners[to].centre)) {
        from = i;
        to = j;
      }
    }
    const Ball &a = part.corners[from], &b = part.corners[to];
    const Ball half = {0.5 * (a.centre + b.centre), 0.5 * (a.radius + b.radius)};
    BallHull first = part, second = part;
    first.corners[to] = half;
    second.corners[from] = half;
    parts.push_back(first);
    parts.push_back(second);
  }
  return true;
}

}  // namespace

PlaneProof prove_hull(const Solid& solid, const BallHull& hull) {
  // A number that is not finite would make every comparison false.
  for (const Ball& ball : hull.balls()) {
    if (!(ball.radius >= 0) || !std::isfinite(dot(ball.centre, ball.centre) + ball.radius)) return {0, kInfinity};
  }
  PlaneProof proof = Planes(solid.bvh(), hull).find();
  const Point& within = hull.corners[0].centre;
  // Nearer to the boundary than by its rounding, the side of a point is not certain.
  if (!solid.contains(within) || !(solid.distance(within) > 2 * solid.rounding())) proof.lack = kInfinity;
  if (proof.proved() && !solid.mesh().report.closed && !is_inside_of_open(solid, hull)) proof.lack = kInfinity;
  return proof;
}

HullProof prove_hulls(const Solid& solid, std::span<const BallHull> hulls, const Threads& threads) {
  std::vector<PlaneProof> proofs(hulls.size());
  for_all(hulls.size(), 1, threads, [&](std::size_t i) { proofs[i] = prove_hull(solid, hulls[i]); });
  HullProof all;
  all.tested = hulls.size();
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    all.planes += proofs[i].planes;
    if (proofs[i].proved()) continue;
    if (all.failed++ == 0) all.first_failure = static_cast<std::uint32_t>(i);
    all.greatest_lack = std::max(all.greatest_lack, proofs[i].lack);
  }
  return all;
}

}  // namespace medial_vk
