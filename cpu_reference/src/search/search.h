// The aimed search for one salient medial point in a finest voxel (certified mode).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "cpu_reference/extract.h"
#include "dismissal/contacts.h"
#include "dismissal/dismissal.h"
#include "dismissal/spoke_cones.h"
#include "geometry/grid.h"
#include "search/lines.h"
#include "search/side.h"
#include "search/watch.h"

namespace medial_vk::reference {

enum class Outcome { kFound, kEmpty, kUndecided };

/// A cube to be searched: the voxel itself or a part of it.
struct Cell {
  Eigen::Vector3d centre;
  double side;
  Side where;  // known from a larger cell, or kMixed
};

class VoxelSearch {
 public:
  VoxelSearch(const Tree& tree, const SpokeCones& cones, const Sides& sides, const Grid& grid,
              const Thresholds& thresholds, int extra_levels, Watch& watch, Result& result);

  /// Fills `sphere`, except for its flux, if a point is found. `parent` is the list of the cell above the voxel. After
  /// a stop, voxels are undecided.
  Outcome run(const Eigen::Vector3i& voxel, Side where, const ContactList& parent, Sphere& sphere);

  /// The result of the last run, if its outcome is kUndecided.
  const Undecided& undecided() const { return undecided_; }

 private:
  struct Segment {
    Eigen::Vector3d p, q;
  };
  struct End {
    Eigen::Vector3d point;
    Closest nearest;
    Eigen::Vector3d gradient;
  };

  Outcome search(const Cell& cell, int depth, const ContactList& parent, Sphere& sphere);
  Outcome search_parts(const Cell& cell, Side where, int depth, const ContactList& list, Sphere& sphere);
  void note_undecided(BoxTest& test, const ContactList& list, double angle);
  bool aim(const Cell& cell, const BoxTest& test, const ContactList& list, double angle, Side where, Sphere& sphere);
  bool stand_beside(const Cell& cell, const ContactList& list, Side where, Sphere& sphere);
  std::optional<End> second_contact(const End& here, const ContactList& list) const;
  std::optional<Segment> clip(const Cell& cell, const Line& line) const;
  bool try_segment(const Segment& segment, const ContactList& list, double angle, Side where, Sphere& sphere);
  bool accept(const End& here, const End& there, const ContactList& list, Side where, Sphere& sphere);
  End look(const Eigen::Vector3d& p, const ContactList& list);

  const Tree& tree_;
  const SpokeCones& cones_;
  const Sides& sides_;
  const Grid& grid_;
  const Thresholds& thresholds_;
  int extra_levels_;
  Watch& watch_;
  Result& result_;
  Eigen::Vector3i voxel_;
  Eigen::Vector3d lower_, upper_;  // of the voxel, slightly inside
  Undecided undecided_{};
};

/// The written radius for a computed distance: rounded down, so that the ball cannot reach out of the solid.
double safe_radius(const Tree& tree, double distance);

/// True if the condition of Lemma 2.3 holds: the ball at p, pushed away from its contact by epsilon and grown by
/// epsilon, meets the boundary elsewhere, by more than rounding. `distance_at` gives the distance to the boundary.
template <typename Distance>
bool grows_into_boundary(const Tree& tree, const Eigen::Vector3d& p, double distance, const Eigen::Vector3d& spoke,
                         double epsilon, const Distance& distance_at) {
  return distance_at(p - epsilon * spoke) < distance + epsilon - 16 * tree.rounding();
}

}  // namespace medial_vk::reference
