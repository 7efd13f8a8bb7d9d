// The certified mode: coarse to fine, every cell found, proved empty, or counted as undecided.
#include <algorithm>
#include <cmath>

#include "dismissal/contacts.h"
#include "search/modes.h"
#include "search/search.h"
#include "search/side.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr int kFluxSamples = 50;

class Certified {
 public:
  /// The trusted triangles of the mesh must be those of `cones`.
  Certified(const Mesh& mesh, const Tree& tree, const SpokeCones& cones, const Grid& grid, const Thresholds& thresholds,
            const Options& options, Result& result)
      : mesh_(mesh),
        tree_(tree),
        grid_(grid),
        thresholds_(thresholds),
        sides_(mesh, tree),
        search_(tree, cones, sides_, grid, thresholds, options.extra_levels, result),
        spiral_(spiral_points(kFluxSamples)),
        result_(result) {}

  void run_top(const Vector3i& cell) {
    const Vector3d centre = grid_.centre(cell, 0);
    ++result_.queries;
    // With one level only, the finest voxels are top-level cells and take their list from a cell of their own size.
    visit(cell, 0, ContactList(tree_, mesh_, centre, list_reach(0)), Side::kMixed);
  }

 private:
  /// Bounds all query points below a cell: its own, pushed ones (epsilon), and the flux samples of its voxels, at one
  /// voxel side l from voxel centres that are at most circumradius - l sqrt(3)/2 from the cell's.
  double list_reach(int level) const {
    const double voxel = grid_.voxel_size;
    const double extra = std::max(thresholds_.epsilon, voxel - circumradius(voxel));
    return circumradius(grid_.cell_size(level)) + extra * (1 + 1e-6);
  }

  /// `list` is the cell's own, except for finest voxels, which use that of the parent.
  void visit(const Vector3i& cell, int level, const ContactList& list, Side where) {
    if (level == grid_.levels - 1) {
      visit_voxel(cell, list, where);
      return;
    }
    LevelCount& count = result_.levels[level];
    ++count.visited;
    const Closest& nearest = list.nearest_to_centre();
    const double reach = circumradius(grid_.cell_size(level)) * (1 + 1e-9);
    if (where == Side::kMixed) where = sides_.of_ball(list.centre(), reach, nearest);
    if (where == Side::kOutside) return;
    const double angle = thresholds_.angle_at(nearest.distance + reach);
    if (spokes_are_close(tree_, list.within(reach), reach, angle)) return;
    ++count.kept;
    count.contacts += list.contacts().size();
    for (int k = 0; k < 8; ++k) {
      const Vector3i child = child_of(cell, k);
      if (!grid_.reaches(child, level + 1)) continue;
      if (level + 1 == grid_.levels - 1) {
        visit(child, level + 1, list, where);
        continue;
      }
      ++result_.queries;
      visit(child, level + 1, ContactList(list, grid_.centre(child, level + 1), list_reach(level + 1)), where);
    }
  }

  void visit_voxel(const Vector3i& voxel, const ContactList& parent, Side where) {
    Sphere sphere;
    switch (search_.run(voxel, where, parent, sphere)) {
      case Outcome::kFound:
        ++result_.found;
        sphere.flux = flux(voxel, parent);
        result_.spheres.push_back(sphere);
        break;
      case Outcome::kEmpty:
        ++result_.proved_empty;
        break;
      case Outcome::kUndecided:
        ++result_.undecided;
        result_.undecided_voxels.push_back(search_.undecided());
        break;
    }
  }

  /// As outward_flux(), with the list of the parent.
  double flux(const Vector3i& voxel, const ContactList& parent) {
    const Vector3d centre = grid_.centre(voxel, grid_.levels - 1);
    const auto closest = [&](const Vector3d& p) {
      ++result_.queries;
      return parent.closest(p);
    };
    return outward_flux(closest, centre, grid_.voxel_size, spiral_).average;
  }

  const Mesh& mesh_;
  const Tree& tree_;
  const Grid& grid_;
  const Thresholds& thresholds_;
  Sides sides_;
  VoxelSearch search_;
  std::vector<Vector3d> spiral_;
  Result& result_;
};

}  // namespace

void extract_certified(const Mesh& mesh, const Tree& tree, const Grid& grid, const Options& options,
                       const CellLoop& loop, Result& result) {
  const Thresholds thresholds(options, grid, tree.longest_side());
  const SpokeCones cones(mesh, tree);
  Mesh careful = mesh;
  careful.trusted = cones.trusted();
  Certified certified(careful, tree, cones, grid, thresholds, options, result);
  loop([&](const Vector3i& cell) { certified.run_top(cell); });
}

}  // namespace medial_vk::reference
