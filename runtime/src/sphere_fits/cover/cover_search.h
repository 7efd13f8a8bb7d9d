// Balls that hold given elements, and the search for such balls with little volume outside the solid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sphere_fits/cover/cover_column.h"
#include "sphere_fits/cover/cover_elements.h"

namespace medial_vk {

/// Every element is held by a ball, also after each step. The volume outside is a sum of columns: over each triangle,
/// along its normal, to the farthest end of the balls that hold its middle. Steps that do not lower the sum are undone.
/// Deterministic.
class CoverSearch {
 public:
  /// Every ball grows until it holds the elements that are nearest to it. `ease` is a length: shorter columns count as
  /// straight, longer ones as widening.
  CoverSearch(CoverElements elements, std::vector<Ball> balls, double ease, Threads threads);

  /// Each ball in turn moves, and shrinks around the elements that no other holds.
  void slide();
  /// Assigns the elements that determine the radius of a ball to another one. Returns the number of such changes.
  std::size_t trade();
  /// Moves the most dispensable balls to the balls that reach out most. Returns the number moved.
  std::size_t relocate();
  /// Removes a dispensable ball, after which others have other indices. Precondition: two balls or more.
  void remove_one();
  /// Divides the elements that determine the radius of a ball, unless they are small compared with it.
  void refine();
  /// Adds an element for each point, held by the ball that must grow least for it.
  void add(std::span<const Point> points);

  const std::vector<Ball>& balls() const { return balls_; }
  /// The sum of all columns.
  double total() const { return total_; }
  /// Restores previous balls, which must hold the elements.
  void restore(std::vector<Ball> balls);

 private:
  struct Holder {
    std::uint32_t ball = 0xffffffffu;
    double height = 0;  ///< Of the column.
  };
  struct Touch {
    std::uint32_t element;
    bool holds;     ///< The whole element, not only its middle.
    double height;  ///< Of the column.
  };
  /// The highest two of an element's columns.
  using Highest = std::array<Holder, 2>;
  /// The state of a ball after its last move.
  struct Slid {
    std::size_t alone = 0;
    double radius = -1, share = 0;
    bool operator==(const Slid&) const = default;
  };
  struct Saved {
    std::uint32_t ball;
    Ball before;
  };

  void recount();
  /// Changes a ball and the state of the elements around it, total_ included.
  void replace(std::uint32_t i, const Ball& ball);
  void undo(const std::vector<Saved>& saved);
  Column column(std::uint32_t element) const {
    return {elements_.middle(element), elements_.normal(element), elements_.distance(element)};
  }
  double cost_of(std::uint32_t element, double height) const {
    return elements_.area(element) * column(element).cost(height, ease_);
  }
  double highest(std::uint32_t element, std::uint32_t but) const;
  static void rank(const Holder& holder, Highest& two);
  void add_holder(std::uint32_t element, const Holder& holder);
  void remove_holder(std::uint32_t element, std::uint32_t ball);
  /// Elements that no other ball holds.
  std::vector<std::uint32_t> exclusive(std::uint32_t i) const;
  double needed(const Point& centre, const std::vector<std::uint32_t>& some) const;
  Ball around(const std::vector<std::uint32_t>& some) const;
  /// The part of the sum that only ball i causes.
  double share(std::uint32_t i) const;
  /// The same once ball j is gone, too.
  double share_beside(std::uint32_t i, std::uint32_t j) const;
  /// True if the ball with this radius adds more than `most` to the columns over the elements that it touches now.
  bool costs_more(std::uint32_t i, double radius, double most) const;
  Ball best_around(std::uint32_t i, const std::vector<std::uint32_t>& some, int halvings) const;
  std::vector<std::uint32_t> neighbours(std::uint32_t i, std::size_t count) const;
  /// All balls that are not idle, by decreasing cost.
  std::vector<std::uint32_t> costliest_first() const;
  /// An estimate of the volume by which other balls must grow to replace this ball; 0 if no element is held by it
  /// alone.
  double price_to_leave(std::uint32_t i) const;
  bool is_same_as_slid(std::uint32_t i, std::size_t alone) const;
  void slide_batch(std::span<const std::uint32_t> batch);
  bool trade_one(std::uint32_t i);
  double gain_without(std::uint32_t i, const std::vector<std::uint32_t>& alone, const Ball& taker) const;
  bool leave(std::uint32_t i, std::uint32_t but, double most, std::vector<Saved>& saved);
  void take_share(std::uint32_t i, std::uint32_t wide, const Point& tip, double share);
  std::array<Point, 2> tips(std::uint32_t i) const;
  /// Ball `free` leaves its elements to others and takes a part of those of `wide`, if that lowers the sum.
  bool move_to(std::uint32_t free, std::uint32_t wide);

  CoverElements elements_;
  std::vector<Ball> balls_;
  double ease_;
  Threads threads_;
  std::vector<std::vector<Touch>> touched_;   // by ball: elements whose middles it holds
  std::vector<std::vector<Holder>> holders_;  // by element: balls that hold its middle
  std::vector<std::uint32_t> held_;           // by element: the number of balls that hold it whole
  std::vector<Highest> highest_;              // by element
  std::vector<std::uint32_t> found_;          // of replace(), kept for its memory
  std::vector<Slid> slid_;
  double total_ = 0;
};

}  // namespace medial_vk
