#include "medial_vk/cover_follower.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ball_unions/unions/union_measurer.h"
#include "base/host_memory.h"
#include "base/parallel.h"
#include "cover_following/carried_balls.h"
#include "cover_following/cavities.h"
#include "cover_following/patches.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/ball_union.h"
#include "threads/worker_pool.h"

namespace medial_vk {
namespace {

constexpr std::size_t kAtOnce = 16;  // balls that one thread takes at a time
/// By which a ball moves in its first step, as a share of its radius.
constexpr double kFirstReach = 0.1;

Status check_balls(std::span<const Ball> balls) {
  constexpr double kMost = MovingSurface::kGreatestCoordinate;
  constexpr std::size_t kMostBalls = 1u << 24;
  const auto usage = [](const std::string& message) { return Error{ErrorCode::kUsage, message}; };
  if (balls.size() > kMostBalls) return usage("more than 2^24 balls cannot follow a mesh");
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Ball& ball = balls[i];
    const bool is_in_range = std::ranges::all_of(ball.centre, [](double x) { return std::fabs(x) <= 2 * kMost; });
    if (is_in_range && ball.radius >= 0 && ball.radius <= 2 * kMost) continue;
    return usage("ball " + std::to_string(i) + " has a number that is out of range");
  }
  if (std::ranges::any_of(balls, [](const Ball& ball) { return ball.radius > 0; })) return {};
  return usage("there is no ball to cover the mesh");
}

}  // namespace

class CoverFollower::Impl {
 public:
  static Result<std::unique_ptr<Impl>> create(const IndexedMesh& rest, std::span<const Ball> balls,
                                              const CoverFollowerOptions& options) {
    Result<MovingSurface> surface = MovingSurface::build(rest, MovingSurface::Sides::kUnneeded);
    if (!surface) return surface.error();
    const std::size_t blocks = std::max<std::size_t>(1, (balls.size() + kAtOnce - 1) / kAtOnce);
    const auto threads = static_cast<unsigned>(std::min<std::size_t>(thread_count(options.threads), blocks));
    std::unique_ptr<Impl> impl(new Impl(std::move(surface).value(), options, threads));
    impl->rest_ = impl->carried_ = impl->divided(balls);
    impl->balls_.resize(balls.size());
    impl->present_.resize(balls.size());
    impl->next_.resize(balls.size());
    if (Status status = impl->follow(); !status) return status.error();
    return impl;
  }

  Status update(std::span<const Point> vertices) {
    if (Status status = surface_.move(vertices, options_.threads); !status) return status;
    return follow();
  }

  Status reset() {
    if (Status status = surface_.return_to_rest(options_.threads); !status) return status;
    carried_ = rest_;
    return follow();
  }

  /// Balls that a division leaves with less to hold shrink, which changes where the next division is.
  Status tighten() {
    constexpr int kRounds = 4;
    constexpr std::uint32_t kSteps = 4;
    Result<double> volume = volume_of(balls_);
    if (!volume) return volume.error();
    Cover best = {carried_, balls_, state_, volume.value()};
    if (Status status = prefer_rest(best); !status) return status;
    for (int round = 0; round < kRounds; ++round) {
      Result<Cover> next = tightened(best.balls, std::max(options_.steps, kSteps));
      if (!next) return next.error();
      const bool holds_less = best.state == CoverState::kSolid && next.value().state != CoverState::kSolid;
      if (!(next.value().volume < best.volume) || holds_less) break;
      best = std::move(next).value();
    }
    std::ranges::copy(best.balls, balls_.begin());
    carried_ = std::move(best.carried);
    state_ = best.state;
    return {};
  }

  std::span<const Ball> balls() const { return balls_; }
  CoverState state() const { return state_; }

