#include "ball_unions/unions/changing_union.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <new>
#include <utility>

#include "ball_unions/cells/cell_edge.h"
#include "ball_unions/cells/power_cell.h"
#include "ball_unions/unions/simplex_lists.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/parallel.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

double scale_within(double largest) { return scale_of(std::array<Ball, 1>{{{{largest, 0, 0}, 0}}}); }

bool is_same(const Ball& a, const Ball& b) { return a.centre == b.centre && a.radius == b.radius; }

}  // namespace

std::size_t ChangingUnion::usual_change(std::uint32_t capacity) {
  constexpr std::size_t kUsualChange = 1024;
  return std::min<std::size_t>(capacity, kUsualChange) + kFirst;
}

ChangingUnion::ChangingUnion(std::uint32_t capacity, double largest, unsigned threads)
    : largest_(largest),
      scale_(scale_within(largest)),
      capacity_(capacity),
      balls_(kFirst + capacity, kGone),
      given_(kFirst + capacity, kGone),
      cells_(kFirst + capacity, usual_change(capacity)),
      is_due_(kFirst + capacity, 0) {
  free_.reserve(capacity);  // so that remove() and undo() need no memory for it
  changed_.reserve(usual_change(capacity));
  affected_.reserve(2 * std::size_t{capacity});
  const unsigned workers = std::min<unsigned>(thread_count(threads), kFirst);
  if (workers > 1) pool_ = std::make_unique<WorkerPool>(workers);
  for (unsigned i = 0; i < workers; ++i) works_.push_back(std::make_unique<CellWork>(balls_, usual_change(capacity)));
}

void ChangingUnion::clear(double largest) {
  largest_ = largest;
  scale_ = scale_within(largest);
  std::ranges::fill(balls_, kGone);
  std::ranges::fill(given_, kGone);
  cells_.clear();
  end_ = kFirst;
  free_.clear();
  last_ = before_ = {};
  changed_.clear();
  is_shifting_ = false;
  std::ranges::fill(is_due_, std::uint8_t{0});
  tried_ = {};
}

double ChangingUnion::volume() const {
  CarefulSum sum;
  for (std::uint32_t j = kFirst; j < end_; ++j) sum.add(cells_.of(j).measured.volume);
  return sum.value() / scale_ / scale_ / scale_;
}

Exposure ChangingUnion::exposure_of(const BallInCell& measured) const {
  return {measured.area / scale_ / scale_, (1 / scale_ / scale_) * measured.area_vector};
}

