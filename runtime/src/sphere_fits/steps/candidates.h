// Medial balls as candidates, by the volume that they would add to a union.
#pragma once

#include <cstdint>
#include <optional>
#include <queue>
#include <span>
#include <vector>

#include "medial_vk/dynamic_union.h"
#include "sphere_fits/steps/coverage.h"

namespace medial_vk {

/// The gain of a ball never grows while others are added (volume is submodular), so an old gain bounds the new one, and
/// few gains are recomputed for each choice (M. Minoux, "Accelerated greedy algorithms", 1978). If balls of the union
/// have moved meanwhile, old gains are estimates: the choice may then miss the best by the volume that a move has
/// uncovered. Gains by the points of a lattice are estimates, too; they select the few that are measured exactly.
class Candidates {
 public:
  void add(std::span<const Ball> balls);

  struct Choice {
    Ball ball;
    double gain;
  };
  /// The best few by the points of a lattice that the balls of the union hold, for the next take_best(). Throws
  /// std::bad_alloc.
  void find_promising(const Coverage& coverage);
  /// For another lattice: gains that have been measured bound the candidates again, or their volumes.
  void forget_estimates() { queue_ = by_bounds(); }
  /// To be called when balls have been replaced by smaller ones: gains of candidates that met them are no bounds any
  /// more.
  void note_shrunk(std::span<const Ball> before);
  /// The ball with the greatest gain, which is then no candidate any more; no value if none has a gain. Without a call
  /// of find_promising() for it, or if no promising ball has a gain, all are measured exactly as far as needed. Error:
  /// kOutOfMemory.
  Result<std::optional<Choice>> take_best(DynamicUnion& balls);

 private:
  struct Entry {
    double gain;  // known, estimated, or a bound
    std::uint32_t candidate;
    std::uint32_t evaluated;  // the round of the last evaluation
    bool operator<(const Entry& other) const {
      return gain != other.gain ? gain < other.gain : candidate > other.candidate;
    }
  };
  using Queue = std::priority_queue<Entry>;
  static constexpr double kTaken = -1;

  Status measure(DynamicUnion& balls, std::vector<Entry>& entries);
  Choice take(const Entry& best);
  Queue by_bounds() const;
  Result<std::optional<Choice>> take_best_of_all(DynamicUnion& balls);

  std::vector<Ball> balls_;
  std::vector<double> bounds_;  // the gains that were measured last, or volumes; kTaken
  Queue queue_;                 // by estimates; holds those taken, too
  std::vector<Entry> promising_;
  std::uint32_t round_ = 0;
};

}  // namespace medial_vk
