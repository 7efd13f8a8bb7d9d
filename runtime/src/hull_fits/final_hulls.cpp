#include "hull_fits/final_hulls.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ball_hulls/axis_point.h"
#include "base/point_ops.h"
#include "sphere_fits/quality/branch_and_bound.h"
#include "sphere_fits/quality/triangle_part.h"

namespace medial_vk {
namespace {

/// The radii give way once for the lack of planes, and again where the smaller hull has other planes.
constexpr int kMostShrinks = 4;
/// The difference of the bounds of a gap, of the diagonal, and of a goal.
constexpr double kGapOfDiagonal = 1e-3, kGapOfGoal = 0.05;
/// Closed forms have errors of some units in the last place of the greatest coordinate.
double gap_slack(const Solid& solid) { return 4 * solid.rounding(); }

BallHull shrunk(BallHull hull, double by) {
  for (std::uint32_t i = 0; i < hull.count; ++i) hull.corners[i].radius -= by;
  return hull;
}

bool has_radii(const BallHull& hull) {
  return std::ranges::all_of(hull.balls(), [](const Ball& ball) { return ball.radius > 0; });
}

/// Of the radii of a hull that reaches into an opening of the boundary, until its side is known.
constexpr double kShareBesideOpening = 0.85;
constexpr int kMostScalings = 20;

/// The hull with radii for which the proof succeeds; no value: none were found.
std::optional<BallHull> proved(const Solid& solid, BallHull hull) {
  int shrinks = 0, scalings = 0;
  while (has_radii(hull)) {
    const PlaneProof proof = prove_hull(solid, hull);
    if (proof.proved()) return hull;
    if (std::isfinite(proof.lack)) {
      if (++shrinks > kMostShrinks) return std::nullopt;
      // Smaller differences are lost to the rounding of radii, and of the planes across the hull.
      const HullBounds box = bounds_of(hull);
      hull = shrunk(hull, std::max(proof.lack * (1 + 0x1p-20), 0x1p-46 * length(box.upper - box.lower)));
    } else {
      if (solid.mesh().report.closed || ++scalings > kMostScalings) return std::nullopt;
      for (std::uint32_t i = 0; i < hull.count; ++i) hull.corners[i].radius *= kShareBesideOpening;
    }
  }
  return std::nullopt;
}

/// Distances to many hulls: by their boxes.
class NearestHull {
 public:
  explicit NearestHull(std::span<const BallHull> hulls) {
    for (const BallHull& hull : hulls) {
      queries_.emplace_back(hull);
      boxes_.push_back(bounds_of(hull));
    }
  }

  struct Found {
    double distance;  // at least 0
    std::size_t hull;
  };

  Found nearest(const Point& p) const {
    Found found = {HUGE_VAL, 0};
    for (std::size_t i = 0; i < queries_.size(); ++i) {
      const Point beside = greatest(greatest(boxes_[i].lower - p, p - boxes_[i].upper), Point{});
      if (dot(beside, beside) >= found.distance * found.distance) continue;
      const double distance = std::max(0.0, queries_[i].distance(p));
      if (distance < found.distance) found = {distance, i};
      if (distance == 0) break;
    }
    return found;
  }

  /// Signed distances are convex: in a triangle they are at most the greatest at the corners.
  double greatest_at_corners(std::size_t hull, const TrianglePart& part) const {
    double most = -HUGE_VAL;
    for (const Point& corner : part.corner) most = std::max(most, queries_[hull].distance(corner));
    return most;
  }

 private:
  std::vector<AxisQuery> queries_;
  std::vector<HullBounds> boxes_;
};

double gap_tolerance(const Solid& solid, double goal) {
  const double width = kGapOfDiagonal * solid.diagonal();
  return goal > 0 ? std::min(width, kGapOfGoal * goal) : width;
}

}  // namespace

FreedHulls free_hulls(const Solid& solid, std::span<const BallHull> hulls, const Threads& threads) {
  std::vector<std::optional<BallHull>> freed(hulls.size());
  for_all(hulls.size(), 1, threads, [&](std::size_t i) { freed[i] = proved(solid, hulls[i]); });
  FreedHulls result;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    if (!freed[i]) continue;
    for (std::uint32_t k = 0; k < hulls[i].count; ++k) {
      result.greatest_shrink =
          std::max(result.greatest_shrink, hulls[i].corners[k].radius - freed[i]->corners[k].radius);
    }
    result.hulls.push_back(*freed[i]);
  }
  return result;
}

Bounds measure_hull_gap(const Solid& solid, std::span<const BallHull> hulls, double goal, const Threads& threads) {
  const NearestHull nearest(hulls);
  const Mesh& mesh = solid.mesh().mesh;
  std::vector<TrianglePart> parts;
  parts.reserve(mesh.triangles.size());
  for (const Triangle& triangle : mesh.triangles) {
    parts.push_back({{mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]}});
  }
  const auto evaluate = [&](const TrianglePart& part, double) -> CellBounds {
    const Point middle = part.middle();
    const auto [distance, hull] = nearest.nearest(middle);
    return {distance, std::min(distance + part.reach(middle), nearest.greatest_at_corners(hull, part))};
  };
  const SearchLimits limits = {.tolerance = gap_tolerance(solid, goal), .threads = threads};
  const Bounds found = bound_supremum(std::move(parts), 0, limits, evaluate, split_part);
  const double slack = gap_slack(solid);
  return {std::max(0.0, found.lower - slack), found.upper + slack};
}

double hull_gap_width(const Solid& solid, double goal) { return gap_tolerance(solid, goal) + 2 * gap_slack(solid); }

}  // namespace medial_vk
