// A union of balls in slots, with the power cells that a change alters.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/unions/cell_work.h"
#include "ball_unions/unions/kept_cells.h"
#include "medial_vk/dynamic_union.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// What DynamicUnion promises, for arguments that are valid. Throws std::bad_alloc.
class ChangingUnion {
 public:
  ChangingUnion(std::uint32_t capacity, double largest, unsigned threads);

  double largest() const { return largest_; }
  std::uint32_t capacity() const { return capacity_; }
  void make_room() { cells_.make_room(); }
  void clear(double largest);

  std::uint32_t slots() const { return end_ - kFirst; }
  std::uint32_t size() const { return slots() - static_cast<std::uint32_t>(free_.size()); }
  bool holds(std::uint32_t slot) const { return slot < slots() && !is_gone(balls_[kFirst + slot]); }
  const Ball& ball(std::uint32_t slot) const { return given_[kFirst + slot]; }
  std::span<const std::uint32_t> changed() const { return changed_; }

  double volume() const;
  Exposure exposure(std::uint32_t slot) const { return exposure_of(cells_.of(kFirst + slot).measured); }
  std::vector<Point> vertices(std::uint32_t slot) const;
  double gain(const Ball& ball);
  void gains(std::span<const Ball> balls, std::span<double> gains);
  double loss(std::uint32_t slot);

  std::uint32_t add(const Ball& ball);
  void remove(std::uint32_t slot) { change(kFirst + slot, kGone); }
  void move(std::uint32_t slot, const Ball& to) { change(kFirst + slot, to); }
  /// Allocates no memory.
  void undo();

  bool is_shifting() const { return is_shifting_; }
  void shift(std::uint32_t slot, const Ball& to);
  Exposure exposure_at(std::uint32_t slot, const Ball& to);
  void settle();

 private:
  // Indices of the balls of gain() and gains(), one for each worker, before those in the slots.
  static constexpr std::uint32_t kTrial = 0, kFirst = 16, kNoBall = 0xffffffffu;

  /// The alterations of one change, and the planes of one cell, for which memory is allocated beforehand.
  static std::size_t usual_change(std::uint32_t capacity);
  BallsInSlots all() const { return {balls_, kFirst, end_}; }
  Exposure exposure_of(const BallInCell& measured) const;
  bool cut(std::uint32_t j, std::uint32_t i, PowerCell& cell) const;
  double gain_on(unsigned worker, const Ball& ball);
  BallInCell measure(std::uint32_t i, const PowerCell& cell) const;
  void change(std::uint32_t i, const Ball& to);
  void make_change(std::uint32_t i, const Ball& to);
  void update(std::uint32_t j, std::uint32_t i, bool was_there);
  void note_changed();
  void set_ball(std::uint32_t i, const Ball& to);
  void start_shifts();
  void try_at(std::uint32_t i, const Ball& to);
  void keep_tried();
  std::vector<std::uint32_t> due() const;
  template <class Body>
  void for_all(std::size_t count, const Body& body);

  double largest_;
  double scale_;
  std::uint32_t capacity_;
  std::vector<Ball> balls_;  // scaled; kGone in empty slots
  std::vector<Ball> given_;
  KeptCells cells_;
  std::uint32_t end_ = kFirst;
  std::vector<std::uint32_t> free_;
  struct Change {
    std::uint32_t ball = kNoBall;
    Ball given_before{};
  };
  Change last_, before_;
  std::vector<std::uint32_t> changed_;  // slots
  // Between shift() and settle():
  bool is_shifting_ = false;
  std::vector<std::uint8_t> is_due_;  // by ball: its cell is that of an earlier state
  struct Tried {
    std::uint32_t ball = kNoBall;
    Ball to{};
    BallInCell measured;
  };
  Tried tried_;  // the cell is that of the first worker
  // Scratch memory of the current call.
  std::vector<std::uint32_t> affected_;
  std::vector<std::unique_ptr<CellWork>> works_;  // by worker
  std::unique_ptr<WorkerPool> pool_;              // null: one thread
};

}  // namespace medial_vk
