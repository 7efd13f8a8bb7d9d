// Random circles in random shapes, and what Algorithm 4 misses in them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/split_mix.h"
#include "support/plane_thesis/missed_points.h"

namespace medial_vk::test {

/// The statements that are checked.
enum Statement : std::size_t { kPublished, kCorollary, kWithTheFlow, kAgainstTheFlow, kStatements };

struct Worst {
  double share = 0;  ///< The greatest, over all missed points, of the share of the bound that a point comes nearest to.
  std::string where;
};

struct TrialCounts {
  std::uint64_t shapes = 0, circles = 0, undetermined = 0, missing = 0, points = 0;
  std::uint64_t not_combed = 0;        ///< Points at which rounding decided about a sample.
  std::uint64_t against_the_flow = 0;  ///< Points with a spoke that leaves between tails.
  std::array<std::uint64_t, kStatements> counterexamples = {};
  std::array<Worst, kStatements> worst;
  std::vector<std::string> reports;  ///< Of the first counterexamples.

  void add(const TrialCounts& other);
};

using Shares = std::array<double, kStatements>;

/// A circle with samples.
struct Trial {
  PlaneCircle circle;
  unsigned samples = 3;
  double phase = 0;   ///< Of the first sample, radians.
  double jitter = 0;  ///< Of the distance of neighbours.
  std::uint64_t seed = 0;

  std::vector<double> angles() const;
};

/// A shape with its medial axis.
class TrialShape {
 public:
  TrialShape(unsigned family, std::uint64_t seed);
  bool is_usable() const { return is_usable_; }
  /// So many random circles, and so many steps each from the worst of them to still worse ones. Counterexamples are
  /// reported.
  void try_circles(std::uint64_t circles, std::uint64_t steps, TrialCounts& counts) const;

 private:
  struct Extent {
    PlanePoint lower, upper;
  };
  Trial random_trial(SplitMix& random) const;
  /// The greatest share of each statement among the missed points.
  Shares check(const Trial& trial, TrialCounts& counts) const;
  Shares check_arc(const CombedCircle& combed, const Trial& trial, const AxisArc& arc, TrialCounts& counts) const;
  std::string describe(const Trial& trial, const MedialPoint& p) const;

  unsigned family_ = 0;
  std::uint64_t seed_ = 0;
  bool is_usable_ = false;
  PreparedShape shape_;
  PlaneAxis axis_;
  std::vector<Extent> extents_;  // of arcs
  std::optional<PlaneBoundary> boundary_;
};

}  // namespace medial_vk::test
