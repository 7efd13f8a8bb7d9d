#include "sphere_fits/quality/envelope_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>

#include "base/host_memory.h"
#include "base/point_ops.h"
#include "sphere_fits/quality/triangle_part.h"

namespace medial_vk {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

struct Cube {
  Point centre;
  double half;  ///< Of its side.
  // Of the cube that this is a part of: its nearest ball, and the point of the boundary nearest to its centre.
  mutable std::uint32_t ball = 0;
  mutable Point at_boundary = {HUGE_VAL, 0, 0};

  double reach() const { return half * 1.7320508075688775; }
  /// The greatest distance of its points from p.
  double farthest(const Point& p) const {
    Point out;
    for (std::size_t k = 0; k < 3; ++k) out[k] = std::fabs(p[k] - centre[k]) + half;
    return length(out);
  }
};

void split_cube(const Cube& cube, std::vector<Cube>& parts) {
  const double h = cube.half / 2;
  for (int k = 0; k < 8; ++k) {
    parts.push_back(
        {{cube.centre[0] + (k & 1 ? h : -h), cube.centre[1] + (k & 2 ? h : -h), cube.centre[2] + (k & 4 ? h : -h)},
         h,
         cube.ball,
         cube.at_boundary});
  }
}

Cube cube_around(const Point& lower, const Point& upper) {
  double half = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) half = std::max(half, (upper[axis] - lower[axis]) / 2);
  return {0.5 * (lower + upper), half * (1 + 1e-12)};
}

Cube cube_around(const std::vector<Ball>& balls) {
  Point lower = balls.front().centre, upper = lower;
  for (const Ball& ball : balls) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], ball.centre[axis] - ball.radius);
      upper[axis] = std::max(upper[axis], ball.centre[axis] + ball.radius);
    }
  }
  return cube_around(lower, upper);
}

/// A part of the boundary, with a point of the envelope that is near to it or to the part that it comes from.
struct Patch {
  TrianglePart part;
  mutable Point at_envelope = {HUGE_VAL, 0, 0};

  /// Tries another point of the envelope. Returns the distance of the part's points from that known so far: the
  /// greatest, which is at a corner.
  double farthest(const Point& at) const {
    const double now = part.reach(at_envelope), then = part.reach(at);
    if (then < now) at_envelope = at;
    return std::min(now, then);
  }
};

void split_patch(const Patch& patch, std::vector<Patch>& patches) {
  std::vector<TrianglePart> parts;
  split_part(patch.part, parts);
  for (const TrianglePart& part : parts) patches.push_back({part, patch.at_envelope});
}

Bounds greater(const Bounds& a, const Bounds& b) { return {std::max(a.lower, b.lower), std::max(a.upper, b.upper)}; }

class Measure {
 public:
  Measure(const Solid& solid, const Envelope& envelope, const EnvelopeOptions& options)
      : solid_(solid), envelope_(envelope), tree_(envelope.tree()), options_(options) {
    // Distances here are lengths of differences: like those of the solid, they have errors of some units of roundoff of
    // the coordinates; those to the envelope, errors of its tolerance.
    const Cube box = cube_around(tree_.balls());
    slack_ = solid.rounding() + 8 * 0x1p-53 * (length(box.centre) + 2 * box.half);
    limits_.tolerance = options.tolerance * solid.diagonal();
    limits_.cells = options.cells;
    limits_.threads = options.threads;
    const PreparedMesh& mesh = solid.mesh();
    parts_.reserve(mesh.mesh.triangles.size());
    for (const Triangle& t : mesh.mesh.triangles) {
      parts_.push_back({{mesh.mesh.vertices[t[0]], mesh.mesh.vertices[t[1]], mesh.mesh.vertices[t[2]]}});
    }
  }

  EnvelopeDistances all() {
    EnvelopeDistances d;
    if (!options_.known_cover) {
      d.boundary_to_balls = boundary_to_balls();
      d.solid_to_balls = solid_to_balls(d.boundary_to_balls);
    }
    if (!options_.known_inside) d.balls_to_solid = balls_to_solid();
    // No point of the boundary lies in the interior of balls that are inside.
    d.boundary_to_envelope =
        options_.known_inside ? d.boundary_to_balls : boundary_to_envelope(d.boundary_to_balls.lower);
    d.envelope_to_boundary = envelope_to_boundary();
    return d;
  }

  Bounds between_surfaces() const {
    return greater(boundary_to_envelope(boundary_to_balls().lower), envelope_to_boundary());
  }

