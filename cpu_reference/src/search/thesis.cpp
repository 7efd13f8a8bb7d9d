// The published method, Sections 2.3.2 and 2.4, with the corrected sign of 2.4.2.
//
// The source leaves open at which level each test discards. Here a cell of a coarse level whose sphere lies inside the
// solid is subdivided if its flux is positive (2.3.2, step 3); the salience threshold AOF > (3/8) sin(theta) is derived
// for a face of a voxel and applied at the finest level only, as is its alternative, greatest distance > r - 2 l. A
// cell whose sphere meets the boundary is subdivided without a test, and searched by Algorithm 2 at the finest level if
// narrow features are enabled (2.4.3). Cells wholly outside are dropped, which changes nothing in the output.
//
// Algorithm 2 requires the growth test of Lemma 2.3 in addition to the conditions of the source, because every output
// ball has to pass the certificate: RETRACT satisfies it except on lines that pass through the boundary.
#include <cmath>
#include <vector>

#include "search/modes.h"
#include "search/search.h"
#include "search/side.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

class Thesis {
 public:
  Thesis(const Mesh& mesh, const Tree& tree, const Grid& grid, const Options& options, Result& result)
      : tree_(tree),
        grid_(grid),
        options_(options),
        thresholds_(options, grid, tree.longest_side()),
        sides_(mesh, tree),
        result_(result),
        same_contact_(1e-9 * tree.longest_side()) {
    for (int level = 0; level < grid.levels; ++level) {
      spirals_.push_back(spiral_points(options.samples[4 - grid.levels + level]));
    }
    closest_ = [this](const Vector3d& p) {
      ++result_.queries;
      return tree_.closest(p);
    };
  }

  void visit(const Vector3i& cell, int level) {
    const double side = grid_.cell_size(level);
    const Vector3d centre = grid_.centre(cell, level);
    const Closest nearest = closest_(centre);
    if (sides_.of_ball(centre, circumradius(side), nearest) == Side::kOutside) return;
    ++result_.levels[level].visited;
    const bool sphere_inside = nearest.distance >= side && sides_.inside(centre, nearest);
    if (level + 1 == grid_.levels) {
      visit_voxel(cell, centre, sphere_inside);
      return;
    }
    if (sphere_inside && outward_flux(closest_, centre, side, spirals_[level]).average <= 0) return;
    ++result_.levels[level].kept;
    for (int k = 0; k < 8; ++k) {
      const Vector3i child = child_of(cell, k);
      if (grid_.reaches(child, level + 1)) visit(child, level + 1);
    }
  }

 private:
  void visit_voxel(const Vector3i& voxel, const Vector3d& centre, bool sphere_inside) {
    if (!sphere_inside && !options_.narrow_features) return;
    const double side = grid_.voxel_size;
    const Flux flux = outward_flux(closest_, centre, side, spirals_.back());
    if (sphere_inside && !preselected(flux)) return;
    ++result_.levels.back().kept;
    if (!salient_medial_point(voxel, centre, flux.average)) {
      ++result_.undecided;
      return;
    }
    ++result_.found;
    ++result_.levels.back().found;
  }

  /// Section 2.4.2. 2 sin(theta) pi (sqrt(3) l / 2)^2 / (4 pi l^2) = (3/8) sin(theta).
  bool preselected(const Flux& flux) const {
    if (flux.average > 0.375 * std::sin(thresholds_.object_angle)) return true;
    return thresholds_.radius > 0 && flux.greatest_distance > thresholds_.radius - 2 * grid_.voxel_size;
  }

  /// Algorithm 2.
  bool salient_medial_point(const Vector3i& voxel, const Vector3d& centre, double flux) {
    // NOLINTNEXTLINE(readability-use-anyofallof): it also keeps the point.
    for (const Vector3d& direction : spirals_.back()) {
      const Vector3d phi = centre + grid_.voxel_size * direction;
      const Closest nearest = closest_(phi);
      const Vector3d other = opposite(centre, phi, direction_to(phi, nearest));
      if ((closest_(other).point - nearest.point).norm() <= same_contact_) continue;
      const Retraction found = retract(closest_, phi, other, thresholds_.epsilon, same_contact_);
      if (grid_.voxel_of(found.p) != voxel) continue;
      const double angle = half_angle(found.spoke_p, found.spoke_q);
      const bool deep = thresholds_.radius > 0 && found.radius > thresholds_.radius;
      const double radius = safe_radius(tree_, found.radius);
      if (radius <= 0 || !(angle > thresholds_.object_angle || deep)) continue;
      if (!is_certain(found)) continue;
      result_.spheres.push_back({found.p, radius, found.spoke_p, found.spoke_q, angle, flux, voxel});
      return true;
    }
    return false;
  }

  bool is_certain(const Retraction& found) {
    const auto distance_at = [&](const Vector3d& p) { return closest_(p).distance; };
    return grows_into_boundary(tree_, found.p, found.radius, found.spoke_p, thresholds_.epsilon, distance_at) &&
           sides_.inside(found.p, closest_(found.p));
  }

  const Tree& tree_;
  const Grid& grid_;
  const Options& options_;
  const Thresholds thresholds_;
  const Sides sides_;
  Result& result_;
  const double same_contact_;
  std::vector<std::vector<Vector3d>> spirals_;  // per level
  ClosestFunction closest_;
};

}  // namespace

void extract_thesis(const Mesh& mesh, const Tree& tree, const Grid& grid, const Options& options, const CellLoop& loop,
                    Result& result) {
  Thesis thesis(mesh, tree, grid, options, result);
  loop([&](const Vector3i& cell) { thesis.visit(cell, 0); });
}

}  // namespace medial_vk::reference
