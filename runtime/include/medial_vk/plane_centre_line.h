// Centre lines from a medial axis in the plane: short or insignificant branches pruned, the longest path, and branches
// as polylines (docs/theory.md, "Centre lines in the plane").
#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "medial_vk/plane_axis.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// What is removed: a fire begins at all free ends, those that do not leave the box that was searched, and burns along
/// the branches with unit speed. At a junction it waits for the fires of all branches but one, and goes on along that
/// one. Loops do not burn, so each part of the axis keeps its connections and its loops; of a part that burns
/// altogether the last node stays.
struct PlanePruning {
  /// In input units: branches stay from which the way outwards to an end is at least that long; 0: all stay.
  double length = 0;
  /// In input units: then, branches of at least this erosion thickness stay; 0: all. The fire begins at a time of the
  /// radius of an end, and the erosion thickness is the time at which it has burned the branch, less the radius there.
  /// Each point of a medial disc that is lost is within `significance` of a disc that is left. Source: Liu, Chambers,
  /// Letscher and Ju, "Extended grassfire transform on medial axes of 2D shapes" (2011).
  double significance = 0;
};

/// Whether an end of the branch is free.
bool is_end_branch(const PlaneAxis& axis, const AxisBranch& branch);

/// The erosion thickness of an end branch: its length and the radius at its free end, less the radius at the other one.
double significance_of(const PlaneAxis& axis, const AxisBranch& branch);

/// Where a junction loses all branches but two, these are one. Time: proportional to n log n for n arcs. Errors: kUsage
/// (a number that is negative or not finite), kOutOfMemory.
Result<PlaneAxis> prune_plane_axis(const PlaneAxis& axis, const PlanePruning& pruning);

struct PlaneLongestPaths {
  /// A branch for each part of the axis with two ends or more: the longest of the shortest paths between two ends.
  /// Other parts, which consist of loops, are as before.
  PlaneAxis axis;
  /// No shortest path between ends is longer than the one that was found by more than this. 0 except in parts with many
  /// loops and ends, where the search of other pairs ends after some 10^8 steps.
  double excess = 0;
};

/// Errors: kOutOfMemory, kInterrupted.
Result<PlaneLongestPaths> find_longest_paths(const PlaneAxis& axis, const std::stop_token& stop = {});

/// A point of a branch.
struct AxisSample {
  PlanePoint point = {};
  double radius = 0;
  double object_angle = 0;  ///< Radians; between two arcs, the greater one.
};

/// The branch as a polyline from ends[0] to ends[1]. Between its points, point and radius are linear: each of these is
/// within `step` of a point of the branch, and its radius within `step` of the radius there, and the other way round.
/// Precondition: step > 0.
std::vector<AxisSample> sample_branch(const PlaneAxis& axis, const AxisBranch& branch, double step);

/// Averages the points of a polyline along its length, by a Gaussian whose standard deviation is `width`, in input
/// units. Its ends stay, except for those of a loop without a junction, `is_loop`, which is one point. No point moves
/// by more than half its radius, and its radius becomes smaller by what it moves, so that the disc around it is still
/// within that of the line. Precondition: width > 0.
std::vector<AxisSample> smooth_polyline(const std::vector<AxisSample>& line, double width, bool is_loop = false);

}  // namespace medial_vk