std::vector<Point> ChangingUnion::vertices(std::uint32_t slot) const {
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

double ChangingUnion::gain(const Ball& ball) {
  tried_.ball = kNoBall;
  return gain_on(0, ball);
}

double ChangingUnion::gain_on(unsigned worker, const Ball& ball) {
  CellWork& work = *works_[worker];
  const std::uint32_t trial = kTrial + worker;
  balls_[trial] = scaled_ball(ball, scale_);
  work.find_touching(all(), balls_[trial], work.near);
  work.build(all(), trial, kNoBall);
  double sum = measure(trial, work.cell).volume;
  for (const std::uint32_t j : work.near) {
    if (sum <= 0) break;
    if (cut(j, trial, work.cell)) sum += measure(j, work.cell).volume - cells_.of(j).measured.volume;
  }
  return std::max(0.0, sum) / scale_ / scale_ / scale_;
}

/// Calls body(i, worker) on the threads.
template <class Body>
void ChangingUnion::for_all(std::size_t count, const Body& body) {
  if (pool_) return pool_->run(count, 1, body);
  for (std::size_t i = 0; i < count; ++i) body(i, 0u);
}

void ChangingUnion::gains(std::span<const Ball> balls, std::span<double> gains) {
  tried_.ball = kNoBall;
  for_all(balls.size(), [&](std::size_t i, unsigned worker) { gains[i] = gain_on(worker, balls[i]); });
}

double ChangingUnion::loss(std::uint32_t slot) {
  tried_.ball = kNoBall;
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

std::uint32_t ChangingUnion::add(const Ball& ball) {
  const std::uint32_t i = free_.empty() ? end_ : free_.back();
  change(i, ball);
  return i - kFirst;
}

void ChangingUnion::undo() {
  tried_.ball = kNoBall;
  if (last_.ball == kNoBall) return;
  set_ball(last_.ball, last_.given_before);
  cells_.undo();
  last_.ball = kNoBall;
  changed_.clear();
}

/// The stored cell of j, also cut by i. False if that changes nothing.
bool ChangingUnion::cut(std::uint32_t j, std::uint32_t i, PowerCell& cell) const {
  const KeptCells::Kept& kept = cells_.of(j);
  if (kept.cell.is_empty() || offset_of(balls_[j], balls_[i]) > kept.reach) return false;
  cells_.restore(j, cell);
  if (!cell.clip(i)) return false;
  cell.sharpen();
  return true;
}

/// Measures a cell, which is that of i.
BallInCell ChangingUnion::measure(std::uint32_t i, const PowerCell& cell) const {
  if (cell.empty() || balls_[i].radius == 0) return {};
  return measure_ball_in_cell(cell, balls_[i].radius);
}

/// Adds a ball (from kGone), removes it (to kGone) or moves it. If memory runs out, the state is unchanged, and the
/// previous change can still be undone.
void ChangingUnion::change(std::uint32_t i, const Ball& to) {
  tried_.ball = kNoBall;
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

void ChangingUnion::make_change(std::uint32_t i, const Ball& to) {
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
void ChangingUnion::update(std::uint32_t j, std::uint32_t i, bool was_there) {
  if (j == i && is_gone(balls_[i])) return;
  CellWork& work = *works_.front();
  if (j == i || (was_there && cells_.may_grow_without(j, i))) {
    work.build(all(), j, kNoBall);
  } else if (!touch(balls_[i], balls_[j]) || !cut(j, i, work.cell)) {
    return;
  }
  cells_.put(j, work.cell, measure(j, work.cell));
}

void ChangingUnion::note_changed() {
  changed_.reserve(cells_.changed().size());
  changed_.clear();
  for (const std::uint32_t j : cells_.changed()) changed_.push_back(j - kFirst);
}

void ChangingUnion::set_ball(std::uint32_t i, const Ball& to) {
  const bool was_gone = is_gone(balls_[i]);
  if (was_gone && !is_gone(to)) {
    if (i == end_) ++end_;
    std::erase(free_, i);
  }
  if (!was_gone && is_gone(to)) free_.push_back(i);
  given_[i] = to;
  balls_[i] = is_gone(to) ? to : scaled_ball(to, scale_);
}

void ChangingUnion::start_shifts() {
  if (is_shifting_) return;
  last_ = before_ = {};
  cells_.forget_changes();
  is_shifting_ = true;
}

void ChangingUnion::shift(std::uint32_t slot, const Ball& to) {
  start_shifts();
  const std::uint32_t i = kFirst + slot;
  std::vector<std::uint32_t>& near = works_.front()->near;
  CellWork::find_touching(all(), balls_[i], near);
  for (const std::uint32_t j : near) {
    if (!is_due_[j] && cells_.may_grow_without(j, i)) is_due_[j] = true;
  }
  set_ball(i, to);
  CellWork::find_touching(all(), balls_[i], near);
  for (const std::uint32_t j : near) {
    if (offset_of(balls_[j], balls_[i]) <= cells_.of(j).reach) is_due_[j] = true;
  }
  is_due_[i] = true;
  if (tried_.ball == i && is_same(tried_.to, to)) keep_tried();
  tried_.ball = kNoBall;  // its cell was among the others as they were
}

/// Its cell among the others as they are now.
void ChangingUnion::try_at(std::uint32_t i, const Ball& to) {
  tried_.ball = kNoBall;
  CellWork& work = *works_.front();
  const Ball is = std::exchange(balls_[i], scaled_ball(to, scale_));
  try {
    work.build(all(), i, kNoBall);
    tried_ = {i, to, measure(i, work.cell)};
  } catch (...) {
    balls_[i] = is;
    throw;
  }
  balls_[i] = is;
}

Exposure ChangingUnion::exposure_at(std::uint32_t slot, const Ball& to) {
  const std::uint32_t i = kFirst + slot;
  const bool is_there = is_same(given_[i], to);
  if (is_there && !is_due_[i]) return exposure_of(cells_.of(i).measured);
  try_at(i, to);
  const Exposure exposure = exposure_of(tried_.measured);
  if (is_there) keep_tried();
  return exposure;
}

/// For the ball where it is now. Without memory for the cell, it remains to be computed.
void ChangingUnion::keep_tried() {
  const std::uint32_t i = std::exchange(tried_.ball, kNoBall);
  try {
    cells_.put_for_good(i, works_.front()->cell, tried_.measured);
    is_due_[i] = false;
  } catch (const std::bad_alloc&) {
  }
}

std::vector<std::uint32_t> ChangingUnion::due() const {
  std::vector<std::uint32_t> found;
  for (std::uint32_t j = kFirst; j < end_; ++j) {
    if (is_due_[j]) found.push_back(j);
  }
  return found;
}

void ChangingUnion::settle() {
  if (!is_shifting_) return;
  tried_.ball = kNoBall;
  const std::vector<std::uint32_t> due_now = due();
  std::mutex mutex;
  for_all(due_now.size(), [&](std::size_t k, unsigned worker) {
    const std::uint32_t j = due_now[k];
    CellWork& work = *works_[worker];
    work.build(all(), j, kNoBall);
    const BallInCell measured = measure(j, work.cell);
    const std::lock_guard lock(mutex);
    cells_.put_for_good(j, work.cell, measured);
    is_due_[j] = false;
  });
  note_changed();
  // Threads take cells in any order, and that of a ball may have been computed more than once.
  sort_unique(changed_);
  is_shifting_ = false;
}

}  // namespace medial_vk
