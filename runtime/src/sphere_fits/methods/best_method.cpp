#include "sphere_fits/methods/best_method.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "base/point_ops.h"
#include "sphere_fits/cover/cover_family.h"
#include "sphere_fits/methods/ball_history.h"
#include "sphere_fits/methods/fit_goals.h"
#include "sphere_fits/methods/prefixes.h"
#include "sphere_fits/steps/ball_steps.h"
#include "sphere_fits/steps/candidates.h"
#include "sphere_fits/steps/gap_balls.h"
#include "sphere_fits/steps/gaps.h"
#include "sphere_fits/steps/maximal_ball.h"
#include "sphere_fits/steps/near_boundary.h"
#include "threads/worker_pool.h"

namespace medial_vk {
namespace {

// Larger sets require finer candidates: from `from` balls on, those of `resolution` voxels along the longest side.
struct Level {
  std::size_t from;
  std::uint32_t resolution;
};
constexpr std::array<Level, 4> kLevels = {{{0, 64}, {64, 128}, {512, 256}, {4096, 512}}};
// Balls of small object angles fill the edges; below this angle, their number grows but not their gain.
constexpr double kObjectAngle = 0.3;

constexpr std::size_t kGapPeriod = 8;  // every eighth ball is placed by distance instead of volume
constexpr std::size_t kFirstGap = 16;  // earlier balls form the rough shape
constexpr double kAsGood = 0.4;        // share of the best gain from which a ball placed by distance is preferred

/// Step lengths of sliding, in radii of the ball.
constexpr double kFirstStep = 0.2, kLeastFirstStep = 0.05;
constexpr int kOwnSlides = 3, kSweeps = 12;
constexpr double kEnough = 5e-4;  // share of the gain of the new ball: a sweep that gains less is the last

// Of the lattice by which candidates are selected: points in the union, for each ball and at least. The more balls, the
// smaller the share of a ball's volume that no other holds.
constexpr double kPointsOfBall = 2048, kPointsOfOneOfMany = 8192, kLeastPoints = 1 << 15;
constexpr std::size_t kMany = 512;

class Placing final : public GrowingBalls {
 public:
  Placing(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor, DynamicUnion balls)
      : solid_(solid),
        options_(options),
        extractor_(extractor),
        balls_(std::move(balls)),
        coverage_(solid.mesh().report.lower, solid.mesh().report.upper),
        pool_(options.threads),
        near_boundary_(solid, near_limit(options)),
        moves_(options.contract == SphereContract::kBalanced ? balancing_steps(solid, bound()) : sliding_steps(solid)),
        gaps_(solid, balls_, options.contract == SphereContract::kBalanced),
        goals_(solid, options) {}

  Result<SphereSet> run(const SphereProgress& progress) {
    const std::size_t most = options_.count > 0 ? options_.count : kMostBalls;
    for (;;) {
      progress_ = &progress;
      const Result<bool> met = goals_met();
      if (!met) return met.error();
      if (met.value()) return result();
      if (balls_.size() == most || ends_) break;
      if (Status status = grow(balls_.size() + 1, most, progress); !status) return status.error();
    }
    if (goals_.any()) return goals_.unmet(estimates(), balls_.size());
    return result();
  }

  /// Adds balls until there are `count`, or no more are found. `most`: of them, for the reported share.
  Status grow(std::size_t count, std::size_t most, const SphereProgress& progress) {
    progress_ = &progress;
    while (balls_.size() < count && !ends_) {
      if (Status status = find_candidates(); !status.ok()) return status.error();
      Result<std::optional<Candidates::Choice>> choice = choose();
      if (!choice) return choice.error();
      ends_ = !choice.value();
      if (ends_) break;
      if (Status status = place(*choice.value()); !status.ok()) return status.error();
      if (Status status = keep_bound_if_due(); !status.ok()) return status.error();
      volumes_.push_back(balls_.volume());
      if (std::has_single_bit(balls_.size())) divide_coverage();
      if (is_stage(balls_.size(), most)) stages_[balls_.size()] = bounded_balls();
      if (!progress) continue;
      shown_ = share_done(most);
      if (!progress("spheres", shown_)) return Error{ErrorCode::kInterrupted, "interrupted"};
    }
    if (balls_.size() == 0) return Error{ErrorCode::kInvalidMesh, "no ball fits into the solid"};
    return {};
  }