  Bounds boundary_to_balls() const {
    const auto evaluate = [&](const TrianglePart& part, double) -> CellBounds {
      const Point middle = part.middle();
      const NearestBall nearest = tree_.nearest(middle);
      return {nearest.distance, bound_over(part, middle, nearest)};
    };
    return rounded(bound_supremum(parts_, 0, limits_, evaluate, split_part), slack_);
  }

 private:
  Bounds rounded(const Bounds& bounds, double slack) const {
    return {std::max(0.0, bounds.lower - slack), bounds.upper + slack};
  }

  /// A ball's |p - c| - r is convex: in the part, it is at most the greatest of its values at corners.
  double bound_over(const TrianglePart& part, const Point& middle, const NearestBall& nearest) const {
    const Ball& ball = tree_.balls()[nearest.ball];
    return std::min(nearest.distance + part.reach(middle), part.reach(ball.centre) - ball.radius);
  }

  /// If the mesh is closed, the farthest point is on its boundary or critical.
  Bounds solid_to_balls(const Bounds& at_boundary) const {
    const MeshReport& report = solid_.mesh().report;
    const auto evaluate = [&](const Cube& cube, double known) -> CellBounds {
      const double reach = cube.reach();
      const NearestBall nearest = tree_.nearest(cube.centre);
      const double distance = nearest.distance;
      // |p - c| - r is convex.
      const Ball& ball = tree_.balls()[nearest.ball];
      const double bound = std::min(distance + reach, cube.farthest(ball.centre) - ball.radius);
      if (bound <= known + limits_.tolerance) return {kNone, bound};
      if (report.closed && has_no_farthest_point(cube, nearest)) return {};
      SolidSide side = SolidSide::kUnknown;
      if (!solid_.bvh().any_within(cube.centre, reach + slack_)) side = solid_.side_around(cube.centre, reach + slack_);
      if (side == SolidSide::kOutside) return {};
      const bool is_inside = side == SolidSide::kInside || solid_.contains(cube.centre);
      return {is_inside ? distance : kNone, bound};
    };
    const Bounds found = rounded(bound_supremum(std::vector<Cube>{cube_around(report.lower, report.upper)},
                                                at_boundary.lower, limits_, evaluate, split_cube),
                                 slack_);
    return report.closed ? greater(found, at_boundary) : found;
  }

  /// True only if the distance to the balls has no local maximum in the cube: it increases everywhere in it along one
  /// direction, as do the distances to all balls that may be the nearest one somewhere in it.
  bool has_no_farthest_point(const Cube& cube, const NearestBall& nearest) const {
    const double reach = cube.reach() + slack_;
    const Point along = cube.centre - tree_.balls()[nearest.ball].centre;
    const double size = length(along);
    if (!(size > 0)) return false;
    const Point direction = (1 / size) * along;
    return !tree_.any_within(cube.centre, nearest.distance + 2 * reach, [&](std::uint32_t i, double) {
      return !(dot(direction, cube.centre - tree_.balls()[i].centre) > reach);
    });
  }

  /// How far a ball reaches out of the solid at most, and how far a point of it does.
  struct Reach {
    double most, least;
  };
  /// From a centre inside the solid, the boundary comes first on the way to a point of the ball outside. Where the mesh
  /// is open, there may be none.
  Reach reach_of(const Ball& ball) const {
    const bool is_inside = solid_.contains(ball.centre);
    const BvhHit hit = solid_.closest(ball.centre);
    const double distance = std::sqrt(hit.squared_distance), most = ball.radius + (is_inside ? -distance : distance);
    if (is_inside && most <= 0) return {0, 0};
    if (!solid_.mesh().report.closed) return {HUGE_VAL, 0};
    const Point apart = is_inside ? hit.point - ball.centre : ball.centre - hit.point;
    const Point at = distance > 0 ? ball.centre + (ball.radius / distance) * apart : ball.centre;
    return {most, solid_.contains(at) ? 0 : solid_.distance(at)};
  }

