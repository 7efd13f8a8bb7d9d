// The power cells of a union that changes, with their measures, and what they were before the last change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/cells/cell_store.h"
#include "ball_unions/cells/power_cell.h"

namespace medial_vk {

/// A plane that is farther from the centre than this cuts no corner off. The offset is a sum of three terms of at most
/// 4 over a length: where it is above `reach` >= 0 and the length small, so is the difference of the squared radii, and
/// the 8 roundings stay below the 2^-40 that are added for balls that are not tiny; for tiny balls the cut is
/// superfluous.
double reach_of(std::span<const PowerCell::Corner> corners);

/// By ball. Changes follow each other, and the last one can be taken back; so can the one before, once the last one has
/// been taken back by give_up().
class KeptCells {
 public:
  struct Kept {
    CellStore::Place cell;
    BallInCell measured;
    double reach = 0;  ///< As reach_of().
  };

  /// Makes room for changes that alter `usual` cells. Throws std::bad_alloc.
  KeptCells(std::size_t balls, std::size_t usual);
  /// Room for cells that are twice as large in all. Throws std::bad_alloc.
  void make_room();
  /// Without cells, in the same memory.
  void clear();

  const Kept& of(std::uint32_t ball) const { return kept_[ball]; }
  /// True if ball i, or an unknown ball, cut anything from the cell.
  bool may_grow_without(std::uint32_t ball, std::uint32_t i) const;
  void restore(std::uint32_t ball, PowerCell& cell) const { store_.restore(kept_[ball].cell, cell); }

  void start_change();
  /// Nothing can be taken back any more.
  void forget_changes();
  /// Once for each ball in a change. If they throw std::bad_alloc, the cell is as before.
  void put(std::uint32_t ball, const PowerCell& cell, const BallInCell& measured);
  /// As put(), at any time after forget_changes(), but without a way back.
  void put_for_good(std::uint32_t ball, const PowerCell& cell, const BallInCell& measured);
  void put_none(std::uint32_t ball) { replace(ball, {}); }
  /// The balls whose cells the last change has altered.
  std::span<const std::uint32_t> changed() const { return last_.balls; }
  /// Allocate nothing.
  void undo();
  void give_up();

 private:
  struct Change {
    std::vector<std::uint32_t> balls;
    std::vector<std::pair<std::uint32_t, Kept>> before;

    void clear() {
      balls.clear();
      before.clear();
    }
  };

  void replace(std::uint32_t ball, const Kept& by);
  void close_gaps(const PowerCell& next);
  void list_places();

  std::vector<Kept> kept_;
  Change last_, before_;
  CellStore store_;
  std::vector<CellStore::Place*> places_;
};

}  // namespace medial_vk
