#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/follow/frame_depths.h"
#include "cli/follow/moving_balls.h"
#include "medial_vk/sphere_proofs.h"
#include "outside_samples/outside_samples.h"
#include "reference_bridge/check_balls.h"

namespace medial_vk::cli {
namespace {

class InsideBalls final : public MovingBalls {
 public:
  InsideBalls(Follower follower, const FollowOptions& options, double rest_side)
      : follower_(std::move(follower)), options_(options), protrusion_(options.follower.protrusion * rest_side) {}

  Status update(std::span<const Point> vertices) override {
    if (options_.from_rest) {
      if (Status status = follower_.reset(); !status) return status;
    }
    return follower_.update(vertices);
  }

  Status describe(FollowedFrame& frame) const override {
    frame.balls.assign(follower_.balls().begin(), follower_.balls().end());
    frame.states.assign(follower_.states().begin(), follower_.states().end());
    const Result<FollowMeasures> measures = follower_.measure();
    if (!measures) return measures.error();
    frame.measures = measures.value();
    if (options_.follower.renewed > 0) frame.origins.assign(follower_.origins().begin(), follower_.origins().end());
    return {};
  }

  Status measure_distances(std::span<const Point> vertices, IndexedMesh& mesh, FollowedFrame& frame) const override {
    if (std::ranges::none_of(frame.balls, [](const Ball& ball) { return ball.radius > 0; })) return {};
    const unsigned threads = options_.follower.threads;
    if (Status status = mesh.move_vertices(vertices, {.flags = {}, .threads = threads}); !status) return status;
    const Result<Bounds> gap = measure_gap(mesh, frame.balls, {threads});
    if (!gap) return gap.error();
    frame.gap = gap.value();
    return {};
  }

  Status estimate_outside(std::span<const Point> vertices, IndexedMesh& mesh, FollowedFrame& frame) const override {
    constexpr std::size_t kSamples = 100'000;
    if (options_.follower.rule != FollowRule::kPublished || !mesh.prepared().report.closed) return {};
    const OutsideSamples samples(frame.balls, protrusion_, kSamples);
    std::vector<double> depths(samples.points().size());
    if (Status status = depths_in_frame(vertices, samples.points(), options_.follower.threads, mesh, depths); !status) {
      return status;
    }
    frame.outside = samples.estimate(depths);
    return {};
  }

  CheckReport check(const PreparedMesh& frame, std::span<const Ball> balls) const override {
    return check_balls_inside(frame, balls);
  }

 private:
  Follower follower_;
  const FollowOptions& options_;
  double protrusion_;  // in mesh units
};

}  // namespace

Result<std::unique_ptr<MovingBalls>> balls_that_stay_inside(const FollowOptions& options, const IndexedMesh& mesh,
                                                            std::span<const Ball> balls) {
  Result<Follower> follower = Follower::create(mesh, balls, options.follower);
  if (!follower) {
    const Error& error = follower.error();
    if (options.balls.empty() || error.code != ErrorCode::kUsage) return error;
    return Error{error.code,
                 fmt::format("--balls {}: {} (balls count from 0, and faces inside the solid bound it, too)",
                             options.balls, error.message)};
  }
  const auto is_lost = [](FollowState state) { return state == FollowState::kLost; };
  if (std::ranges::all_of(follower.value().states(), is_lost)) {
    return Error{ErrorCode::kInvalidMesh,
                 fmt::format("{}: no ball is known to be inside the open mesh at rest", options.rest)};
  }
  return std::unique_ptr<MovingBalls>(
      std::make_unique<InsideBalls>(std::move(follower).value(), options, mesh.longest_side()));
}

}  // namespace medial_vk::cli