  /// Of points in balls that may reach out farther than is known of one of them.
  Bounds balls_to_solid() const {
    const std::vector<Ball>& balls = tree_.balls();
    std::vector<Reach> reaches(balls.size());
    for_all(balls.size(), 4, limits_.threads, [&](std::size_t i) { reaches[i] = reach_of(balls[i]); });
    if (std::all_of(reaches.begin(), reaches.end(), [](const Reach& reach) { return reach.most <= 0; })) return {};
    // The greatest distances usually are at the vertices of the envelope, which belong to the balls.
    double lower = greatest_at_vertices([&](const Point& p) { return solid_.contains(p) ? 0.0 : solid_.distance(p); });
    for (const Reach& reach : reaches) lower = std::max(lower, reach.least);
    Bounds known = {lower, lower};
    std::vector<Ball> others;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      if (reaches[i].most > lower + limits_.tolerance) {
        others.push_back(balls[i]);
      } else {
        known.upper = std::max(known.upper, reaches[i].most);
      }
    }
    if (!others.empty()) known = greater(known, greatest_outside(others, lower));
    return rounded(known, slack_ + envelope_.distance_error());
  }

  Bounds greatest_outside(const std::vector<Ball>& others, double lower) const {
    const NearestBallTree tree(others);
    const auto evaluate = [&](const Cube& cube, double known) -> CellBounds {
      const double reach = cube.reach();
      const NearestBall nearest = tree.nearest(cube.centre);
      if (nearest.distance > reach + slack_) return {};
      const BvhHit hit = solid_.closest(cube.centre);
      const double distance = std::sqrt(hit.squared_distance);
      // No point of the cube is farther from the boundary than from this point of it.
      const double bound = cube.farthest(hit.point);
      if (bound <= known + limits_.tolerance) return {kNone, bound};
      const double sign = solid_.contains(cube.centre) ? -1 : 1;
      if (sign < 0 && distance > reach + slack_) return {};
      const Point reached = nearest.distance > 0 ? point_of_sphere(others[nearest.ball], cube.centre) : cube.centre;
      const double value = solid_.distance(reached);
      if (value <= known || solid_.contains(reached)) return {kNone, sign > 0 ? bound : reach - distance};
      return {value, sign > 0 ? bound : reach - distance};
    };
    return bound_supremum(std::vector<Cube>{cube_around(others)}, lower, limits_, evaluate, split_cube);
  }

  template <class Distance>
  double greatest_at_vertices(Distance distance) const {
    const std::vector<EnvelopeVertex>& vertices = envelope_.vertices();
    std::vector<double> distances(vertices.size());
    for_all(vertices.size(), 16, limits_.threads, [&](std::size_t i) { distances[i] = distance(vertices[i].at); });
    double greatest = 0;
    for (const double here : distances) greatest = std::max(greatest, here);
    return greatest;
  }

  /// The greatest distance to the envelope of those points of the boundary that are the nearest ones to its vertices. A
  /// vertex is no nearer to its point than the envelope, so most distances need not be computed.
  double greatest_below_vertices() const {
    constexpr std::size_t kBlock = 64;
    struct Foot {
      Point at;
      double most;
    };
    const std::vector<EnvelopeVertex>& vertices = envelope_.vertices();
    std::vector<Foot> feet(vertices.size());
    for_all(vertices.size(), 16, limits_.threads, [&](std::size_t i) {
      const BvhHit hit = solid_.closest(vertices[i].at);
      feet[i] = {hit.point, std::sqrt(hit.squared_distance)};
    });
    std::stable_sort(feet.begin(), feet.end(), [](const Foot& a, const Foot& b) { return a.most > b.most; });
    double greatest = 0;
    for (std::size_t begin = 0; begin < feet.size() && feet[begin].most > greatest; begin += kBlock) {
      std::array<double, kBlock> distances{};
      for_all(std::min(kBlock, feet.size() - begin), 1, limits_.threads,
              [&](std::size_t i) { distances[i] = envelope_.distance(feet[begin + i].at, greatest); });
      greatest = std::max(greatest, *std::max_element(distances.begin(), distances.end()));
    }
    return greatest;
  }

  Bounds boundary_to_envelope(double lower) const {
    lower = std::max(lower, greatest_below_vertices());
    const auto evaluate = [&](const Patch& patch, double known) -> CellBounds {
      const TrianglePart& part = patch.part;
      const double enough = known + limits_.tolerance;
      double bound = part.reach(patch.at_envelope);
      if (bound <= enough) return {kNone, bound};
      const Point middle = part.middle();
      const NearestBall nearest = tree_.nearest(middle);
      if (nearest.distance >= 0) {
        return {nearest.distance, patch.farthest(point_of_sphere(tree_.balls()[nearest.ball], middle))};
      }
      const Point normal = part.normal();
      const double outward = envelope_.distance_along(middle, normal, enough);
      if (outward <= enough) bound = patch.farthest(middle + outward * normal);
      // A part of such a size is divided anyway.
      const double reach = part.reach(middle);
      if (bound <= enough || (reach > enough && bound < HUGE_VAL)) return {kNone, bound};
      const EnvelopePoint found = envelope_.nearest(middle, enough - reach);
      return {found.distance > enough - reach ? found.distance : kNone, patch.farthest(found.at)};
    };
    std::vector<Patch> patches;
    patches.reserve(parts_.size());
    for (const TrianglePart& part : parts_) patches.push_back({part});
    return rounded(bound_supremum(std::move(patches), lower, limits_, evaluate, split_patch),
                   slack_ + envelope_.distance_error());
  }

  Bounds envelope_to_boundary() const {
    const double lower = greatest_at_vertices([&](const Point& p) { return solid_.distance(p); });
    const auto evaluate = [&](const Cube& cube, double known) -> CellBounds {
      const double reach = cube.reach();
      if (const double bound = cube.farthest(cube.at_boundary); bound <= known + limits_.tolerance)
        return {kNone, bound};
      const Ball& likely = tree_.balls()[cube.ball];
      if (length(cube.centre - likely.centre) - likely.radius < -(reach + slack_)) return {};
      const NearestBall nearest = tree_.nearest(cube.centre);
      cube.ball = nearest.ball;
      if (std::fabs(nearest.distance) > reach + slack_) return {};
      const double before = length(cube.centre - cube.at_boundary);
      const BvhHit hit = solid_.closest(cube.centre, before);
      if (hit.triangle != BvhHit().triangle) cube.at_boundary = hit.point;
      const double distance = std::min(before, std::sqrt(hit.squared_distance));
      CellBounds cell = {kNone, cube.farthest(cube.at_boundary)};
      if (distance + std::fabs(nearest.distance) <= known) return cell;
      const Ball& ball = tree_.balls()[nearest.ball];
      if (nearest.distance == -ball.radius) return cell;  // Its centre: no direction.
      const Point reached = point_of_sphere(ball, cube.centre);
      if (!tree_.holds(reached, envelope_.tolerance())) cell.value = solid_.distance(reached);
      return cell;
    };
    return rounded(bound_supremum(std::vector<Cube>{cube_around(tree_.balls())}, lower, limits_, evaluate, split_cube),
                   slack_ + envelope_.distance_error());
  }

  const Solid& solid_;
  const Envelope& envelope_;
  const NearestBallTree& tree_;
  const EnvelopeOptions& options_;
  double slack_;
  SearchLimits limits_;
  std::vector<TrianglePart> parts_;
};

}  // namespace

