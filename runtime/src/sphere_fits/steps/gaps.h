// Gaps: the points at which a union of balls inside a solid is farthest from the solid's boundary.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "medial_vk/dynamic_union.h"
#include "solid/solid.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// Found among samples of the boundary and the vertices of the envelope: for the choice of balls, not for proofs.
class GapFinder {
 public:
  /// Keeps references to both. `reach_out`: balls may reach out of the solid, so vertices of the envelope outside are
  /// left out.
  GapFinder(const Solid& solid, const DynamicUnion& balls, bool reach_out = false);

  struct Gap {
    Point at = {0, 0, 0};
    double size = 0;
    /// For a gap on the boundary: the point half way to the nearest ball, if there is one.
    Point towards_balls = {0, 0, 0};
    /// For a gap on the boundary: a unit normal into the solid; at a corner, the mean normal.
    Point inward = {0, 0, 0};
  };
  /// To be called after a change, addition or removal of the ball in a slot.
  void forget(std::uint32_t slot);
  /// The point of the boundary that is farthest from the balls.
  Gap widest_on_boundary();
  /// The vertex of the envelope inside the solid that is farthest from the boundary.
  Gap deepest_vertex();
  /// The same among those of one ball; no value if it has none.
  std::optional<Point> deepest_vertex(std::uint32_t slot);

  /// So that deepest_vertex() knows it for these slots, different ones.
  void find_deepest(std::span<const std::uint32_t> slots, WorkerPool& pool);

  struct Sample {
    Point at, inward;
    std::uint32_t slot;  ///< Of the ball that was nearest.
  };
  /// The samples of the boundary.
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  double distance_to(const Point& p, std::uint32_t slot) const;
  double refresh(Sample& sample) const;
  const Gap& deepest_at(std::uint32_t slot);

  const Solid& solid_;
  const DynamicUnion& balls_;
  bool reach_out_;
  std::vector<Sample> samples_;
  std::size_t widest_ = 0;  // the sample that had the widest gap the last time
  std::vector<std::pair<double, std::uint32_t>> bounds_;
  std::vector<Gap> deepest_;         // by slot
  std::vector<std::uint8_t> known_;  // by slot
};

}  // namespace medial_vk
