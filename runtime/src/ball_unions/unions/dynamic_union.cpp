#include "medial_vk/dynamic_union.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/cells/cell_edge.h"
#include "ball_unions/cells/power_cell.h"
#include "ball_unions/unions/kept_cells.h"
#include "ball_unions/unions/simplex_lists.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/host_memory.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

// Index of the ball of gain(), before those in the slots.
constexpr std::uint32_t kTrial = 0, kFirst = 1, kNoBall = 0xffffffffu;

/// The alterations of one change, and the planes of one cell, for which memory is allocated beforehand.
constexpr std::size_t kUsualChange = 1024;
std::size_t usual_change(std::uint32_t capacity) { return std::min<std::size_t>(capacity, kUsualChange) + kFirst; }

constexpr Ball kGone = {{0, 0, 0}, std::numeric_limits<double>::quiet_NaN()};  // touches nothing
bool is_gone(const Ball& ball) { return std::isnan(ball.radius); }

bool touch(const Ball& a, const Ball& b) {
  const double both = a.radius + b.radius;
  const Point between = b.centre - a.centre;
  return dot(between, between) <= both * both * (1 + 16 * DBL_EPSILON);
}

/// The offset of the plane between two balls, from the centre of the first towards the other.
double offset_of(const Ball& ball, const Ball& other) {
  const Point between = other.centre - ball.centre;
  const double squared = dot(between, between);
  if (squared == 0) return -HUGE_VAL;
  return (squared + ball.radius * ball.radius - other.radius * other.radius) / (2 * std::sqrt(squared));
}

Status check_largest(double largest) {
  if (largest > 0 && std::isfinite(largest)) return {};
  return Error{ErrorCode::kUsage, "`largest` must be positive and finite"};
}

}  // namespace

class DynamicUnion::Impl {
 public:
  Impl(std::uint32_t capacity, double largest)
      : largest_(largest),
        scale_(scale_within(largest)),
        capacity_(capacity),
        balls_(kFirst + capacity, kGone),
        given_(kFirst + capacity, kGone),
        cells_(kFirst + capacity, usual_change(capacity)),
        cell_(balls_) {
    free_.reserve(capacity);  // so that remove() and undo() need no memory for it
    changed_.reserve(usual_change(capacity));
    near_.reserve(capacity);
    cutting_.reserve(capacity);
    affected_.reserve(2 * std::size_t{capacity});
    order_.reserve(capacity);
    cell_.make_room(usual_change(capacity), 0);
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

  double gain(const Ball& ball) {
    balls_[kTrial] = scaled(ball);
    find_touching(balls_[kTrial], near_);
    build(kTrial, kNoBall);
    double sum = measure(kTrial).volume;
    for (const std::uint32_t j : near_) {
      if (sum <= 0) break;
      if (cut(j, kTrial)) sum += measure(j).volume - cells_.of(j).measured.volume;
    }
    return std::max(0.0, sum) / scale_ / scale_ / scale_;
  }

  double loss(std::uint32_t slot) {
    const std::uint32_t i = kFirst + slot;
    double sum = cells_.of(i).measured.volume;
    find_touching(balls_[i], near_);
    for (const std::uint32_t j : near_) {
      if (sum <= 0) break;
      if (j == i || !cells_.may_grow_without(j, i)) continue;
      build(j, i);
      sum -= measure(j).volume - cells_.of(j).measured.volume;
    }
    return std::max(0.0, sum) / scale_ / scale_ / scale_;
  }

 private:
  static double scale_within(double largest) { return scale_of(std::array<Ball, 1>{{{{largest, 0, 0}, 0}}}); }

  Ball scaled(const Ball& ball) const { return scaled_ball(ball, scale_); }

  void find_touching(const Ball& ball, std::vector<std::uint32_t>& found) const {
    found.clear();
    for (std::uint32_t j = kFirst; j < end_; ++j) {
      if (touch(ball, balls_[j])) found.push_back(j);
    }
  }

  /// The cell of i among all balls except `without`, cut by the nearest planes first: most others are then beyond all
  /// corners.
  void build(std::uint32_t i, std::uint32_t without) {
    find_touching(balls_[i], cutting_);
    order_.clear();
    for (const std::uint32_t j : cutting_) {
      if (j != i && j != without) order_.emplace_back(offset_of(balls_[i], balls_[j]), j);
    }
    // Few of them are needed: a heap yields these in order, without sorting the others.
    std::make_heap(order_.begin(), order_.end(), std::greater<>());
    cell_.start(i);
    double reach = reach_of(cell_.corners());
    for (auto end = order_.end(); end != order_.begin() && order_.front().first <= reach && !cell_.empty(); --end) {
      std::pop_heap(order_.begin(), end, std::greater<>());
      if (cell_.clip((end - 1)->second)) reach = reach_of(cell_.corners());
    }
    cell_.sharpen();
  }

  /// The stored cell of j, also cut by i. False if that changes nothing.
  bool cut(std::uint32_t j, std::uint32_t i) {
    const KeptCells::Kept& kept = cells_.of(j);
    if (kept.cell.is_empty() || offset_of(balls_[j], balls_[i]) > kept.reach) return false;
    cells_.restore(j, cell_);
    if (!cell_.clip(i)) return false;
    cell_.sharpen();
    return true;
  }

  /// Measures the current cell, which is that of i.
  BallInCell measure(std::uint32_t i) const {
    if (cell_.empty() || balls_[i].radius == 0) return {};
    return measure_ball_in_cell(cell_, balls_[i].radius);
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
    find_touching(balls_[i], affected_);
    last_.given_before = given_[i];
    last_.ball = i;
    set_ball(i, to);
    find_touching(balls_[i], near_);
    append(affected_, near_);
    sort_unique(affected_);
    if (is_gone(to)) cells_.put_none(i);
    for (const std::uint32_t j : affected_) update(j, i, was_there);
  }

  /// The cell of j, with its measures, after a change of ball i.
  void update(std::uint32_t j, std::uint32_t i, bool was_there) {
    if (j == i && is_gone(balls_[i])) return;
    if (j == i || (was_there && cells_.may_grow_without(j, i))) {
      build(j, kNoBall);
      put_cell(j);
    } else if (touch(balls_[i], balls_[j]) && cut(j, i)) {
      put_cell(j);
    }
  }

  void put_cell(std::uint32_t j) { cells_.put(j, cell_, measure(j)); }

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
  PowerCell cell_;
  std::vector<std::uint32_t> near_, cutting_, affected_;
  std::vector<std::pair<double, std::uint32_t>> order_;
};

DynamicUnion::DynamicUnion(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
DynamicUnion::DynamicUnion(DynamicUnion&&) noexcept = default;
DynamicUnion& DynamicUnion::operator=(DynamicUnion&&) noexcept = default;
DynamicUnion::~DynamicUnion() = default;

Result<DynamicUnion> DynamicUnion::build(std::uint32_t capacity, double largest) {
  if (capacity >= 1u << 30) return Error{ErrorCode::kUsage, "`capacity` must be below 2^30"};
  if (Status status = check_largest(largest); !status.ok()) return status.error();
  return catch_out_of_memory("making room for balls", [&]() -> Result<DynamicUnion> {
    return DynamicUnion(std::make_unique<Impl>(capacity, largest));
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

Result<double> DynamicUnion::loss(std::uint32_t slot) {
  return catch_out_of_memory("measuring a union without a ball", [&]() -> Result<double> {
    if (Status status = impl_->check(slot); !status.ok()) return status.error();
    return impl_->loss(slot);
  });
}

}  // namespace medial_vk