Bounds EnvelopeDistances::between_sets() const { return greater(solid_to_balls, balls_to_solid); }

Bounds EnvelopeDistances::between_surfaces() const { return greater(boundary_to_envelope, envelope_to_boundary); }

namespace {

Error stopped() { return {ErrorCode::kInterrupted, "interrupted"}; }

Error no_memory() { return out_of_memory("measuring the distance of the balls from the solid"); }

template <class Function>
Result<Bounds> measured(const Solid& solid, std::span<const Ball> balls, const EnvelopeOptions& options,
                        Function function) {
  const Result<Envelope> envelope = Envelope::build(balls, options.threads.count);
  if (!envelope) return envelope.error();
  try {
    return function(Measure(solid, envelope.value(), options));
  } catch (const Stopped&) {
    return stopped();
  } catch (const std::bad_alloc&) {
    return no_memory();
  }
}

}  // namespace

Result<EnvelopeDistances> measure_distances(const Solid& solid, const Envelope& envelope,
                                            const EnvelopeOptions& options) {
  if (envelope.tree().balls().empty()) return Error{ErrorCode::kUsage, "no balls to measure the distance of"};
  try {
    return Measure(solid, envelope, options).all();
  } catch (const Stopped&) {
    return stopped();
  } catch (const std::bad_alloc&) {
    return no_memory();
  }
}

Result<Bounds> measure_greatest_gap(const Solid& solid, std::span<const Ball> balls, const EnvelopeOptions& options) {
  return measured(solid, balls, options, [](const Measure& measure) { return measure.boundary_to_balls(); });
}

Result<Bounds> measure_surface_distance(const Solid& solid, std::span<const Ball> balls,
                                        const EnvelopeOptions& options) {
  return measured(solid, balls, options, [](const Measure& measure) { return measure.between_surfaces(); });
}

}  // namespace medial_vk
