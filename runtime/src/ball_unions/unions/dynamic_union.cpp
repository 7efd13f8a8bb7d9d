#include "medial_vk/dynamic_union.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/cells/cell_edge.h"
#include "ball_unions/cells/power_cell.h"
#include "ball_unions/unions/simplex_lists.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/host_memory.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

// Index of the ball of gain(), before those in the slots.
constexpr std::uint32_t kTrial = 0, kFirst = 1, kNoBall = 0xffffffffu;

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

/// A plane that is farther from the centre than this cuts no corner off. The offset is a sum of three terms of at most
/// 4 over a length: where it is above `reach` >= 0 and the length small, so is the difference of the squared radii, and
/// the 8 roundings stay below the 2^-40 that are added for balls that are not tiny; for tiny balls the cut is
/// superfluous.
double reach_of(const std::vector<PowerCell::Corner>& corners) {
  double reach = 0;
  for (const PowerCell::Corner& corner : corners) reach = std::max(reach, length(corner.at) + corner.slack);
  return reach * (1 + 0x1p-30) + 0x1p-40;
}

/// A stored power cell with its measures.
struct BallCell {
  PowerCell::Kept cell;
  BallInCell measured;
  double reach = 0;

  /// True if ball i, or an unknown ball, cut anything from it.
  bool may_grow_without(std::uint32_t i) const {
    const auto name = static_cast<std::int32_t>(i);
    return cell.corners.empty() || std::any_of(cell.planes.begin(), cell.planes.end(),
                                               [&](const Bisector& plane) { return plane.ball == name; });
  }
};

}  // namespace

class DynamicUnion::Impl {
 public:
  Impl(std::uint32_t capacity, double largest)
      : largest_(largest),
        scale_(scale_of(std::vector<Ball>{{{largest, 0, 0}, 0}})),
        capacity_(capacity),
        balls_(kFirst + capacity, kGone),
        given_(kFirst + capacity, kGone),
        cells_(kFirst + capacity),
        cell_(balls_) {}

  std::uint32_t slots() const { return end_ - kFirst; }
  std::uint32_t size() const { return slots() - static_cast<std::uint32_t>(free_.size()); }
  bool holds(std::uint32_t slot) const { return slot < slots() && !is_gone(balls_[kFirst + slot]); }
  const Ball& ball(std::uint32_t slot) const { return given_[kFirst + slot]; }
  std::span<const std::uint32_t> changed() const { return last_.changed; }

  double volume() const {
    CarefulSum sum;
    for (std::uint32_t j = kFirst; j < end_; ++j) sum.add(cells_[j].measured.volume);
    return sum.value() / scale_ / scale_ / scale_;
  }

  Exposure exposure(std::uint32_t slot) const {
    const BallInCell& measured = cells_[kFirst + slot].measured;
    return {measured.area / scale_ / scale_, (1 / scale_ / scale_) * measured.area_vector};
  }

  std::vector<Point> vertices(std::uint32_t slot) const {
    const std::uint32_t i = kFirst + slot;
    const Ball& ball = balls_[i];
    PowerCell cell(balls_);
    cell.restore(cells_[i].cell);
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
    free_.reserve(capacity_);  // so that remove() and undo() need no memory for it
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
    for (auto& [j, kept] : last_.cells_before) std::swap(cells_[j], kept);
    last_.ball = kNoBall;
    last_.changed.clear();
  }

  double gain(const Ball& ball) {
    balls_[kTrial] = scaled(ball);
    find_touching(balls_[kTrial], near_);
    build(kTrial, kNoBall);
    double sum = measure(kTrial).volume;
    for (const std::uint32_t j : near_) {
      if (sum <= 0) break;
      if (cut(j, kTrial)) sum += measure(j).volume - cells_[j].measured.volume;
    }
    return std::max(0.0, sum) / scale_ / scale_ / scale_;
  }

  double loss(std::uint32_t slot) {
    const std::uint32_t i = kFirst + slot;
    double sum = cells_[i].measured.volume;
    find_touching(balls_[i], near_);
    for (const std::uint32_t j : near_) {
      if (sum <= 0) break;
      if (j == i || !cells_[j].may_grow_without(i)) continue;
      build(j, i);
      sum -= measure(j).volume - cells_[j].measured.volume;
    }
    return std::max(0.0, sum) / scale_ / scale_ / scale_;
  }

 private:
  struct Change {
    std::uint32_t ball = kNoBall;
    Ball given_before{};
    std::vector<std::uint32_t> changed;
    std::vector<std::pair<std::uint32_t, BallCell>> cells_before;
  };

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
    const BallCell& kept = cells_[j];
    if (kept.cell.corners.empty() || offset_of(balls_[j], balls_[i]) > kept.reach) return false;
    cell_.restore(kept.cell);
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
    std::swap(last_, change_before_);
    last_.ball = kNoBall;
    last_.changed.clear();
    last_.cells_before.clear();
    try {
      make_change(i, to);
    } catch (...) {
      undo();
      if (end_ > end_before) {  // the slot is the last one freed
        free_.pop_back();
        end_ = end_before;
      }
      std::swap(last_, change_before_);
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
    if (is_gone(to)) put(i, {});
    for (const std::uint32_t j : affected_) update(j, i, was_there);
  }

  /// The cell of j, with its measures, after a change of ball i.
  void update(std::uint32_t j, std::uint32_t i, bool was_there) {
    if (j == i && is_gone(balls_[i])) return;
    if (j == i || (was_there && cells_[j].may_grow_without(i))) {
      build(j, kNoBall);
      put_cell(j);
    } else if (touch(balls_[i], balls_[j]) && cut(j, i)) {
      put_cell(j);
    }
  }

  void put_cell(std::uint32_t j) {
    BallCell kept;
    cell_.keep(kept.cell);
    kept.measured = measure(j);
    kept.reach = reach_of(cell_.corners());
    put(j, std::move(kept));
  }

  void put(std::uint32_t j, BallCell kept) {
    last_.changed.push_back(j - kFirst);
    last_.cells_before.emplace_back(j, BallCell{});  // from here on nothing throws: undo() must not meet this empty one
    last_.cells_before.back().second = std::exchange(cells_[j], std::move(kept));
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
  std::vector<BallCell> cells_;
  std::uint32_t end_ = kFirst;
  std::vector<std::uint32_t> free_;
  Change last_, change_before_;
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
  if (!(largest > 0) || !std::isfinite(largest)) {
    return Error{ErrorCode::kUsage, "`largest` must be positive and finite"};
  }
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