  Status grow(std::size_t count, const SphereProgress& progress) override { return grow(count, count, progress); }
  bool ends() const override { return ends_; }
  const std::vector<double>& volumes() const override { return volumes_; }
  std::vector<Ball> at(std::size_t count) const override { return history_.at(count, all_balls()); }

 private:
  /// Covers begin with balls inside; balanced sets of smaller numbers are levels.
  bool is_stage(std::size_t count, std::size_t most) const {
    if (options_.contract == SphereContract::kInside) return cover_top(count) == count;
    const std::vector<std::size_t> levels = level_counts(most);
    return std::binary_search(levels.begin(), levels.end(), count);
  }

  FitGoals::Estimates estimates() {
    return {options_.error > 0 ? moves_->error(balls_) : 0,
            options_.max_gap > 0 || goals_.includes_distance() ? gaps_.widest_on_boundary().size : 0};
  }

  Result<bool> goals_met() {
    if (!goals_.any() || balls_.size() == 0) return false;
    const FitGoals::Estimates now = estimates();
    if (!goals_.may_be_met(now)) return false;
    return goals_.are_met(now, bounded_balls(), {options_.threads, goes_on()});
  }

  /// For loops on several threads.
  std::function<bool()> goes_on() const {
    return [&, mutex = std::make_shared<std::mutex>()] {
      const std::lock_guard lock(*mutex);
      return !*progress_ || (*progress_)("spheres", shown_);
    };
  }

  double share_done(std::size_t most) {
    if (goals_.any() && options_.count == 0) return goals_.share_done(estimates());
    return static_cast<double>(balls_.size()) / static_cast<double>(most);
  }

  /// Switches to the next finer medial points, if there are enough balls for them.
  Status find_candidates() {
    if (options_.resolution > 0) return levels_ > 0 ? Status() : extract(options_.resolution);
    while (levels_ < kLevels.size() && kLevels[levels_].from <= balls_.size()) {
      if (Status status = extract(kLevels[levels_].resolution); !status.ok()) return status;
    }
    return {};
  }

  Status extract(std::uint32_t resolution) {
    ExtractionOptions options;
    options.resolution = resolution;
    options.object_angle = kObjectAngle;
    // Not every voxel needs its point: a search in parts of voxels finds little and takes time.
    options.extra_levels = 0;
    options.threads = options_.threads;
    const SphereProgress part = [&](const char*, double) { return !*progress_ || (*progress_)("medial points", 0); };
    Result<std::vector<Ball>> balls = find_medial_balls(solid_, options, extractor_, part);
    if (!balls) return balls.error();
    candidates_.add(balls.value());
    ++levels_;
    return {};
  }

  /// The smaller gains become, the finer the lattice, once there are some balls.
  void divide_coverage() {
    const double of_ball = balls_.size() < kMany ? kPointsOfBall : kPointsOfOneOfMany;
    const double points = std::max(kLeastPoints, of_ball * static_cast<double>(balls_.size()));
    coverage_.divide(points / balls_.volume(), all_balls());
    candidates_.forget_estimates();
  }

  /// Where many balls are equally good, as in a plate that is wide for its thickness, distance decides.
  Result<std::optional<Candidates::Choice>> choose() {
    std::optional<Ball> ball;
    if (balls_.size() > 0) {
      // Neither task changes anything that the other reads.
      pool_.run(2, 1, [&](std::size_t task) {
        if (task == 0) candidates_.find_promising(coverage_);
        if (task == 1) ball = ball_in_widest_gap(solid_, gaps_);
      });
    }
    Result<std::optional<Candidates::Choice>> best = candidates_.take_best(balls_);
    if (best && !best.value() && balls_.size() == 0) return first_from_boundary();
    if (!best || balls_.size() == 0) return best;
    if (!ball) return best;
    const Result<double> gain = balls_.gain(*ball);
    if (!gain) return gain.error();
    const std::size_t n = balls_.size();
    const bool is_due = n >= kFirstGap && n % kGapPeriod == 0;
    const double least = !best.value() || is_due ? 0 : kAsGood * best.value()->gain;
    if (gain.value() <= least) return best;
    if (best.value()) candidates_.add({&best.value()->ball, 1});
    return std::optional<Candidates::Choice>({*ball, gain.value()});
  }

