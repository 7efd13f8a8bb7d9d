// Random circles in random shapes, and what Algorithm 4 misses in them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/split_mix.h"
#include "support/plane_thesis/missed_points.h"

namespace medial_vk::bench {

/// The statements that are checked.
enum Statement : std::size_t { kPublished, kCorollary, kStrips, kStatements };

struct Worst {
  double share = 0;  ///< The greatest, over all missed points, of the share of the bound that a point comes nearest to.
  std::string where;
};

struct TrialCounts {
  std::uint64_t shapes = 0, circles = 0, undetermined = 0, missing = 0, points = 0;
  std::uint64_t not_combed = 0;  ///< Points at which rounding decided about a sample.
  std::array<std::uint64_t, kStatements> counterexamples = {};
  std::array<Worst, kStatements> worst;

  void add(const TrialCounts& other);
};

/// A shape with its medial axis.
class TrialShape {
 public:
  TrialShape(unsigned family, std::uint64_t seed);
  bool is_usable() const { return is_usable_; }
  /// One circle; counterexamples are printed.
  void try_circle(SplitMix& random, TrialCounts& counts) const;

 private:
  struct Extent {
    PlanePoint lower, upper;
  };
  PlaneCircle random_circle(SplitMix& random) const;
  void check_arc(const test::CombedCircle& combed, const PlaneCircle& circle, const AxisArc& arc, std::size_t samples,
                 TrialCounts& counts) const;
  std::string describe(const PlaneCircle& circle, std::size_t samples, const test::MedialPoint& p) const;

  unsigned family_ = 0;
  std::uint64_t seed_ = 0;
  bool is_usable_ = false;
  PreparedShape shape_;
  PlaneAxis axis_;
  std::vector<Extent> extents_;          // of arcs
  std::vector<PlaneBoundary> boundary_;  // one
};

}  // namespace medial_vk::bench
