#include "medial_vk/dynamic_union.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/cells/cell_edge.h"
#include "ball_unions/cells/power_cell.h"
#include "ball_unions/unions/cell_work.h"
#include "ball_unions/unions/kept_cells.h"
#include "ball_unions/unions/simplex_lists.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/host_memory.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "threads/worker_pool.h"

namespace medial_vk {
namespace {

// Indices of the balls of gain() and gains(), one for each worker, before those in the slots.
constexpr std::uint32_t kTrial = 0, kFirst = 16, kNoBall = 0xffffffffu;

/// The alterations of one change, and the planes of one cell, for which memory is allocated beforehand.
constexpr std::size_t kUsualChange = 1024;
std::size_t usual_change(std::uint32_t capacity) { return std::min<std::size_t>(capacity, kUsualChange) + kFirst; }

Status check_largest(double largest) {
  if (largest > 0 && std::isfinite(largest)) return {};
  return Error{ErrorCode::kUsage, "`largest` must be positive and finite"};
}

}  // namespace

class DynamicUnion::Impl {
 public:
  Impl(std::uint32_t capacity, double largest, unsigned threads)
      : largest_(largest),
        scale_(scale_within(largest)),
        capacity_(capacity),
        balls_(kFirst + capacity, kGone),
        given_(kFirst + capacity, kGone),
        cells_(kFirst + capacity, usual_change(capacity)) {
    free_.reserve(capacity);  // so that remove() and undo() need no memory for it
    changed_.reserve(usual_change(capacity));
    affected_.reserve(2 * std::size_t{capacity});
    const unsigned workers = std::min<unsigned>(thread_count(threads), kFirst);
    if (workers > 1) pool_ = std::make_unique<WorkerPool>(workers);
    for (unsigned i = 0; i < workers; ++i) works_.push_back(std::make_unique<CellWork>(balls_, usual_change(capacity)));
  }

  void make_room() { cells_.make_room(); }
  void clear(double largest) {
    largest_ = largest;
    scale_ = scale_within(largest);
    std::ranges::fill(balls_, kGone);
    std::ranges::fill(given_, kGone);
    cells_.clear();
    end_ = kFirst;
    free_.clear();
    last_ = before_ = {};
    changed_.clear();
  }

  std::uint32_t slots() const { return end_ - kFirst; }
  std::uint32_t size() const { return slots() - static_cast<std::uint32_t>(free_.size()); }
  bool holds(std::uint32_t slot) const { return slot < slots() && !is_gone(balls_[kFirst + slot]); }
  const Ball& ball(std::uint32_t slot) const { return given_[kFirst + slot]; }
  std::span<const std::uint32_t> changed() const { return changed_; }

  double volume() const {
    CarefulSum sum;
    for (std::uint32_t j = kFirst; j < end_; ++j) sum.add(cells_.of(j).measured.volume);
    return sum.value() / scale_ / scale_ / scale_;
  }

  Exposure exposure(std::uint32_t slot) const {
    const BallInCell& measured = cells_.of(kFirst + slot).measured;
    return {measured.area / scale_ / scale_, (1 / scale_ / scale_) * measured.area_vector};
  }

  std::vector<Point> vertices(std::uint32_t slot) const {
    const std::uint32_t i = kFirst + slot;
    const Ball& ball = balls_[i];
    PowerCell cell(balls_);
    cells_.restore(i, cell);
    std::vector<Point> found;
    for_each_edge(cell, ball.radius, [&](const CellEdge& edge) {
      if (!(edge.half_chord_squared > 0)) return;
      for (const std::uint32_t plane : edge.planes) {
        if (cell.planes()[plane].ball < 0) return;
      }
      const double half = std::sqrt(edge.half_chord_squared);
      for (const double t : {-half, half}) {
        if (t <= edge.from || t >= edge.to) continue;
        found.push_back((1 / scale_) * (ball.centre + ball.radius * (edge.foot + t * edge.direction)));
      }
    });
    return found;
  }

  /// The error of an invalid ball to be added or moved, if any.
  Status check(const Ball& ball) const {
    if (const Status status = check_balls({&ball, 1}); !status.ok()) return status.error();
    double most = ball.radius;
    for (const double x : ball.centre) most = std::max(most, std::fabs(x));
    if (most > largest_) {
      return Error{ErrorCode::kUsage, "a ball reaches " + std::to_string(most) + ", beyond `largest`, which is " +
                                          std::to_string(largest_)};
    }
    return {};
  }
  Status check(std::uint32_t slot) const {
    if (holds(slot)) return {};
    return Error{ErrorCode::kUsage, "no ball in slot " + std::to_string(slot)};
  }
  Status check_room() const {
    if (size() < capacity_) return {};
    return Error{ErrorCode::kUsage, "the union is full: its `capacity` is " + std::to_string(capacity_)};
  }

