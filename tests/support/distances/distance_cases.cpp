#include "support/distances/distance_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/point_ops.h"
#include "medial_vk/collisions.h"
#include "medial_vk/resumable_bounds.h"
#include "support/distances/reference_motion.h"
#include "support/random_poses.h"

namespace medial_vk::test {
namespace {

std::size_t below(Random& random, std::size_t count) { return static_cast<std::size_t>(random() % count); }
bool one_of(Random& random, std::size_t count) { return below(random, count) == 0; }

Point middle_of(const DistanceSolid& solid) { return 0.5 * (solid.lower + solid.upper); }

/// The middle of b comes to that of a, and `offset` beside it.
Pose beside(const DistanceSolid& a, const DistanceSolid& b, Pose pose, const Point& offset) {
  pose.shift = {0, 0, 0};
  pose.shift = middle_of(a) + offset - pose * middle_of(b);
  return pose;
}

Point any_direction(Random& random) {
  Point p = point_in_cube(random, 1);
  while (!(length(p) > 0.1)) p = point_in_cube(random, 1);
  return (1 / length(p)) * p;
}

/// By right angles: one of 24 rotations, exactly.
Pose right_angles(Random& random) {
  constexpr std::array<std::array<std::size_t, 3>, 6> kOrders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  const std::size_t order = below(random, 6);
  Pose pose;
  double sign = order < 3 ? 1 : -1;
  for (std::size_t row = 0; row < 3; ++row) {
    const double entry = row == 2 ? sign : (one_of(random, 2) ? 1 : -1);
    pose.rotation[row] = {0, 0, 0};
    pose.rotation[row][kOrders[order][row]] = entry;
    sign *= entry;
  }
  return pose;
}

double half_of_both(const DistanceSolid& a, const DistanceSolid& b) { return 0.5 * (a.size + b.size); }

Pose far_pose(const DistanceSolid& a, const DistanceSolid& b, Random& random) {
  const double far = half_of_both(a, b) * std::pow(10, uniform(random, 1, 6));
  return beside(a, b, any_pose(random, {}), far * any_direction(random));
}

Pose apart_pose(const DistanceSolid& a, const DistanceSolid& b, Random& random) {
  return beside(a, b, any_pose(random, {}), half_of_both(a, b) * uniform(random, 0.5, 3) * any_direction(random));
}

/// From a gap of half a size down to less than a rounding, or an overlap as deep; or a touch as exact as rounding
/// allows.
Pose touching_pose(const DistanceSolid& a, const DistanceSolid& b, Random& random) {
  Pose pose = beside(a, b, any_pose(random, {}), 3 * half_of_both(a, b) * any_direction(random));
  const Distance apart = distance(a.body, b.body, pose).value();
  if (apart.lower == 0) return pose;
  const Point way = apart.on_a - apart.on_b;
  const double gap = one_of(random, 3) ? 0 : std::ldexp(half_of_both(a, b), -1 - static_cast<int>(below(random, 54)));
  pose.shift = pose.shift + (1 + (one_of(random, 2) ? gap : -gap) / length(way)) * way;
  return pose;
}

Point point_of_box(const DistanceSolid& solid, Random& random) {
  Point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = uniform(random, solid.lower[k], solid.upper[k]);
  return p;
}

Pose nested_pose(const DistanceSolid& a, const DistanceSolid& b, Random& random) {
  Pose pose = any_pose(random, {});
  const bool a_is_larger = a.size > b.size;
  const Point of_b = pose * (a_is_larger ? middle_of(b) : point_of_box(b, random));
  pose.shift = (a_is_larger ? point_of_box(a, random) : middle_of(a)) - of_b;
  return pose;
}

Pose equal_pose(const DistanceSolid& a, Random& random) {
  Pose pose;
  if (one_of(random, 2)) pose = one_of(random, 2) ? right_angles(random) : any_pose(random, {});
  if (one_of(random, 3)) pose = beside(a, a, pose, {0, 0, 0});
  if (one_of(random, 2)) return pose;
  pose.shift = pose.shift + std::ldexp(a.size, -static_cast<int>(below(random, 54))) *
                                (one_of(random, 2) ? any_direction(random) : Point{1, 0, 0});
  return pose;
}

Pose aligned_pose(const DistanceSolid& a, const DistanceSolid& b, Random& random) {
  Pose pose = right_angles(random);
  const Point p = pose * b.lower, q = pose * b.upper;
  const Point lower = {std::min(p[0], q[0]), std::min(p[1], q[1]), std::min(p[2], q[2])};
  const Point upper = {std::max(p[0], q[0]), std::max(p[1], q[1]), std::max(p[2], q[2])};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<double, 5> places = {a.upper[k] - lower[k], a.lower[k] - upper[k], a.lower[k] - lower[k],
                                          a.upper[k] - upper[k],
                                          uniform(random, a.lower[k] - upper[k], a.upper[k] - lower[k])};
    pose.shift[k] = places[below(random, places.size())];
  }
  return pose;
}

Pose uneven_pose(const DistanceSolid& a, const DistanceSolid& b, Random& random) {
  Pose pose = any_pose(random, {});
  // The products of rows are then within 1e-12 of those of a rotation.
  for (Point& row : pose.rotation) row = row + point_in_cube(random, 2e-13);
  return beside(a, b, pose, half_of_both(a, b) * uniform(random, 0, 3) * any_direction(random));
}

Pose make_pose_of_kind(PoseKind kind, const DistanceSolid& a, const DistanceSolid& b, Random& random) {
  switch (kind) {
    case PoseKind::kFar:
      return far_pose(a, b, random);
    case PoseKind::kApart:
      return apart_pose(a, b, random);
    case PoseKind::kOverlapping:
      return beside(a, b, any_pose(random, {}), point_in_cube(random, 0.5 * half_of_both(a, b)));
    case PoseKind::kTouching:
      return touching_pose(a, b, random);
    case PoseKind::kNested:
      return nested_pose(a, b, random);
    case PoseKind::kEqual:
      return equal_pose(a, random);
    case PoseKind::kAligned:
      return aligned_pose(a, b, random);
    case PoseKind::kUneven:
      return uneven_pose(a, b, random);
    case PoseKind::kDegenerate:
      break;
  }
  return make_pose_of_kind(static_cast<PoseKind>(below(random, kPoseKinds - 1)), a, b, random);
}

/// Compares with the reference's distances of the solids and of the surfaces, which are intervals where rounding may
/// decide.
class Comparison {
 public:
  Comparison(const DistanceCase& of, std::uint64_t seed) : case_(of), seed_(seed), random_(~seed) {
    const reference::Motion motion = to_reference(of.pose);
    rounding_ = 0x1p-53 * (of.a->reference.reach() + of.b->reference.reach() + motion.shift.norm());
    const double distance = reference::nearest_of_meshes(of.a->reference, of.b->reference, motion).distance;
    surfaces_ = solids_ = {distance, distance};
    if (distance <= allowed()) {
      solids_.from = surfaces_.from = 0;
    } else if (reference::one_holds_the_other(of.a->reference, of.b->reference, motion)) {
      solids_ = {0, 0};
    }
  }

