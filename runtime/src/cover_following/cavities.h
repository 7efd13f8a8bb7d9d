// Cavities between balls that cover a closed surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ball_unions/unions/union_measurer.h"
#include "base/disjoint_sets.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/ball.h"
#include "medial_vk/result.h"
#include "sphere_fits/quality/envelope.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// Keeps its memory from one frame to the next: a frame that repeats an earlier one allocates nothing, unless the balls
/// have no triangulation of a linear size.
class CavitySearch {
 public:
  /// Balls that hold every triangle of a closed surface, at least one of a positive radius. Some grow, and some of
  /// radius 0 are placed anew, until every point with a winding number other than 0 is held. False: that is not proved.
  /// Deterministic. Throws std::bad_alloc. Errors: those of measure_ball_union().
  Result<bool> fill(const MovingSurface& surface, std::vector<Ball>& balls, WorkerPool& pool);

 private:
  /// How vertices are divided into cavities: those that arcs may join, those that share a ball, or none.
  enum class Joined : std::uint8_t { kByArcs, kByBalls, kAll };
  /// Points that a ball must hold, with bounds of their errors, as balls.
  using Cavity = std::span<const Ball>;
  /// A vertex with two of its balls, or one of them twice.
  struct Key {
    std::array<std::uint32_t, 2> balls;
    std::uint32_t vertex;
  };
  struct Grouped {
    std::uint32_t group, vertex;
  };

  void find_points(const MovingSurface& surface, WorkerPool& pool);
  void group_points(Joined joined);
  bool fill_one(Cavity cavity, double least_radius, std::vector<Ball>& balls);

  UnionMeasurer measurer_;
  Envelope envelope_;
  std::vector<Ball> holding_;
  std::vector<double> errors_;           // by vertex of the envelope; negative: not in the solid
  std::vector<EnvelopeVertex> inside_;   // the others
  std::vector<Ball> points_, by_group_;  // the same with their errors; the groups one after the other
  DisjointSets groups_;                  // of these
  std::vector<Key> keys_;
  std::vector<Grouped> grouped_;
  std::vector<Point> centres_;
};

}  // namespace medial_vk