  std::uint32_t add(const Ball& ball) {
    const std::uint32_t i = free_.empty() ? end_ : free_.back();
    change(i, ball);
    return i - kFirst;
  }
  void remove(std::uint32_t slot) { change(kFirst + slot, kGone); }
  void move(std::uint32_t slot, const Ball& to) { change(kFirst + slot, to); }

  /// Allocates no memory.
  void undo() {
    if (last_.ball == kNoBall) return;
    set_ball(last_.ball, last_.given_before);
    cells_.undo();
    last_.ball = kNoBall;
    changed_.clear();
  }

  double gain(const Ball& ball, unsigned worker = 0) {
    CellWork& work = *works_[worker];
    const std::uint32_t trial = kTrial + worker;
    balls_[trial] = scaled(ball);
    work.find_touching(all(), balls_[trial], work.near);
    work.build(all(), trial, kNoBall);
    double sum = measure(trial, work.cell).volume;
    for (const std::uint32_t j : work.near) {
      if (sum <= 0) break;
      if (cut(j, trial, work.cell)) sum += measure(j, work.cell).volume - cells_.of(j).measured.volume;
    }
    return std::max(0.0, sum) / scale_ / scale_ / scale_;
  }
  void gains(std::span<const Ball> balls, std::span<double> gains) {
    const auto measure_one = [&](std::size_t i, unsigned worker) { gains[i] = gain(balls[i], worker); };
    if (pool_) return pool_->run(balls.size(), 1, measure_one);
    for (std::size_t i = 0; i < balls.size(); ++i) measure_one(i, 0);
  }

  double loss(std::uint32_t slot) {
    const std::uint32_t i = kFirst + slot;
    double sum = cells_.of(i).measured.volume;
    CellWork& work = *works_.front();
    work.find_touching(all(), balls_[i], work.near);
    for (const std::uint32_t j : work.near) {
      if (sum <= 0) break;
      if (j == i || !cells_.may_grow_without(j, i)) continue;
      work.build(all(), j, i);
      sum -= measure(j, work.cell).volume - cells_.of(j).measured.volume;
    }
    return std::max(0.0, sum) / scale_ / scale_ / scale_;
  }

 private:
  static double scale_within(double largest) { return scale_of(std::array<Ball, 1>{{{{largest, 0, 0}, 0}}}); }

  BallsInSlots all() const { return {balls_, kFirst, end_}; }

  Ball scaled(const Ball& ball) const { return scaled_ball(ball, scale_); }

  /// The stored cell of j, also cut by i. False if that changes nothing.
  bool cut(std::uint32_t j, std::uint32_t i, PowerCell& cell) const {
    const KeptCells::Kept& kept = cells_.of(j);
    if (kept.cell.is_empty() || offset_of(balls_[j], balls_[i]) > kept.reach) return false;
    cells_.restore(j, cell);
    if (!cell.clip(i)) return false;
    cell.sharpen();
    return true;
  }

  /// Measures a cell, which is that of i.
  BallInCell measure(std::uint32_t i, const PowerCell& cell) const {
    if (cell.empty() || balls_[i].radius == 0) return {};
    return measure_ball_in_cell(cell, balls_[i].radius);
  }

  /// Adds a ball (from kGone), removes it (to kGone) or moves it. If memory runs out, the state is unchanged, and the
  /// previous change can still be undone.
  void change(std::uint32_t i, const Ball& to) {
    const std::uint32_t end_before = end_;
    before_ = std::exchange(last_, {});
    cells_.start_change();
    try {
      make_change(i, to);
      note_changed();
    } catch (...) {
      if (last_.ball != kNoBall) set_ball(last_.ball, last_.given_before);
      cells_.give_up();
      if (end_ > end_before) {  // the slot is the last one freed
        free_.pop_back();
        end_ = end_before;
      }
      last_ = before_;
      throw;
    }
  }

  void make_change(std::uint32_t i, const Ball& to) {
    const bool was_there = !is_gone(balls_[i]);
    CellWork& work = *works_.front();
    work.find_touching(all(), balls_[i], affected_);
    last_.given_before = given_[i];
    last_.ball = i;
    set_ball(i, to);
    work.find_touching(all(), balls_[i], work.near);
    append(affected_, work.near);
    sort_unique(affected_);
    if (is_gone(to)) cells_.put_none(i);
    for (const std::uint32_t j : affected_) update(j, i, was_there);
  }

  /// The cell of j, with its measures, after a change of ball i.
  void update(std::uint32_t j, std::uint32_t i, bool was_there) {
    if (j == i && is_gone(balls_[i])) return;
    CellWork& work = *works_.front();
    if (j == i || (was_there && cells_.may_grow_without(j, i))) {
      work.build(all(), j, kNoBall);
    } else if (!touch(balls_[i], balls_[j]) || !cut(j, i, work.cell)) {
      return;
    }
    cells_.put(j, work.cell, measure(j, work.cell));
  }

