// Balls inside a solid, spread such that no place of its boundary is far from all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/solid.h"
#include "sphere_fits/quality/threads.h"
#include "sphere_fits/steps/boundary_samples.h"

namespace medial_vk {

/// The search for k centres (docs/theory.md, "Thin parts"): balls come one after the other where the gap is widest
/// (T. Gonzalez, 1985), and each is then moved to the middle of the places that are nearest to it. All balls are
/// maximal, since no ball within another is nearer to anything. Deterministic for any number of threads. Functions
/// throw std::bad_alloc and Stopped.
class SpreadSearch {
 public:
  /// `places`: whose distances count, at least one; those inside have no inward normal. `points_too`: where no ball is
  /// found, as on a surface that encloses nothing, the place itself is one, of radius 0. Keeps a reference to the
  /// solid.
  SpreadSearch(const Solid& solid, std::vector<BoundarySample> places, Threads threads, bool points_too = false);

  /// Adds a ball at the farthest place; false: none is found that is nearer to a place.
  bool insert();
  /// Moves balls, up to so many times each, and exchanges dispensable ones for others. The gap never grows.
  void improve(int rounds);
  /// These balls instead.
  void restore(std::vector<Ball> balls);
  void add_place(const BoundarySample& place);

  /// The greatest distance from a place to the balls, 0 in them; infinite without balls. Places known to be next to no
  /// ball do not count.
  double gap() const;
  /// The same, after all farther places have been tried.
  double reachable_gap();
  const std::vector<Ball>& balls() const { return balls_; }

 private:
  struct Nearest {
    double distance, next;  ///< To the nearest ball, negative in it, and to the one after it.
    std::uint32_t ball;
  };
  /// Places next to each other, which have the same few balls near.
  struct Block {
    std::size_t first, last;  ///< [first, last) of the places
    Point middle;
    double radius;
  };
  void arrange(std::size_t first, std::size_t last);
  void add_block(std::size_t first, std::size_t last);
  void assign();
  void assign(const Block& block);
  void take(const Ball& ball);
  std::vector<Ball> balls_at(const BoundarySample& place, double gap) const;
  std::optional<Ball> ball_near(const Point& p) const;
  double saving(const Ball& ball) const;
  bool is_reachable(std::size_t place);
  std::size_t farthest_place();
  /// Places at that distance or farther.
  std::size_t count_farther(double distance) const;
  bool exchange();
  bool shift_all();
  Ball shifted(const Ball& ball, const std::vector<std::uint32_t>& own) const;
  double farthest(const Ball& ball, const std::vector<std::uint32_t>& own, Point* at = nullptr) const;

  const Solid& solid_;
  std::vector<BoundarySample> places_;
  std::vector<Block> blocks_;
  Threads threads_;
  bool points_too_;
  std::vector<Ball> balls_;
  std::vector<Nearest> nearest_;    // by place
  std::vector<std::uint8_t> dead_;  // by place: no ball nearer to it than the present ones is found
  /// By place: whether a ball is found next to it, as none is at a surface that encloses nothing.
  enum class Reach : std::uint8_t { kUnknown, kSome, kNone };
  std::vector<Reach> reach_;
};

/// A maximal ball that holds the point; none if it is outside, or next to a hole of the boundary.
std::optional<Ball> maximal_through(const Solid& solid, const Point& p);

/// Places for balls by distance: points of the boundary in proportion to its area, and its corners.
std::vector<BoundarySample> places_of(const Solid& solid, std::size_t count);

}  // namespace medial_vk