  CaseOutcome run() {
    if (solids_.from > 0) outcome_.collision = Collision::kFree;
    if (solids_.to == 0) outcome_.collision = Collision::kHit;
    const Pose near = pose_nearby();
    check_distances(near);
    check_bounds(near);
    check_steps();
    check_verdicts(near);
    return std::move(outcome_);
  }

 private:
  struct Interval {
    double from, to;
  };

  /// Positions, points between corners and distances have errors of less than 32 roundings here as in
  /// proximity/nearest_triangles.cpp, and the feet of common perpendiculars are less exact.
  double allowed() const { return 64 * rounding_; }

  void blame(const char* what, const std::string& found) {
    outcome_.faults.push_back(
        fmt::format("seed {} ({}), {} and {}: {} is {}, but the reference has [{:.17g}, {:.17g}], rounding {:.2g}",
                    seed_, kPoseKindNames[static_cast<std::size_t>(case_.kind)], case_.a->name, case_.b->name, what,
                    found, solids_.from, solids_.to, rounding_));
  }

  void check(const char* what, double lower, double upper, const Interval& truth, bool counts = false) {
    const double excess = std::max(lower - truth.to, truth.from - upper);
    if (counts) outcome_.excess = std::max(outcome_.excess, excess / rounding_);
    if (excess <= allowed() && lower <= upper && lower >= 0) return;
    blame(what, fmt::format("[{:.17g}, {:.17g}]", lower, upper));
  }

  void check(const char* what, const Distance& found, const Interval& truth) {
    check(what, found.lower, found.upper, truth, true);
    check(what, found.collision(), truth);
    // Points of both solids are at a distance of the interval, up to the rounding of their coordinates.
    if (found.upper > 0 && length(found.on_a - found.on_b) > found.upper + allowed()) {
      blame(what,
            fmt::format("{:.17g} with points that are {:.17g} apart", found.upper, length(found.on_a - found.on_b)));
    }
  }

