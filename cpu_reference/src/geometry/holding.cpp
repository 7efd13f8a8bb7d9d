// Whether one of two solids lies in the other: by crossings of a segment, whose signs are exact.
#include <algorithm>
#include <optional>
#include <vector>

#include "cpu_reference/distance_mesh.h"
#include "cpu_reference/queries.h"
#include "geometry/corner_volume.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

/// By how much the winding number is greater before the triangle than beyond it, where the segment from p to q passes
/// through: 1 where it comes out in front. No value: it passes a corner, an edge or an end of the segment, or a
/// triangle without area.
std::optional<int> change_across(const Vector3d& p, const Vector3d& q, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const double x = corner_volume(p, q, a, b), y = corner_volume(p, q, b, c), z = corner_volume(p, q, c, a);
  // The line misses the triangle if it passes two edges on different sides, for a triangle without area, too: if it met
  // that, all three volumes would be zero.
  if (std::min({x, y, z}) < 0 && std::max({x, y, z}) > 0) return 0;
  const double of_p = corner_volume(a, b, c, p), of_q = corner_volume(a, b, c, q);
  if ((of_p > 0 && of_q > 0) || (of_p < 0 && of_q < 0)) return 0;
  if (x == 0 || y == 0 || z == 0 || of_p == 0 || of_q == 0) return std::nullopt;
  return of_q > 0 ? 1 : -1;
}

/// A solid in the place that a motion gives it, with corners rounded as in nearest_of_meshes(). A winding number by
/// solid angles would not do: beside a sliver their volumes are smaller than the rounding of their terms.
///
/// Let L be the reach of the mesh plus the shift. Centres of balls, points of the segments below and their distances
/// are less than 16 L, with fewer than 16 roundings: an error of less than 2^-45 L. A rotation that is one to within
/// 1e-12 stretches a radius by less than 1e-11 of the reach.
class PlacedSolid {
 public:
  PlacedSolid(const DistanceMesh& mesh, const Motion& motion)
      : mesh_(mesh),
        motion_(motion),
        slack_(0x1p-45 * (mesh.reach() + motion.shift.norm()) + 1e-11 * mesh.reach()),
        centre_(placed(mesh.whole().centre)) {
    for (const DistanceMesh::Around& run : mesh.runs()) run_centres_.push_back(placed(run.centre));
  }

  /// Precondition: the mesh is closed. A point of the surface is held.
  bool holds(const Vector3d& p) const {
    const double away = (p - centre_).norm(), radius = mesh_.whole().radius;
    if (away > radius + slack_) return false;
    // The spiral begins and ends along an axis, where segments lie in the planes of many meshes.
    static const std::vector<Vector3d> directions = spiral_points(40);
    for (std::size_t i = 1; i + 1 < directions.size(); ++i) {
      // The end is farther from the centre than 2 radius + 3 slack, where the winding number is 0.
      const Vector3d end = p + (2 * (away + radius) + 4 * slack_) * directions[i];
      if (const std::optional<int> number = winding_number_along(p, end, directions[i])) return *number >= 1;
    }
    return true;  // all segments begin on a triangle
  }

 private:
  Vector3d placed(const Vector3d& p) const { return motion_.rotation * p + motion_.shift; }

  /// No value: the segment passes an edge.
  std::optional<int> winding_number_along(const Vector3d& p, const Vector3d& end, const Vector3d& direction) const {
    int number = 0;
    for (std::size_t r = 0; r < run_centres_.size(); ++r) {
      const Vector3d from = run_centres_[r] - p;
      const Vector3d aside = from - std::max(0.0, from.dot(direction)) * direction;
      if (aside.norm() > mesh_.runs()[r].radius + slack_) continue;
      const std::size_t first = DistanceMesh::kRun * r,
                        last = std::min(mesh_.triangles().size(), first + DistanceMesh::kRun);
      for (std::size_t t = first; t < last; ++t) {
        Corners corners = mesh_.triangles()[t];
        for (Vector3d& corner : corners) corner = placed(corner);
        const std::optional<int> change = change_across(p, end, corners);
        if (!change) return std::nullopt;
        number += *change;
      }
    }
    return number;
  }

  const DistanceMesh& mesh_;
  const Motion& motion_;
  double slack_;
  Vector3d centre_;
  std::vector<Vector3d> run_centres_;
};

}  // namespace

bool one_holds_the_other(const DistanceMesh& a, const DistanceMesh& b, const Motion& motion) {
  if (a.is_closed()) {
    const Motion none = {Eigen::Matrix3d::Identity(), Vector3d::Zero()};
    const PlacedSolid solid(a, none);
    const auto is_held = [&](const Vector3d& p) { return solid.holds(motion.rotation * p + motion.shift); };
    if (std::ranges::any_of(b.components(), is_held)) return true;
  }
  if (!b.is_closed()) return false;
  const PlacedSolid solid(b, motion);
  return std::ranges::any_of(a.components(), [&](const Vector3d& p) { return solid.holds(p); });
}

}  // namespace medial_vk::reference
