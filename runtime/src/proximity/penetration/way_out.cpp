#include "proximity/penetration/way_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/spiral.h"

namespace medial_vk {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The translations along a direction, by their lengths, between which two balls overlap; none if `to` is below `from`.
struct Overlap {
  double from = kInfinity, to = -kInfinity;
};

/// Two nodes, or two balls, and where they overlap no longer.
struct Task {
  double to = 0;
  std::uint32_t a = 0, b = 0;
};

class Sweep {
 public:
  Sweep(const PlacedBalls& a, const PlacedBalls& b, const QueryFrame& frame) : a_(a), b_(b), frame_(frame) {}

  /// The least translation along `direction`, a unit vector, from `from` on, at which no two balls overlap, up to
  /// rounding, or, if that is `limit` or more, any number of at least the limit.
  double exit(const Point& direction, double from, double limit) {
    direction_ = direction;
    at_ = from;
    limit_ = limit;
    // A pair that was passed over, since it begins beyond, may matter once another pair has led there.
    for (double before = -1; before != at_ && at_ < limit_;) {
      before = at_;
      pass();
    }
    return at_;
  }

  /// Whether every two balls are proved to have no interior point in common after the translation.
  bool are_apart(const Point& translation) {
    open_.assign(1, Task{});
    while (!open_.empty()) {
      const Task task = open_.back();
      open_.pop_back();
      const PlacedNode &a = a_.nodes[task.a], &b = b_.nodes[task.b];
      for (std::uint32_t j = 0; j < b.count; ++j) {
        for (std::uint32_t k = 0; k < a.count; ++k) {
          if (is_apart(a.balls[k], b.balls[j], translation)) continue;
          if (!a.is_lowest || !b.is_lowest) {
            open_.push_back({0, a.is_lowest ? task.a : a.below[k], b.is_lowest ? task.b : b.below[j]});
          } else if (!is_apart(a_.balls[a.below[k]], b_.balls[b.below[j]], translation)) {
            return false;
          }
        }
      }
    }
    return true;
  }

 private:
  bool is_apart(const Ball& a, const Ball& b, const Point& translation) const {
    return length(b.centre + translation - a.centre) - (a.radius + b.radius) >= frame_.error;
  }

  /// Most pairs do not, after the translation so far: this costs no root.
  bool overlap_now(const Ball& a, const Ball& b) const {
    const double reach = a.radius + b.radius + 2 * frame_.error;
    double squared = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double away = b.centre[k] + at_ * direction_[k] - a.centre[k];
      squared += away * away;
    }
    return squared < reach * reach;
  }

  Overlap overlap_of(const Ball& a, const Ball& b) const {
    const Point away = b.centre - a.centre;
    const double along = dot(away, direction_), reach = a.radius + b.radius + 2 * frame_.error;
    const Point across = away - along * direction_;
    const double half_squared = reach * reach - dot(across, across);
    if (!(half_squared > 0)) return {};
    const double half = std::sqrt(half_squared);
    return {-along - half, -along + half};
  }

  /// Moves beyond all pairs that overlap there, those first that lead farthest.
  void pass() {
    open_.assign(1, Task{kInfinity, 0, 0});
    while (!open_.empty() && at_ < limit_) {
      const Task task = open_.back();
      open_.pop_back();
      if (task.to <= at_) continue;
      const std::size_t first = open_.size();
      divide(task);
      std::sort(open_.begin() + static_cast<std::ptrdiff_t>(first), open_.end(),
                [](const Task& s, const Task& t) { return s.to < t.to; });
    }
  }

