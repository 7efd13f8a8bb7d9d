// Medial spheres of a boundary that is known by its nearest points alone (Section 2.6): an analytic solid, a cloud of
// points, an implicit surface, a field of a program's own. docs/theory.md, "Any boundary".
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "medial_vk/medial_spheres.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// A boundary: a closed set S of points of space, not empty. Both functions are called from several threads at once,
/// unless ExtractionOptions::threads is 1, and must give the same answers whenever they are called. An exception that
/// they throw leaves extract_medial_spheres(), except those of exhausted memory (kOutOfMemory).
struct BoundaryFunctions {
  /// Writes to nearest[i] a point of S nearest to points[i]. Must be valid at all points within three diagonals of the
  /// box; answers lie within 64 diagonals of it. In mode certified batches hold some hundreds of points.
  std::function<void(std::span<const Point> points, std::span<Point> nearest)> nearest;
  /// Writes 1 to is_inside[i] if points[i] is inside, and 0 otherwise; for points on S either. It may change only
  /// across S. Without this function all of the box is searched: both sides of a surface, or the space between points.
  std::function<void(std::span<const Point> points, std::span<std::uint8_t> is_inside)> contains;
  /// Of the box whose voxels are searched, in the units of the points; one side may be 0. Sides are rounded up to whole
  /// voxels, so that centres may lie beyond `upper` by less than a voxel.
  Point lower = {0, 0, 0}, upper = {0, 0, 0};
  /// Every answer q for a point p lies within this distance of S, and |p - q| exceeds the distance from p to S by no
  /// more than it. In the units of the points, at most epsilon (1 - cos object_angle) / 2 voxel sides in mode
  /// certified, with deep_angle in its place if there is a radius threshold, and half of epsilon voxel sides in mode
  /// thesis. Answers are found more often the smaller it is. Rounding in double need not be included, if the error of a
  /// formula is below 2^-44 of the coordinates that it takes. 0: exact answers.
  double error = 0;
};

/// The result of a search through nearest points alone.
struct BoundaryExtraction {
  /// As from a mesh, with these differences. `radius` is a lower bound of the distance to S: the open ball meets no
  /// point of S. The spokes lead to the two boundary points between which the search ended, the nearer one first.
  /// `undecided` holds voxels at the boundary as kBoundary: their medial points without a sphere have radii below the
  /// side of a voxel. Counters of contacts and of the device are 0.
  Extraction extraction;
  /// By sphere: a point of the closure of the medial axis of S lies within this distance of the centre, on the same
  /// side of S; proved in both modes. In the units of the points; at most epsilon voxel sides in mode certified.
  std::vector<double> axis_distance;
};

/// Finds medial spheres inside the boundary by queries of it alone, at most one centre per voxel.
///
/// Mode certified: every voxel has a point, or is proved to hold no medial point with the object angle, or is listed as
/// undecided. The proof needs nothing of S: |x|^2 - d(x)^2 is convex, so nearest points are monotone, and those of
/// samples around a cell confine those of its points. It is weaker than the proof by triangles: at an object angle of
/// 0.6 cells are dismissed at depths of about six of their sides, at 0.3 of eleven. Voxels at the boundary are
/// therefore divided finely, which three extra levels do, and stay undecided unless they have a point, since smaller
/// radii than the side of a voxel are not proved absent. Mode thesis: Sections 2.3 and 2.4 as published, which prove
/// nothing about voxels without a point.
///
/// Options as for a mesh; `radius` is a fraction of the longest side of the box, memory_budget and measurements have no
/// effect. Runs on the host, on `threads` threads; the result does not depend on them. Time: in mode certified some
/// 2,000 queries and a millisecond for each voxel at the boundary at an object angle of 0.6. Errors: kUsage (an option
/// out of range, no `nearest`, an infinite box or one without a side of 1e-90 to 1e90, `error` too large, an answer
/// that is not finite or too far away), kOutOfMemory, kInterrupted.
Result<BoundaryExtraction> extract_medial_spheres(const BoundaryFunctions& boundary, const ExtractionOptions& options,
                                                  const ProgressCallback& progress = {},
                                                  const std::stop_token& stop = {});

}  // namespace medial_vk
