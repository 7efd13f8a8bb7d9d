#include "reference_bridge/check_clearances.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "cpu_reference/distance.h"
#include "reference_bridge/reference_bridge.h"

namespace medial_vk {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Placement {
  Matrix3d rotation;
  Vector3d shift;
};

Placement placement_of(const Pose& pose) {
  Placement placement;
  for (int i = 0; i < 3; ++i) placement.rotation.row(i) = to_eigen(pose.rotation[static_cast<std::size_t>(i)]);
  placement.shift = to_eigen(pose.shift);
  return placement;
}

Placement operator*(const Placement& a, const Placement& b) {
  return {a.rotation * b.rotation, a.rotation * b.shift + a.shift};
}

/// The least distance of compared solids, by the reference.
struct LeastOfPairs {
  double distance = std::numeric_limits<double>::infinity();
  double rounding = 0;  ///< Of the distances and the intervals.
};

class Solids {
 public:
  Solids(const std::vector<CheckedSolid>& solids, std::span<const SolidPair> pairs) : solids_(solids), pairs_(pairs) {
    for (const CheckedSolid& solid : solids_) {
      if (meshes_.contains(solid.mesh)) continue;
      reference::Mesh mesh = to_reference(*solid.mesh);
      double size = 0;
      for (const Vector3d& v : mesh.vertices) size = std::max(size, v.norm());
      meshes_.emplace(solid.mesh, Sized{std::move(mesh), size});
    }
  }

  LeastOfPairs least(std::span<const Pose> poses) const {
    LeastOfPairs least;
    for (const SolidPair& pair : pairs_) {
      const PlacedPair placed = place(pair, poses);
      least.rounding = std::max(least.rounding, placed.rounding);
      least.distance = std::min(least.distance, placed.distance());
    }
    return least;
  }

  /// Whether two solids have a common point that is not one of rounding: they still have one after each of six moves of
  /// one solid, by twice the rounding along each axis, to and fro. Solids that only touch are parted by one of them: it
  /// is off the direction in which they part by no more than the diagonal of a cube, and so parts them by 2 / sqrt(3)
  /// of the rounding. (A solid that fits exactly into a hole of another one cannot be told from one that is too large.)
  bool overlap(std::span<const Pose> poses) const {
    return std::ranges::any_of(pairs_, [&](const SolidPair& pair) {
      PlacedPair placed = place(pair, poses);
      if (placed.distance() > 0) return false;
      const Vector3d shift = placed.motion.shift;
      for (int k = 0; k < 6; ++k) {
        placed.motion.shift = shift + (k < 3 ? 2 : -2) * placed.rounding * Vector3d::Unit(k % 3);
        if (placed.distance() > 0) return false;
      }
      return true;
    });
  }

 private:
  struct Sized {
    reference::Mesh mesh;
    double size;
  };

  struct PlacedPair {
    const reference::Mesh& a;
    const reference::Mesh& b;
    reference::Motion motion;  ///< From the frame of b to that of a.
    double rounding;

    double distance() const {
      const double surfaces = reference::nearest_of_meshes(a, b, motion).distance;
      return surfaces == 0 || reference::one_holds_the_other(a, b, motion) ? 0 : surfaces;
    }
  };

  PlacedPair place(const SolidPair& pair, std::span<const Pose> poses) const {
    const CheckedSolid &a = solids_[pair.a], &b = solids_[pair.b];
    const Placement at_a = placement_of(poses[a.link]) * placement_of(a.pose);
    const Placement at_b = placement_of(poses[b.link]) * placement_of(b.pose);
    const reference::Motion motion = {at_a.rotation.transpose() * at_b.rotation,
                                      at_a.rotation.transpose() * (at_b.shift - at_a.shift)};
    const Sized &mesh_a = meshes_.at(a.mesh), &mesh_b = meshes_.at(b.mesh);
    // As in check_distances.cpp, of the sizes of both meshes; the motions have some ten roundings of shifts each, and
    // rotations are off by 1e-14 of them at most.
    const double reach = mesh_a.size + mesh_b.size + shift_of(a.pose) + shift_of(b.pose);
    const double rounding = 1024 * 0x1p-53 * (4 * reach + shift_of(poses[a.link]) + shift_of(poses[b.link]));
    return {mesh_a.mesh, mesh_b.mesh, motion, rounding};
  }

  static double shift_of(const Pose& pose) { return to_eigen(pose.shift).norm(); }

  const std::vector<CheckedSolid>& solids_;
  std::span<const SolidPair> pairs_;
  std::map<const PreparedMesh*, Sized> meshes_;
};

/// A condition of all configurations: `excess` is the violation, and what exceeds `rounding` fails.
void test(CheckLine& line, double excess, double rounding, std::size_t configuration) {
  ++line.tested;
  line.worst = std::max(line.worst, excess);
  if (excess <= rounding) return;
  if (line.failed++ > 0) return;
  line.first_failure = fmt::format("{}: configuration {}, by {:.3g}", line.condition, configuration + 1, excess);
}

CheckLine line_of(const char* condition) {
  CheckLine line;
  line.condition = condition;
  line.unit = "length";
  return line;
}

}  // namespace

CheckReport check_clearances(const CheckedSolids& solids, std::span<const Pose> poses, std::size_t links,
                             std::span<const CheckedInterval> intervals, const std::function<void(std::size_t)>& seen) {
  const Solids around(solids.around, solids.pairs), inside(solids.inside, solids.pairs);
  CheckLine lower = line_of("lower end <= least distance of all pairs of triangles");
  CheckLine upper = line_of("upper end >= that distance");
  CheckLine free = line_of("free: no compared solids have a common point");
  CheckLine hit = line_of("hit: some have one");
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    seen(i);
    const std::span<const Pose> of_links = poses.subspan(i * links, links);
    const LeastOfPairs of_around = around.least(of_links);
    const LeastOfPairs of_inside = solids.are_same ? of_around : inside.least(of_links);
    const CheckedInterval& interval = intervals[i];
    const bool are_compared = of_around.distance < std::numeric_limits<double>::infinity();
    test(lower, are_compared ? interval.lower - of_around.distance : 0, of_around.rounding, i);
    if (interval.upper == 0) {
      test(hit, of_inside.distance, of_inside.rounding, i);
      continue;
    }
    if (interval.upper < std::numeric_limits<double>::infinity()) {
      test(upper, of_inside.distance - interval.upper, of_inside.rounding, i);
    }
    if (!(interval.lower > 0)) continue;
    double excess = of_around.distance == 0 ? interval.lower : 0;
    // With a limit of 0, the lower end is above 0 and no more, and tells nothing.
    if (excess > 0 && excess <= of_around.rounding && around.overlap(of_links)) excess = 2 * of_around.rounding;
    test(free, excess, of_around.rounding, i);
  }
  return {{lower, upper, free, hit}};
}

}  // namespace medial_vk