  void divide(const Task& task) {
    const PlacedNode &a = a_.nodes[task.a], &b = b_.nodes[task.b];
    const bool are_lowest = a.is_lowest && b.is_lowest;
    for (std::uint32_t j = 0; j < b.count; ++j) {
      for (std::uint32_t k = 0; k < a.count; ++k) {
        if (!overlap_now(a.balls[k], b.balls[j])) continue;
        const Overlap overlap = overlap_of(a.balls[k], b.balls[j]);
        if (overlap.from > at_ || overlap.to <= at_) continue;
        if (!are_lowest) {
          open_.push_back({overlap.to, a.is_lowest ? task.a : a.below[k], b.is_lowest ? task.b : b.below[j]});
          continue;
        }
        const Ball &ball_a = a_.balls[a.below[k]], &ball_b = b_.balls[b.below[j]];
        if (!overlap_now(ball_a, ball_b)) continue;
        const Overlap of_balls = overlap_of(ball_a, ball_b);
        if (of_balls.from <= at_ && of_balls.to > at_) at_ = of_balls.to;
      }
    }
  }

  const PlacedBalls& a_;
  const PlacedBalls& b_;
  const QueryFrame& frame_;
  Point direction_ = {0, 0, 1};
  double at_ = 0, limit_ = 0;
  std::vector<Task> open_;
};

struct Aim {
  Point direction = {0, 0, 1};
  double length = 0;
};

Point unit(const Point& p) { return (1 / length(p)) * p; }

/// Shorter ways out along directions near `aim`: those at an angle around it, which is halved, down to the least angle,
/// where none is shorter.
Aim improved(Sweep& sweep, Aim aim, double angle, double least_angle) {
  constexpr double kGoldenAngle = 2.399963229728653;
  constexpr int kAround = 6;
  for (double turn = 0; angle > least_angle; turn += kGoldenAngle) {
    const Point side = perpendicular_to(aim.direction), other = cross(aim.direction, side);
    const Aim middle = aim;
    for (int i = 0; i < kAround; ++i) {
      const double around = turn + 2 * std::numbers::pi / kAround * i;
      const Point direction =
          unit(middle.direction + (angle * std::cos(around)) * side + (angle * std::sin(around)) * other);
      const double exit = sweep.exit(direction, 0, aim.length);
      if (exit < aim.length) aim = {direction, exit};
    }
    if (aim.length == middle.length) angle *= 0.5;
  }
  return aim;
}

/// As long as the aim, or a little longer, and proved.
bool prove(Sweep& sweep, const QueryFrame& frame, const Aim& aim, WayOut& out) {
  constexpr int kTries = 8;
  double at = aim.length, step = 2 * frame.error;
  for (int i = 0; i < kTries && at < frame.longest_translation(); ++i, step *= 4) {
    const Point translation = at * aim.direction;
    if (sweep.are_apart(translation)) {
      out = {translation, length(translation) * (1 + 8 * 0x1p-53)};
      return true;
    }
    at = sweep.exit(aim.direction, at + step, kInfinity);
  }
  return false;
}

}  // namespace

WayOut way_out(const PlacedBalls& a, const PlacedBalls& b, const QueryFrame& frame, std::uint32_t directions) {
  constexpr std::size_t kMostAims = 4;
  constexpr double kNearlyBest = 1.25;  // ways that may become shorter than the shortest one
  Sweep sweep(a, b, frame);
  // Beyond this length everything is apart: |t| less the distance of the origins exceeds both reaches.
  double best = frame.longest_translation();
  std::vector<Aim> aims = {{{0, 0, 1}, best}};
  for (const Point& direction : spiral_points(directions)) {
    const double exit = sweep.exit(direction, 0, kNearlyBest * best);
    if (exit >= kNearlyBest * best) continue;
    aims.push_back({direction, exit});
    best = std::min(best, exit);
  }
  std::ranges::sort(aims, {}, &Aim::length);
  aims.resize(std::min(aims.size(), kMostAims));
  const double between = std::sqrt(4 * std::numbers::pi / directions);
  constexpr double kNearlyThere = 0.125, kLeastAngle = 1e-5;
  for (Aim& aim : aims) aim = improved(sweep, aim, between, kNearlyThere * between);
  std::ranges::sort(aims, {}, &Aim::length);
  aims.front() = improved(sweep, aims.front(), kNearlyThere * between, kLeastAngle);
  WayOut out;
  for (const Aim& aim : aims) {
    if (prove(sweep, frame, aim, out)) return out;
  }
  const Point translation = {0, 0, frame.longest_translation()};
  return {translation, translation[2]};
}

}  // namespace medial_vk