  /// If there are no medial points: that of a ball is its centre, and easily missed.
  Result<std::optional<Candidates::Choice>> first_from_boundary() {
    const std::optional<Ball> ball = largest_at_samples(solid_, gaps_);
    if (!ball) return std::optional<Candidates::Choice>();
    const Result<double> gain = balls_.gain(*ball);
    if (!gain) return gain.error();
    return std::optional<Candidates::Choice>({*ball, gain.value()});
  }

  Status place(const Candidates::Choice& choice) {
    // Medial points are within epsilon of a sheet; the maximal ball, which contains the other, touches on both sides.
    const Ball maximal = maximal_ball(solid_, choice.ball.centre);
    const bool is_larger = maximal.radius > choice.ball.radius && stays_inside(solid_, maximal);
    const Ball ball = is_larger ? maximal : choice.ball;
    const Result<std::uint32_t> slot = balls_.add(ball);
    if (!slot) return slot.error();
    moves_->came(balls_, slot.value());
    if (coverage_.cell() > 0) coverage_.add(ball);
    const std::vector<std::uint32_t> around(balls_.changed().begin(), balls_.changed().end());
    note_change();
    const State before = {balls_in(around), balls_.volume()};
    steps_.resize(balls_.slots());
    steps_[slot.value()] = kFirstStep * ball.radius;
    if (Status status = slide(slot.value(), around, choice.gain); !status.ok()) return status;
    if (Status status = end_slides(around, before); !status.ok()) return status;
    history_.add(around, before.balls, balls_in(around));
    // The uncovered volume between a ball and its neighbours lies around their common points.
    candidates_.add(balls_at_vertices(solid_, gaps_, around, pool_));
    return {};
  }

  /// The new ball first, then all whose cells it has altered.
  Status slide(std::uint32_t slot, std::span<const std::uint32_t> around, double gain_of_ball) {
    for (int i = 0; i < kOwnSlides; ++i) {
      if (const Result<double> gain = move(slot); !gain.ok()) return gain.error();
    }
    for (const std::uint32_t p : around) steps_[p] = std::max(steps_[p], kLeastFirstStep * balls_.ball(p).radius);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      double sum = 0;
      for (const std::uint32_t p : around) {
        const Result<double> gain = move(p);
        if (!gain.ok()) return gain.error();
        sum += gain.value();
      }
      if (sum <= kEnough * gain_of_ball) break;
    }
    return {};
  }

  /// Before balls slide.
  struct State {
    std::vector<Ball> balls;  // of the slots in question
    double volume;            // of the union
  };

  /// The gains of slides are estimates: if the union has become smaller, none of them is made.
  Status end_slides(std::span<const std::uint32_t> around, const State& before) {
    if (Status status = settle(); !status.ok()) return status;
    if (options_.contract != SphereContract::kBalanced && balls_.volume() < before.volume) {
      for (std::size_t k = 0; k < around.size(); ++k) {
        if (Status status = balls_.shift(around[k], before.balls[k]); !status.ok()) return status;
        steps_[around[k]] /= 2;
      }
      return settle();
    }
    for (std::size_t k = 0; k < around.size(); ++k) cover_anew(before.balls[k], balls_.ball(around[k]));
    return {};
  }

  /// A ball has become another one.
  void cover_anew(const Ball& from, const Ball& to) {
    if (coverage_.cell() == 0 || (from.centre == to.centre && from.radius == to.radius)) return;
    coverage_.replace(from, to);
  }

  Status settle() {
    if (Status status = balls_.settle(); !status.ok()) return status;
    note_change();
    return {};
  }

  /// One step of one ball; returns the gain.
  Result<double> move(std::uint32_t slot) { return moves_->take(balls_, slot, steps_[slot]); }

  void note_change() {
    for (const std::uint32_t slot : balls_.changed()) gaps_.forget(slot);
  }

  std::vector<Ball> all_balls() const {
    std::vector<Ball> all;
    for (std::uint32_t slot = 0; slot < balls_.slots(); ++slot) all.push_back(balls_.ball(slot));
    return all;
  }
  const NearBoundary* bound() const { return options_.max_distance > 0 ? &near_boundary_ : nullptr; }

