#include "medial_vk/follower.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "ball_unions/unions/union_measurer.h"
#include "base/host_memory.h"
#include "base/parallel.h"
#include "following/ascent.h"
#include "following/ball_sides.h"
#include "following/given_balls.h"
#include "following/published_rule.h"
#include "following/regional_growth.h"
#include "following/renewal.h"
#include "following/rest_contacts.h"
#include "following/surface/moving_surface.h"
#include "following/tangent_rule.h"
#include "following/tracked_ball.h"
#include "medial_vk/ball_union.h"
#include "threads/worker_pool.h"

namespace medial_vk {
namespace {

constexpr double kAnyVolume = std::numeric_limits<double>::infinity();

constexpr std::size_t kBlock = 16;  // balls that one thread takes at a time

/// A ball that has been drawn to rest differs from that at rest by 1e-10 of the longest side, and so does the volume
/// by some 1e-9 of itself: less than this share of the part that is uncovered, if that is a thousandth or more.
constexpr double kDrawn = 1 + 1e-6;

}  // namespace

class Follower::Impl {
 public:
  static Result<std::unique_ptr<Impl>> create(const IndexedMesh& rest, std::span<const Ball> balls,
                                              const FollowerOptions& options) {
    Result<MovingSurface> surface = MovingSurface::build(rest);
    if (!surface) return surface.error();
    const std::size_t blocks = std::max<std::size_t>(1, (balls.size() + kBlock - 1) / kBlock);
    const auto threads = static_cast<unsigned>(std::min<std::size_t>(thread_count(options.threads), blocks));
    std::unique_ptr<Impl> impl(new Impl(std::move(surface).value(), options, threads));
    if (Status status = impl->take(balls); !status) return status.error();
    return impl;
  }

  Status update(std::span<const Point> vertices) {
    if (Status status = surface_.move(vertices, options_.threads); !status) return status;
    if (Status status = options_.rule == FollowRule::kTangent ? follow_by_both_contacts() : follow_as_published();
        !status) {
      return status;
    }
    report();
    return {};
  }

  Status reset() {
    if (Status status = surface_.return_to_rest(options_.threads); !status) return status;
    std::ranges::copy(rest_, tracked_.begin());
    std::ranges::fill(is_renewed_, std::uint8_t{0});
    std::ranges::fill(came_, FollowOrigin::kFollowed);
    sides_.return_to_rest();
    if (growth_) growth_->return_to_rest();
    report();
    return {};
  }

  std::span<const Ball> balls() const { return balls_; }
  std::span<const FollowState> states() const { return states_; }
  std::span<const FollowOrigin> origins() const { return origins_; }

  Result<FollowMeasures> measure() const {
    FollowMeasures measures;
    Result<BallUnion> balls = measure_ball_union(balls_, BallUnionOptions{options_.threads});
    if (!balls) return balls.error();
    measures.ball_volume = balls.value().volume;
    if (options_.rule == FollowRule::kTangent) {
      measures.solid_volume = surface_.solid_volume(measures.ball_volume, kAnyVolume);
      return measures;
    }
    std::vector<Ball> within = balls_;
    for (Ball& ball : within) ball.radius = std::max(0.0, ball.radius - protrusion());
    Result<BallUnion> inner = measure_ball_union(within, BallUnionOptions{options_.threads});
    if (!inner) return inner.error();
    measures.outside_bound = measures.ball_volume - inner.value().volume;
    measures.solid_volume = surface_.solid_volume(inner.value().volume, kAnyVolume);
    return measures;
  }

 private:
  Impl(MovingSurface surface, const FollowerOptions& options, unsigned threads)
      : surface_(std::move(surface)), options_(options), pool_(threads) {}

  double protrusion() const { return options_.protrusion * surface_.rest_side(); }