  void note_changed() {
    changed_.reserve(cells_.changed().size());
    changed_.clear();
    for (const std::uint32_t j : cells_.changed()) changed_.push_back(j - kFirst);
  }

  void set_ball(std::uint32_t i, const Ball& to) {
    const bool was_gone = is_gone(balls_[i]);
    if (was_gone && !is_gone(to)) {
      if (i == end_) ++end_;
      std::erase(free_, i);
    }
    if (!was_gone && is_gone(to)) free_.push_back(i);
    given_[i] = to;
    balls_[i] = is_gone(to) ? to : scaled(to);
  }

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
  // Scratch memory of the current call.
  std::vector<std::uint32_t> affected_;
  std::vector<std::unique_ptr<CellWork>> works_;  // by worker
  std::unique_ptr<WorkerPool> pool_;              // null: one thread
};

DynamicUnion::DynamicUnion(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DynamicUnion::DynamicUnion(DynamicUnion&&) noexcept = default;
DynamicUnion& DynamicUnion::operator=(DynamicUnion&&) noexcept = default;
DynamicUnion::~DynamicUnion() = default;

Result<DynamicUnion> DynamicUnion::build(std::uint32_t capacity, double largest, unsigned threads) {
  if (capacity >= 1u << 30) return Error{ErrorCode::kUsage, "`capacity` must be below 2^30"};
  if (Status status = check_largest(largest); !status.ok()) return status.error();
  return catch_out_of_memory("making room for balls", [&]() -> Result<DynamicUnion> {
    return DynamicUnion(std::make_unique<Impl>(capacity, largest, threads));
  });
}

std::uint32_t DynamicUnion::slots() const { return impl_->slots(); }
bool DynamicUnion::holds(std::uint32_t slot) const { return impl_->holds(slot); }
std::uint32_t DynamicUnion::size() const { return impl_->size(); }
const Ball& DynamicUnion::ball(std::uint32_t slot) const { return impl_->ball(slot); }
double DynamicUnion::volume() const { return impl_->volume(); }
Exposure DynamicUnion::exposure(std::uint32_t slot) const { return impl_->exposure(slot); }

Result<std::vector<Point>> DynamicUnion::vertices(std::uint32_t slot) const {
  return catch_out_of_memory("finding the vertices of a union", [&]() -> Result<std::vector<Point>> {
    if (Status status = impl_->check(slot); !status.ok()) return status.error();
    return impl_->vertices(slot);
  });
}

std::span<const std::uint32_t> DynamicUnion::changed() const { return impl_->changed(); }
Status DynamicUnion::make_room() {
  return catch_out_of_memory("making room for changes of a union", [&]() -> Status {
    impl_->make_room();
    return {};
  });
}

Status DynamicUnion::clear(double largest) {
  if (Status status = check_largest(largest); !status.ok()) return status;
  impl_->clear(largest);
  return {};
}

void DynamicUnion::undo() { impl_->undo(); }

Result<std::uint32_t> DynamicUnion::add(const Ball& ball) {
  return catch_out_of_memory("adding a ball to a union", [&]() -> Result<std::uint32_t> {
    if (Status status = impl_->check(ball); !status.ok()) return status.error();
    if (Status status = impl_->check_room(); !status.ok()) return status.error();
    return impl_->add(ball);
  });
}

Status DynamicUnion::remove(std::uint32_t slot) {
  return catch_out_of_memory("removing a ball from a union", [&]() -> Status {
    if (Status status = impl_->check(slot); !status.ok()) return status;
    impl_->remove(slot);
    return {};
  });
}

Status DynamicUnion::move(std::uint32_t slot, const Ball& to) {
  return catch_out_of_memory("moving a ball of a union", [&]() -> Status {
    if (Status status = impl_->check(slot); !status.ok()) return status;
    if (Status status = impl_->check(to); !status.ok()) return status;
    impl_->move(slot, to);
    return {};
  });
}

Result<double> DynamicUnion::gain(const Ball& ball) {
  return catch_out_of_memory("measuring a ball beside a union", [&]() -> Result<double> {
    if (Status status = impl_->check(ball); !status.ok()) return status.error();
    return impl_->gain(ball);
  });
}

Result<std::vector<double>> DynamicUnion::gains(std::span<const Ball> balls) {
  return catch_out_of_memory("measuring balls beside a union", [&]() -> Result<std::vector<double>> {
    for (const Ball& ball : balls) {
      if (Status status = impl_->check(ball); !status.ok()) return status.error();
    }
    std::vector<double> gains(balls.size());
    impl_->gains(balls, gains);
    return gains;
  });
}

Result<double> DynamicUnion::loss(std::uint32_t slot) {
  return catch_out_of_memory("measuring a union without a ball", [&]() -> Result<double> {
    if (Status status = impl_->check(slot); !status.ok()) return status.error();
    return impl_->loss(slot);
  });
}

}  // namespace medial_vk