  void check(const char* what, Collision verdict, const Interval& truth) {
    if (verdict == Collision::kFree && truth.to == 0) blame(what, "free");
    if (verdict == Collision::kHit && truth.from > 0) blame(what, "hit");
  }

  /// For starts: an answer there is a good one here, or a bad one.
  Pose pose_nearby() {
    if (one_of(random_, 4)) return apart_pose(*case_.a, *case_.b, random_);
    Pose near = case_.pose;
    near.shift = near.shift + point_in_cube(random_, half_of_both(*case_.a, *case_.b) * uniform(random_, 0, 0.1));
    return near;
  }

  void check_distances(const Pose& near) {
    const Body &a = case_.a->body, &b = case_.b->body;
    const Distance cold = distance(a, b, case_.pose).value();
    check("the distance", cold, solids_);
    outcome_.found = cold.collision();
    outcome_.width = (cold.upper - cold.lower) / rounding_;
    const Distance start = distance(a, b, near).value();
    check("the distance from a start", distance(a, b, case_.pose, {}, start).value(), solids_);
    DistanceOptions options;
    options.surfaces_only = true;
    check("the distance of the surfaces", distance(a, b, case_.pose, options, start).value(), surfaces_);
    const double size = half_of_both(*case_.a, *case_.b);
    options.surfaces_only = one_of(random_, 2);
    options.tolerance = size * std::pow(10, uniform(random_, -12, 1));
    if (one_of(random_, 2)) options.limit = size * uniform(random_, 0, 2);
    if (one_of(random_, 2)) options.most_comparisons = below(random_, 200);
    check("the distance with options", distance(a, b, case_.pose, options).value(),
          options.surfaces_only ? surfaces_ : solids_);
  }

  void check(const char* what, const DistanceBounds& bounds) {
    check(what, bounds.lower, bounds.upper, solids_);
    check(what, bounds.collision(), solids_);
  }

  void check_bounds(const Pose& near) {
    const Body &a = case_.a->body, &b = case_.b->body;
    check("the interval of balls", distance_bounds(a, b, case_.pose));
    check("the interval of balls from a start", distance_bounds(a, b, case_.pose, distance_bounds(a, b, near)));
  }

  void check_steps() {
    ResumableBounds steps = ResumableBounds::create(case_.a->body, case_.b->body, case_.pose).value();
    DistanceBounds before = steps.bounds();
    for (const std::uint64_t most : {std::uint64_t{0}, std::uint64_t{below(random_, 20)}, ~std::uint64_t{0}}) {
      if (!steps.run(most).ok()) blame("a search in steps", "stopped");
      const DistanceBounds& after = steps.bounds();
      check("the interval of a search in steps", after);
      if (after.lower < before.lower || after.upper > before.upper) blame("a search in steps", "wider after a step");
      before = after;
    }
  }

  void check_verdicts(const Pose& near) {
    const Body &a = case_.a->body, &b = case_.b->body;
    check("the verdict", collide(a, b, case_.pose), solids_);
    const std::array<Pose, 2> poses = {near, case_.pose};
    std::array<Collision, 2> verdicts = {};
    collide_by_balls(a, b, poses, verdicts, {.threads = 1});
    check("the verdict by balls", verdicts[1], solids_);
  }

  const DistanceCase& case_;
  std::uint64_t seed_;
  Random random_;
  double rounding_;
  Interval solids_, surfaces_;
  CaseOutcome outcome_;
};

}  // namespace

DistanceCase make_distance_case(std::span<const DistanceSolid> solids, std::uint64_t seed) {
  Random random(seed);
  const auto kind = static_cast<PoseKind>(seed % kPoseKinds);
  const auto any = [&](const auto& accepts) {
    const DistanceSolid* solid = &solids[below(random, solids.size())];
    for (int tries = 0; tries < 1000 && !accepts(*solid); ++tries) solid = &solids[below(random, solids.size())];
    return solid;
  };
  const bool is_degenerate = kind == PoseKind::kDegenerate;
  const DistanceSolid* a = any([&](const DistanceSolid& solid) { return solid.is_degenerate == is_degenerate; });
  const DistanceSolid* b = any([&](const DistanceSolid& solid) {
    return kind == PoseKind::kNested ? solid.size < 0.3 * a->size : is_degenerate || !solid.is_degenerate;
  });
  if (kind == PoseKind::kEqual) b = a;
  if (one_of(random, 2)) std::swap(a, b);
  return {kind, a, b, make_pose_of_kind(kind, *a, *b, random)};
}

CaseOutcome check_distance_case(const DistanceCase& distance_case, std::uint64_t seed) {
  return Comparison(distance_case, seed).run();
}

}  // namespace medial_vk::test
