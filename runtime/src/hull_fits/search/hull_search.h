// The search for hulls of one kind inside a solid that cover much of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hull_fits/search/coverage_lines.h"
#include "hull_fits/search/hull_moves.h"
#include "sphere_fits/quality/threads.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// How much a search tries. Results do not depend on the number of threads.
struct HullSearchEffort {
  std::size_t proposals = 64;  ///< For a new hull.
  std::size_t climbed = 3;     ///< Of these, the best ones.
  std::size_t climb = 16;      ///< Generations of a climb of a new hull.
  std::size_t polish = 8;      ///< Generations of a climb of an old one, in a round.
  std::size_t rounds = 3;      ///< Over all hulls, after the set has grown.
  std::size_t lines = 12'000;
};

/// Hulls are grown one by one: of many at random, the best few are climbed by a (1 + 4) evolution strategy on the
/// volume that they cover alone, and the best one stays. Rounds then climb every hull again beside the others, and
/// exchange those that cover least for new ones. The covered volume never falls.
class HullSearch {
 public:
  /// `medial`: balls of the medial points of the solid, at least one.
  HullSearch(const Solid& solid, std::span<const Ball> medial, const SoughtHulls& shape, const HullSearchEffort& effort,
             const Threads& threads);

  const CoverageLines& lines() const { return lines_; }
  /// Adds a hull; false if none was found.
  bool grow();
  /// A round over all hulls.
  void improve();

 private:
  static constexpr std::size_t kFirstBoundarySeeds = 2048;

  struct Trial {
    BallHull hull;
    double gain = 0;
  };

  bool seed_at_boundary();
  Ball touching_ball(const Point& at) const;
  std::vector<Trial> propose(std::size_t except);
  Trial best_new(std::size_t except);
  void climb(Trial& trial, double& step, std::size_t generations, std::size_t except);
  void replace(std::size_t i, const Trial& trial);

  const Solid& solid_;
  HullSearchEffort effort_;
  Threads threads_;
  WorkerPool pool_;
  FreeRadii radii_;
  UncoveredSeeds seeds_;
  HullMoves moves_;
  CoverageLines lines_;
  std::size_t boundary_seeds_ = kFirstBoundarySeeds;
  std::vector<double> steps_;  // by hull: of its climbs
  std::uint64_t draws_ = 0;
};

}  // namespace medial_vk