  Result<CoverFollowMeasures> measure() const {
    Result<double> volume = volume_of(balls_);
    if (!volume) return volume.error();
    // Where only the surface is covered, the solid may be larger than the balls.
    const double most = state_ == CoverState::kSolid ? volume.value() : std::numeric_limits<double>::infinity();
    return CoverFollowMeasures{surface_.solid_volume(0, most), volume.value()};
  }

 private:
  struct Cover {
    std::shared_ptr<const CarriedBalls> carried;
    std::vector<Ball> balls;
    CoverState state;
    double volume;  // of the union
  };

  Impl(MovingSurface surface, const CoverFollowerOptions& options, unsigned threads)
      : surface_(std::move(surface)), options_(options), pool_(threads), memory_(pool_.threads()) {}

  Result<double> volume_of(std::span<const Ball> balls) const {
    Result<BallUnion> measured = measure_ball_union(balls, BallUnionOptions{options_.threads});
    if (!measured) return measured.error();
    return measured.value().volume;
  }

  /// The boundary of the present frame, divided among these balls.
  std::shared_ptr<const CarriedBalls> divided(std::span<const Ball> balls) const {
    return std::make_shared<const CarriedBalls>(
        surface_, divide_boundary(surface_.vertices(), surface_.triangles(), balls, options_.threads), balls);
  }

  /// Steps of all balls at once towards a smaller volume; shorter ones after one that has not led there.
  Status shrink(const CarriedBalls& carried, std::uint32_t steps, std::vector<Ball>& balls) {
    if (steps == 0) return {};
    UnionMeasurer *present = &measurers_[0], *other = &measurers_[1];
    if (Status status = present->measure(balls, false, pool_); !status) return status;
    double share = kFirstReach;
    for (std::uint32_t step = 0; step < steps; ++step) {
      const BallUnion& exposed = present->result();
      pool_.run(balls.size(), kAtOnce, [&](std::size_t i, unsigned worker) {
        next_[i] = carried.shifted(surface_, i, balls[i], exposed.areas[i], exposed.vectors[i], share * balls[i].radius,
                                   memory_[worker]);
      });
      if (Status status = other->measure(next_, false, pool_); !status) return status;
      if (other->result().volume < exposed.volume) {
        std::ranges::copy(next_, balls.begin());
        std::swap(present, other);
      } else {
        share *= 0.5;
      }
    }
    return {};
  }

  /// The cover of the present frame by the division at rest replaces one that is larger, or is not proved to hold the
  /// solid where that one is. A division of a frame without volume, or of one where parts cross, leaves most of the
  /// surface to a few balls, and nothing to the others, to which no later division of the same balls gives anything.
  Status prefer_rest(Cover& cover) {
    if (cover.carried == rest_) return {};
    std::vector<Ball> balls = cover.balls;
    if (Status status = place(*rest_, options_.steps, balls); !status) return status;
    Result<double> volume = volume_of(balls);
    if (!volume) return volume.error();
    // Balls that fill cavities only grow.
    if (cover.state == CoverState::kSolid && !(volume.value() < cover.volume)) return {};
    const Result<CoverState> state = hold(balls);
    if (!state) return state.error();
    volume = volume_of(balls);
    if (!volume) return volume.error();
    const bool is_smaller = volume.value() < cover.volume;
    if (state.value() == cover.state ? is_smaller : state.value() == CoverState::kSolid) {
      cover = {rest_, std::move(balls), state.value(), volume.value()};
    }
    return {};
  }

  /// The boundary of the present frame, divided anew. Later frames begin where the steps have ended.
  Result<Cover> tightened(std::vector<Ball> balls, std::uint32_t steps) {
    std::shared_ptr<const CarriedBalls> carried = divided(balls);
    if (Status status = place(*carried, steps, balls); !status) return status.error();
    carried = std::make_shared<const CarriedBalls>(surface_, carried->patches(), balls);
    const Result<CoverState> state = hold(balls);
    if (!state) return state.error();
    const Result<double> volume = volume_of(balls);
    if (!volume) return volume.error();
    return Cover{std::move(carried), std::move(balls), state.value(), volume.value()};
  }