  Status take(std::span<const Ball> balls) {
    double error = kGivenError * surface_.rest_side();
    if (options_.rule == FollowRule::kPublished) error = std::min(error, protrusion());
    for (std::size_t i = 0; i < balls.size(); ++i) {
      Result<TrackedBall> tracked = track(surface_, balls[i], i, error);
      if (!tracked) return tracked.error();
      tracked_.push_back(tracked.value());
    }
    balls_.resize(balls.size());
    present_.resize(balls.size());
    states_.resize(balls.size());
    is_inside_.resize(balls.size());
    origins_.resize(balls.size());
    came_.resize(balls.size());
    is_renewed_.resize(balls.size());
    vertex_normals_.resize(surface_.vertices().size());
    if (options_.rule == FollowRule::kTangent) {
      for_each_ball([&](std::size_t i) { tracked_[i] = ball_with_contacts(surface_, balls[i]); });
    }
    for (TrackedBall& tracked : tracked_) tracked.rest_radius = tracked.ball.radius;
    copy_balls(present_);
    Result<BallSides> sides = BallSides::build(present_, options_.threads);
    if (!sides) return sides.error();
    sides_ = std::move(sides).value();
    before_ = tracked_;
    if (options_.steps > 0 || options_.renewed > 0) measurer_.make_room(balls.size(), options_.renewed > 0, pool_);
    // Of an open mesh: balls whose centres are inside may reach through a hole.
    if (options_.rule == FollowRule::kTangent) drop_outside();
    rest_ = tracked_;
    if (options_.renewed > 0) {
      if (Status status = measure_present(false); !status) return status;
      const double volume = solid_volume(measurer_.result());
      rest_share_ = uncovered_share(measurer_.result());
      if (rest_share_ > 0) {
        if (Status status = prepare_renewal(volume); !status) return status;
      }
    }
    report();
    return {};
  }

  Status prepare_renewal(double volume) {
    growth_.emplace(surface_, present_, volume, options_.renewal_factor);
    Result<Renewal> renewal = Renewal::build(surface_, present_, growth_->samples(), options_.renewed);
    if (!renewal) return renewal.error();
    renewal_.emplace(std::move(renewal).value());
    sides_.make_room();
    returned_.reserve(tracked_.size());
    return {};
  }

  template <class Work>
  void for_each_ball(const Work& work) {
    pool_.run(tracked_.size(), kBlock, work);
  }

  Status follow_as_published() {
    find_vertex_normals(surface_, vertex_normals_);
    for_each_ball(
        [&](std::size_t i) { tracked_[i] = follow_published(surface_, vertex_normals_, rest_[i], protrusion()); });
    return {};
  }

  Status follow_by_both_contacts() {
    for_each_ball([&](std::size_t i) { follow(tracked_[i]); });
    drop_outside();
    for (std::uint32_t step = 0; step < options_.steps; ++step) {
      if (Status status = ascend_all(); !status) return status;
    }
    draw_to_rest();
    if (options_.renewed == 0) return {};
    if (growth_) {
      if (Status status = return_renewed(); !status) return status;
    }
    return renew();
  }

  /// The result is that of measurer_, until the next call.
  Status measure_present(bool complex) {
    copy_balls(present_);
    return measurer_.measure(present_, complex, pool_);
  }

  /// Not a number where it is not known.
  double solid_volume(const BallUnion& inside) const { return surface_.solid_volume(inside.volume, kAnyVolume); }
  double uncovered_share(const BallUnion& balls) const { return 1 - balls.volume / solid_volume(balls); }

  /// Where the uncovered volume has grown, balls come from elsewhere. The share before the last step, which measured
  /// it, decides whether a further union is worth its time.
  Status renew() {
    if (!growth_) return {};
    if (options_.steps == 0) {
      if (Status status = measure_present(false); !status) return status;
      note_uncovered();
    }
    const double most = options_.renewal_factor * rest_share_;
    copy_balls(present_);
    const bool has_region = growth_->choose(surface_, present_, solid_volume_, pool_);
    if (!has_region && !(measured_share_ > most)) return {};
    if (Status status = measure_present(true); !status) return status;
    const BallUnion& measured = measurer_.result();
    const bool is_everywhere = uncovered_share(measured) > most;
    if (is_everywhere) growth_->choose_all();
    if (!has_region && !is_everywhere) return {};
    const Result<std::span<const BallExchange>> exchanges =
        renewal_->find(surface_, present_, measured, {growth_->samples(), growth_->chosen()}, pool_);
    if (!exchanges) return exchanges.error();
    for (const BallExchange& exchange : exchanges.value()) take_exchange(exchange);
    if (exchanges.value().size() == options_.renewed) return {};
    copy_balls(present_);
    growth_->tried(surface_, present_, solid_volume_);
    return {};
  }

