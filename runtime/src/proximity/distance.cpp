#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/loop_watch.h"
#include "base/parallel.h"
#include "proximity/nearest_triangles.h"
#include "proximity/placement.h"

namespace medial_vk {
namespace {

/// The motion from the frame of a to that of b, and the share of a length by which it is wrong.
struct Inverse {
  Pose pose;
  double error;
};

Inverse inverse_of(const Pose& pose) {
  Inverse inverse{{}, 16 * 0x1p-53};
  const auto& r = pose.rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      inverse.pose.rotation[i][j] = r[j][i];
      // The transpose is the inverse but for this; 3 is the greatest ratio of the norm of a matrix to its entries.
      inverse.error = std::max(inverse.error, 3 * std::fabs(dot(r[i], r[j]) - (i == j ? 1 : 0)) + 16 * 0x1p-53);
    }
  }
  inverse.pose.shift = -1.0 * (Pose{inverse.pose.rotation, {0, 0, 0}} * pose.shift);
  return inverse;
}

bool is_in_box(const Point& p, const MeshReport& report, double error) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (p[k] < report.lower[k] - error || p[k] > report.upper[k] + error) return false;
  }
  return true;
}

enum class Holds : std::uint8_t { kNo, kYes, kUnknown };

/// Whether a component of the mesh of `inner` lies in the solid of `outer`, with a point of it in the frame of `inner`.
/// `to_outer` maps from the frame of `inner`, with the error `error`. Surfaces are apart by `apart`: if that is more
/// than all errors, a component is inside as a whole, or outside. An open mesh holds nothing.
Holds holds(const BodySurface& outer, const BodySurface& inner, const Pose& to_outer, double error, double apart,
            const std::stop_token& stop, Point& point) {
  const MeshReport& report = outer.solid.mesh().report;
  if (!report.closed) return Holds::kNo;
  for (const std::array<Point, 6>& extremes : inner.extremes) {
    if (stop.stop_requested()) throw LoopStopped();
    const bool may_be_inside =
        std::ranges::all_of(extremes, [&](const Point& p) { return is_in_box(to_outer * p, report, error); });
    if (!may_be_inside) continue;
    if (apart <= error + outer.solid.rounding()) return Holds::kUnknown;
    if (!outer.solid.contains(to_outer * extremes.front())) continue;
    point = extremes.front();
    return Holds::kYes;
  }
  return Holds::kNo;
}

/// Of two solids whose surfaces are apart, one may lie inside the other: from the distance of the surfaces to that of
/// the solids.
void decide_by_components(const BodySurface& a, const BodySurface& b, const Placement& placement,
                          const std::stop_token& stop, Distance& distance) {
  const Inverse inverse = inverse_of(placement.pose());
  const double size = placement.lengths() + placement.distance() + a.tree.nodes().reach() + b.tree.nodes().reach();
  const auto decide = [&](Holds holds, const Point& point) {
    if (holds == Holds::kNo) return false;
    distance.lower = 0;
    if (holds == Holds::kUnknown) return true;
    distance.upper = 0;
    distance.on_a = distance.on_b = point;
    return true;
  };
  Point of_b = {0, 0, 0}, of_a = {0, 0, 0};
  constexpr double kForward = 16 * 0x1p-53;  // of a mapped point
  const Holds a_holds = holds(a, b, placement.pose(), kForward * size, distance.lower, stop, of_b);
  if (decide(a_holds, placement.pose() * of_b)) return;
  decide(holds(b, a, inverse.pose, inverse.error * size, distance.lower, stop, of_a), of_a);
}

/// Two balls inside may overlap where surfaces touch and do not cross.
void decide_by_balls(const BodyImpl& a, const BodyImpl& b, const Placement& placement, Distance& distance) {
  if (a.inside_tree.is_empty() || b.inside_tree.is_empty()) return;
  BallPair pair;
  if (upper_bound(a, b, placement, std::numeric_limits<double>::infinity(), pair) > 0) return;
  const Ball &ball_a = a.inside[pair.a], &ball_b = b.inside[pair.b];
  const Point centre = placement.pose() * ball_b.centre, away = centre - ball_a.centre;
  const double between = length(away);
  // From the centre of the ball of a towards the other one, no farther than either surface.
  const double step = std::clamp(between - ball_b.radius, 0.0, ball_a.radius);
  distance.lower = distance.upper = 0;
  distance.inside_pair = pair;
  distance.on_a = distance.on_b = between > 0 ? ball_a.centre + (step / between) * away : centre;
}

Status check(const BodyImpl& a, const BodyImpl& b, const DistanceOptions& options) {
  if (!a.surface || !b.surface) {
    return Error{ErrorCode::kUsage, "a distance needs bodies that were created with their meshes"};
  }
  if (!(options.tolerance >= 0 && std::isfinite(options.tolerance))) {
    return Error{ErrorCode::kUsage, "`tolerance` must be finite and not negative"};
  }
  if (!(options.limit >= 0)) return Error{ErrorCode::kUsage, "`limit` must not be negative"};
  return {};
}

/// Precondition: check() accepts the bodies and the options.
Distance distance_of(const Body& a, const Body& b, const Pose& pose, const DistanceOptions& options,
                     const Distance& start, const std::stop_token& stop) {
  const BodyImpl &in_a = Internals::of(a), &in_b = Internals::of(b);
  const Placement placement(in_a, in_b, pose);
  if (!placement.is_in_range()) return {};
  return distance_of(in_a, in_b, placement, options, start, stop);
}

}  // namespace

Distance distance_of(const BodyImpl& a, const BodyImpl& b, const Placement& placement, const DistanceOptions& options,
                     const Distance& start, const std::stop_token& stop) {
  Distance distance = nearest_triangles(a.surface->tree, b.surface->tree, placement, start, options, stop);
  if (options.surfaces_only || distance.upper == 0) return distance;
  if (distance.lower > 0) decide_by_components(*a.surface, *b.surface, placement, stop, distance);
  if (distance.lower == 0 && distance.upper > 0) decide_by_balls(a, b, placement, distance);
  return distance;
}

Result<Distance> distance(const Body& a, const Body& b, const Pose& pose, const DistanceOptions& options,
                          const Distance& start, const std::stop_token& stop) {
  if (Status status = check(Internals::of(a), Internals::of(b), options); !status) return status.error();
  try {
    return distance_of(a, b, pose, options, start, stop);
  } catch (const LoopStopped&) {
    return LoopStopped::error();
  }
}

Status distances(const Body& a, const Body& b, std::span<const Pose> poses, std::span<Distance> results,
                 const DistanceOptions& options, const BatchOptions& batch, const std::stop_token& stop) {
  if (Status status = check(Internals::of(a), Internals::of(b), options); !status) return status;
  constexpr std::size_t kBlock = 64;
  try {
    parallel_blocks(poses.size(), kBlock, batch.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        results[i] = distance_of(a, b, poses[i], options, i > begin ? results[i - 1] : Distance{}, stop);
      }
    });
  } catch (const LoopStopped&) {
    return LoopStopped::error();
  }
  return {};
}

Collision collide(const Body& a, const Body& b, const Pose& pose) {
  const Collision by_balls = distance_bounds(a, b, pose).collision();
  if (by_balls != Collision::kUndecided || !a.has_mesh() || !b.has_mesh()) return by_balls;
  DistanceOptions options;
  options.limit = 0;
  return distance_of(a, b, pose, options, {}, {}).collision();
}

}  // namespace medial_vk
