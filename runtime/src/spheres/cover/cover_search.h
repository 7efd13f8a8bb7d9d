// Balls that hold given pieces, and the search for such balls that stick out little.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "spheres/cover/cover_pieces.h"

namespace medial_vk {

/// Every piece is held by a ball; steps keep it so. What sticks out is counted as columns: over each triangle, along
/// its normal, up to where the last of the balls ends that hold its middle. Steps that do not lower the sum are undone.
/// Deterministic.
class CoverSearch {
 public:
  /// Every ball grows until it holds the pieces that are nearest to it. `ease` is a length: columns shorter than this
  /// count as if they were straight, longer ones as if they spread.
  CoverSearch(CoverPieces pieces, std::vector<Ball> balls, double ease, Threads threads);

  /// Each ball in turn moves, and shrinks around the pieces that no other holds.
  void slide();
  /// The pieces that hold up a ball go to another one. Returns how many times that was done.
  std::size_t trade();
  /// Balls that are missed least are set down beside those that stick out most. Returns how many were.
  std::size_t relocate();
  /// Takes away a ball that is missed little, after which others have other indices. There must be two.
  void remove_one();
  /// Cuts the pieces that hold up a ball, unless they are small beside it.
  void refine();
  /// More pieces, one for each point; the balls that must grow least take them.
  void add(std::span<const Point> points);

  const std::vector<Ball>& balls() const { return balls_; }
  /// Back to balls that were there before; the pieces must be held by them.
  void restore(std::vector<Ball> balls);

 private:
  struct Holder {
    std::uint32_t ball = 0xffffffffu;
    bool holds = false;  ///< All of it, not only the middle.
    double height = 0;   ///< Of the column.
  };
  /// The highest two of a piece's columns.
  using Highest = std::array<Holder, 2>;
  /// What a ball was like when it had been moved.
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
  /// Changes a ball and what is known of the pieces around it, total_ included.
  void replace(std::uint32_t i, const Ball& ball);
  void undo(const std::vector<Saved>& saved);
  double cost_of(std::uint32_t piece, double height) const;
  double column(double height) const;
  double highest(std::uint32_t piece, std::uint32_t but) const;
  static void rank(const Holder& holder, Highest& two);
  void add_holder(std::uint32_t piece, const Holder& holder);
  double remove_holder(std::uint32_t piece, std::uint32_t ball);
  /// Pieces that no other ball holds.
  std::vector<std::uint32_t> exclusive(std::uint32_t i) const;
  double needed(const Point& centre, const std::vector<std::uint32_t>& some) const;
  Ball around(const std::vector<std::uint32_t>& some) const;
  /// What ball i costs that no other does.
  double share(std::uint32_t i) const;
  /// Does the ball with this radius stick out, over what it touches now, for more than `most` beyond what is paid?
  bool costs_more(std::uint32_t i, double radius, double most) const;
  Ball best_around(std::uint32_t i, const std::vector<std::uint32_t>& some, int halvings) const;
  std::vector<std::uint32_t> neighbours(std::uint32_t i, std::size_t count) const;
  /// All that are not idle, those that cost most first.
  std::vector<std::uint32_t> costliest_first() const;
  /// What the others must at least grow by to do without this ball, as a volume; 0 if it holds nothing alone.
  double price_to_leave(std::uint32_t i) const;
  bool is_same_as_slid(std::uint32_t i, std::size_t alone) const;
  void slide_batch(std::span<const std::uint32_t> batch);
  bool trade_one(std::uint32_t i);
  bool leave(std::uint32_t i, std::uint32_t but, std::vector<Saved>& saved);
  void take_share(std::uint32_t i, std::uint32_t wide, const Point& tip, double share);
  std::array<Point, 2> tips(std::uint32_t i) const;
  /// Ball `free` leaves what it holds to others and takes a part of what `wide` holds, if that pays.
  bool move_to(std::uint32_t free, std::uint32_t wide);

  CoverPieces pieces_;
  std::vector<Ball> balls_;
  double ease_;
  Threads threads_;
  std::vector<std::vector<std::uint32_t>> touched_;  // by ball: pieces whose middles it holds
  std::vector<std::vector<Holder>> holders_;         // by piece
  std::vector<Highest> highest_;                     // by piece
  std::vector<Slid> slid_;
  double total_ = 0;
};

}  // namespace medial_vk