  void note_uncovered() {
    solid_volume_ = solid_volume(measurer_.result());
    measured_share_ = 1 - measurer_.result().volume / solid_volume_;
  }

  void take_exchange(const BallExchange& exchange) {
    TrackedBall& tracked = tracked_[exchange.ball];
    tracked = exchange.by;
    tracked.rest_radius = tracked.ball.radius;
    is_renewed_[exchange.ball] = 1;
    came_[exchange.ball] = FollowOrigin::kRenewed;
    sides_.renew(exchange.ball, renewal_->others_of(exchange));  // only a hint: memory may run out in it
  }

  /// Where the surface is as in the rest pose at the places that balls have left, all of them return, unless they would
  /// leave again.
  Status return_renewed() {
    returned_.clear();
    for (std::size_t i = 0; i < tracked_.size(); ++i) {
      if (is_renewed_[i] == 0 || !rest_[i].has_two_contacts()) continue;
      const double share = share_of_rest(surface_, rest_[i]);
      if (!(share > 0)) return {};
      TrackedBall now = rest_[i];
      now.ball.radius = 0;
      replace(now, drawn_to_rest(surface_, rest_[i], share, now));
      if (!(now.ball.radius > 0) || !surface_.holds(now.ball)) return {};
      returned_.emplace_back(i, now);
    }
    if (returned_.empty()) return {};
    copy_balls(present_);
    for (const auto& [i, now] : returned_) present_[i] = now.ball;
    if (Status status = measurer_.measure(present_, false, pool_); !status) return status;
    if (uncovered_share(measurer_.result()) > kDrawn * options_.renewal_factor * rest_share_) return {};
    if (growth_->has_grown(surface_, present_, solid_volume(measurer_.result()), pool_)) return {};
    sides_.return_to_rest();
    growth_->return_to_rest();
    for (const auto& [i, now] : returned_) {
      tracked_[i] = now;
      is_renewed_[i] = 0;
      came_[i] = FollowOrigin::kReturned;
    }
    return {};
  }

  void follow(TrackedBall& tracked) {
    if (length(tracked.last_direction) > 0) {
      tracked.last_direction = surface_.carried(tracked.last_direction, tracked.a.on);
    }
    replace(tracked, follow_tangent(surface_, tracked));
  }

  static void replace(TrackedBall& tracked, const TrackedBall& now) {
    tracked.ball = now.ball;
    tracked.a = now.a;
    tracked.b = now.b;
  }

  void draw_to_rest() {
    std::ranges::copy(tracked_, before_.begin());
    for_each_ball([&](std::size_t i) {
      if (is_renewed_[i] != 0) return;
      const double share = share_of_rest(surface_, rest_[i]);
      if (share > 0) replace(tracked_[i], drawn_to_rest(surface_, rest_[i], share, tracked_[i]));
    });
    take_back_outside();
  }

  void copy_balls(std::span<Ball> balls) const { std::ranges::transform(tracked_, balls.begin(), &TrackedBall::ball); }

  /// Balls by the tangent rule do not meet the surface, but may lie on its other side.
  void drop_outside() {
    find_sides();
    for (std::size_t i = 0; i < tracked_.size(); ++i) {
      if (is_inside_[i] != 0) continue;
      tracked_[i].ball.radius = 0;
      replace(tracked_[i], recovered_ball(surface_, tracked_[i]));
    }
  }

  /// Balls that were inside before a further motion in the same frame, and are not now, return.
  void take_back_outside() {
    find_sides();
    for (std::size_t i = 0; i < tracked_.size(); ++i) {
      if (is_inside_[i] == 0) replace(tracked_[i], before_[i]);
    }
  }