  /// The present balls, or those that remain of them if there is a bound of the distance. The search does not go on
  /// from these, so that its state does not depend on when they are needed.
  const std::vector<Ball>& bounded_balls() {
    if (bounded_of_ == balls_.size()) return bounded_;
    bounded_of_ = balls_.size();
    bounded_ = all_balls();
    if (bound() == nullptr) return bounded_;
    bounded_ = NearBoundary(near_boundary_).keep(bounded_, {options_.threads, goes_on()});
    bounded_.erase(std::remove_if(bounded_.begin(), bounded_.end(), [](const Ball& ball) { return ball.radius <= 0; }),
                   bounded_.end());
    return bounded_;
  }

  /// Whenever the number of balls has grown by a sixteenth, they are replaced by those that keep the bound, so that
  /// further balls fill what has been left. A ball of which nothing remains stays as a point.
  Status keep_bound_if_due() {
    constexpr std::size_t kFirst = 8, kShare = 16;
    if (bound() == nullptr || balls_.size() < std::max(kFirst, kept_of_ + kept_of_ / kShare + 1)) return {};
    kept_of_ = balls_.size();
    const std::vector<Ball> kept = near_boundary_.keep(all_balls(), {options_.threads, goes_on()});
    std::vector<Ball> shrunk;
    for (std::uint32_t slot = 0; slot < balls_.slots(); ++slot) {
      const Ball before = balls_.ball(slot), after = {before.centre, std::max(kept[slot].radius, solid_.rounding())};
      if (after.radius >= before.radius) continue;
      if (Status status = moves_->replace(balls_, slot, after); !status.ok()) return status;
      cover_anew(before, after);
      shrunk.push_back(before);
    }
    if (!shrunk.empty()) candidates_.note_shrunk(shrunk);
    return settle();
  }
  std::vector<Ball> balls_in(std::span<const std::uint32_t> slots) const {
    std::vector<Ball> balls;
    balls.reserve(slots.size());
    for (const std::uint32_t slot : slots) balls.push_back(balls_.ball(slot));
    return balls;
  }

  Result<SphereSet> result() {
    SphereSet set = {bounded_balls(), volumes_, stages_};
    if (options_.contract == SphereContract::kInside) set.stages[cover_top(balls_.size())] = set.balls;
    if (Status status = order_by_share(set.balls, options_.threads); !status.ok()) return status.error();
    return set;
  }

  const Solid& solid_;
  const SphereFitOptions& options_;
  const Extractor& extractor_;
  DynamicUnion balls_;
  Candidates candidates_;
  Coverage coverage_;  // by the balls of the union
  WorkerPool pool_;
  NearBoundary near_boundary_;  // of options_.max_distance, if that is given
  std::unique_ptr<BallSteps> moves_;
  GapFinder gaps_;
  FitGoals goals_;
  const SphereProgress* progress_ = nullptr;  // of the present call
  std::size_t levels_ = 0;
  bool ends_ = false;            // no more balls are found
  double shown_ = 0;             // reported share of the work
  std::vector<double> volumes_;  // after each ball
  std::map<std::size_t, std::vector<Ball>> stages_;
  std::size_t kept_of_ = 0;    // number of balls when they last were made to keep the bound
  std::vector<Ball> bounded_;  // bounded_balls() of so many balls:
  std::size_t bounded_of_ = 0;
  std::vector<double> steps_;  // by slot
  BallHistory history_;
};

Result<DynamicUnion> union_for(std::size_t most, const Solid& solid, unsigned threads) {
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshReport& report = solid.mesh().report;
    largest = std::max({largest, std::fabs(report.lower[k]), std::fabs(report.upper[k])});
  }
  // Coordinates and radii of balls in the box are within twice its own.
  return DynamicUnion::build(static_cast<std::uint32_t>(most), 2 * largest, threads);
}

}  // namespace

Result<SphereSet> best_spheres(const Solid& solid, const SphereFitOptions& options, const Extractor& extractor,
                               const SphereProgress& progress) {
  const std::size_t most = options.count > 0 ? options.count : kMostBalls;
  Result<DynamicUnion> balls = union_for(most, solid, options.threads);
  if (!balls) return balls.error();
  return Placing(solid, options, extractor, std::move(balls).value()).run(progress);
}

Result<std::unique_ptr<GrowingBalls>> grow_inside(const Solid& solid, const SphereFitOptions& options,
                                                  const Extractor& extractor) {
  Result<DynamicUnion> balls = union_for(options.count, solid, options.threads);
  if (!balls) return balls.error();
  return std::unique_ptr<GrowingBalls>(std::make_unique<Placing>(solid, options, extractor, std::move(balls).value()));
}

}  // namespace medial_vk