  /// The balls of the present frame, which hold its triangles, replace `balls`.
  Status place(const CarriedBalls& carried, std::uint32_t steps, std::vector<Ball>& balls) {
    // Which thread takes which balls is not the same in each frame.
    for (HeldCorners& memory : memory_) memory.points.reserve(carried.most_corners());
    pool_.run(carried.size(), kAtOnce,
              [&](std::size_t i, unsigned worker) { balls[i] = carried.ball(surface_, i, memory_[worker]); });
    return shrink(carried, steps, balls);
  }

  /// Fills cavities. What all balls are then proved to hold.
  Result<CoverState> hold(std::vector<Ball>& balls) {
    if (options_.surface_only || !surface_.is_closed() || !has_usual_size(balls)) return CoverState::kSurface;
    const Result<bool> filled = cavities_.fill(surface_, balls, pool_);
    if (!filled) return filled.error();
    return filled.value() ? CoverState::kSolid : CoverState::kSurface;
  }

  /// Products of six lengths, which the vertices of the envelope take, keep their digits.
  bool has_usual_size(std::span<const Ball> balls) const {
    constexpr double kMost = 1e18, kLeast = 1e-18;
    return surface_.longest_side() >= kLeast && std::ranges::all_of(balls, [](const Ball& ball) {
             return ball.radius <= kMost &&
                    std::ranges::all_of(ball.centre, [](double x) { return std::fabs(x) <= kMost; });
           });
  }

  Status follow() {
    if (Status status = place(*carried_, options_.steps, present_); !status) return status.error();
    const Result<CoverState> state = hold(present_);
    if (!state) return state.error();
    std::ranges::copy(present_, balls_.begin());
    state_ = state.value();
    return {};
  }

  MovingSurface surface_;
  CoverFollowerOptions options_;
  WorkerPool pool_;                  // of loops over balls, which come several times a frame
  std::vector<HeldCorners> memory_;  // by worker
  UnionMeasurer measurers_[2];       // of the present balls, and of those of the next step
  CavitySearch cavities_;
  std::vector<Ball> present_, next_;
  std::shared_ptr<const CarriedBalls> rest_, carried_;  // of the rest pose; of the frame of the last tighten()
  std::vector<Ball> balls_;
  CoverState state_ = CoverState::kSurface;
};

CoverFollower::CoverFollower(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CoverFollower::CoverFollower(CoverFollower&&) noexcept = default;
CoverFollower& CoverFollower::operator=(CoverFollower&&) noexcept = default;
CoverFollower::~CoverFollower() = default;

Result<CoverFollower> CoverFollower::create(const IndexedMesh& rest, std::span<const Ball> balls,
                                            const CoverFollowerOptions& options) {
  if (Status status = check_balls(balls); !status) return status.error();
  return catch_out_of_memory("preparing a cover to follow a mesh", [&]() -> Result<CoverFollower> {
    Result<std::unique_ptr<Impl>> impl = Impl::create(rest, balls, options);
    if (!impl) return impl.error();
    return CoverFollower(std::move(impl).value());
  });
}

Status CoverFollower::update(std::span<const Point> vertices) {
  return catch_out_of_memory("moving a cover with a mesh", [&] { return impl_->update(vertices); });
}

Status CoverFollower::reset() {
  return catch_out_of_memory("returning a cover to the rest pose", [&] { return impl_->reset(); });
}

Status CoverFollower::tighten() {
  return catch_out_of_memory("dividing a surface among balls", [&] { return impl_->tighten(); });
}

std::span<const Ball> CoverFollower::balls() const { return impl_->balls(); }
CoverState CoverFollower::state() const { return impl_->state(); }

Result<CoverFollowMeasures> CoverFollower::measure() const {
  return catch_out_of_memory("measuring a cover that follows a mesh", [&] { return impl_->measure(); });
}

}  // namespace medial_vk