  void find_sides() {
    copy_balls(present_);
    sides_.find(surface_, present_, is_inside_);
  }

  /// All balls move at once, by what the union of the present ones exposes.
  Status ascend_all() {
    if (Status status = measure_present(false); !status) return status;
    const BallUnion& exposed = measurer_.result();
    if (options_.renewed > 0) note_uncovered();
    std::ranges::copy(tracked_, before_.begin());
    for_each_ball([&](std::size_t i) { ascend(surface_, {exposed.areas[i], exposed.vectors[i]}, tracked_[i]); });
    take_back_outside();
    return {};
  }

  FollowState state_of(const TrackedBall& tracked) const {
    if (!(tracked.ball.radius > 0)) return FollowState::kLost;
    if (tracked.ball.radius < options_.shrunk * tracked.rest_radius) return FollowState::kShrunk;
    const bool is_flat = tracked.has_two_contacts() && tracked.object_angle() < options_.object_angle;
    return is_flat ? FollowState::kFlat : FollowState::kMedial;
  }

  void report() {
    copy_balls(balls_);
    std::ranges::transform(tracked_, states_.begin(), [&](const TrackedBall& tracked) { return state_of(tracked); });
    std::ranges::copy(came_, origins_.begin());
    std::ranges::fill(came_, FollowOrigin::kFollowed);
  }

  MovingSurface surface_;
  FollowerOptions options_;
  WorkerPool pool_;  // of loops over balls, which come several times a frame
  UnionMeasurer measurer_;
  std::vector<TrackedBall> tracked_, rest_;
  std::vector<TrackedBall> before_;  // the last step of the same frame: inside, or of radius 0
  std::vector<Ball> present_;        // of tracked_, within an update
  BallSides sides_;
  std::vector<Point> vertex_normals_;  // by vertex; of the published rule
  // By ball, in the order in which they were given; of the last frame that was completed.
  std::vector<Ball> balls_;
  std::vector<FollowState> states_;
  std::vector<FollowOrigin> origins_;
  std::vector<std::uint8_t> is_inside_;

  // Of balls that are chosen anew.
  std::vector<FollowOrigin> came_;        // since the last frame that was completed
  std::vector<std::uint8_t> is_renewed_;  // 1: away from its place of the rest pose
  double rest_share_ = 0;                 // of the volume, uncovered in the rest pose
  double measured_share_ = 0;             // of the present frame, before the last step
  double solid_volume_ = 0;               // likewise
  std::optional<RegionalGrowth> growth_;  // if something is uncovered in the rest pose
  std::optional<Renewal> renewal_;        // likewise
  std::vector<std::pair<std::size_t, TrackedBall>> returned_;
};

Follower::Follower(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Follower::Follower(Follower&&) noexcept = default;
Follower& Follower::operator=(Follower&&) noexcept = default;
Follower::~Follower() = default;

Result<Follower> Follower::create(const IndexedMesh& rest, std::span<const Ball> balls,
                                  const FollowerOptions& options) {
  if (Status status = check_options(balls, options, rest.prepared().report.closed); !status) return status.error();
  return catch_out_of_memory("preparing balls to follow a mesh", [&]() -> Result<Follower> {
    Result<std::unique_ptr<Impl>> impl = Impl::create(rest, balls, options);
    if (!impl) return impl.error();
    return Follower(std::move(impl).value());
  });
}

Status Follower::update(std::span<const Point> vertices) {
  return catch_out_of_memory("moving balls with a mesh", [&] { return impl_->update(vertices); });
}

Status Follower::reset() {
  return catch_out_of_memory("returning balls to the rest pose", [&] { return impl_->reset(); });
}

std::span<const Ball> Follower::balls() const { return impl_->balls(); }
std::span<const FollowState> Follower::states() const { return impl_->states(); }
std::span<const FollowOrigin> Follower::origins() const { return impl_->origins(); }

Result<FollowMeasures> Follower::measure() const {
  return catch_out_of_memory("measuring balls that follow a mesh", [&] { return impl_->measure(); });
}

}  // namespace medial_vk
