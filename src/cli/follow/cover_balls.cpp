#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/follow/frame_depths.h"
#include "cli/follow/moving_balls.h"
#include "medial_vk/cover_follower.h"
#include "medial_vk/sphere_proofs.h"
#include "reference_bridge/check_balls.h"

namespace medial_vk::cli {
namespace {

std::string place(const Point& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]); }

/// The file of the balls, if they come from one, before what is said about them.
Error in_words_of_file(const Error& error, const FollowOptions& options) {
  if (options.balls.empty() || error.code != ErrorCode::kUsage) return error;
  return {error.code, fmt::format("--balls {}: {} (balls count from 0)", options.balls, error.message)};
}

/// Why balls of a file do not cover the mesh at rest, or an empty text. Of an open mesh only the surface is asked for.
std::string what_is_not_covered(const CoverProof& proof) {
  if (!proof.surface_proved()) {
    if (proof.uncovered == 0) {
      return fmt::format(
          "the cover of {} of {} triangles is too close to be proved, that of the first at {}; larger "
          "radii, by the rounding of the file, help",
          proof.undecided, proof.triangles, place(proof.first_uncovered));
    }
    return fmt::format("{} of {} triangles are not covered by them, the first at {}", proof.uncovered, proof.triangles,
                       place(proof.first_uncovered));
  }
  if (!proof.closed || proof.inside == 0) return {};
  return fmt::format("they leave a cavity in the solid, at {}", place(proof.first_inside));
}

class CoverBalls final : public MovingBalls {
 public:
  CoverBalls(CoverFollower follower, const FollowOptions& options) : follower_(std::move(follower)), options_(options) {
    for (const Ball& ball : follower_.balls()) rest_radii_.push_back(ball.radius);
  }

  Status update(std::span<const Point> vertices) override {
    if (Status status = follower_.update(vertices); !status) return status;
    return options_.tighten ? follower_.tighten() : Status();
  }

  Status describe(FollowedFrame& frame) const override {
    frame.balls.assign(follower_.balls().begin(), follower_.balls().end());
    CoveredFrame& cover = frame.cover.emplace();
    cover.proved = follower_.state();
    for (std::size_t i = 0; i < rest_radii_.size(); ++i) {
      const double radius = frame.balls[i].radius;
      cover.states.push_back(radius == 0                                ? CoverBallState::kUnused
                             : radius > options_.grown * rest_radii_[i] ? CoverBallState::kGrown
                                                                        : CoverBallState::kSteady);
    }
    const Result<CoverFollowMeasures> measures = follower_.measure();
    if (!measures) return measures.error();
    cover.measures = measures.value();
    return {};
  }

  /// A ball with its centre at a depth h in the solid reaches out by at most its radius less h, and one with its centre
  /// outside, where h is minus the distance, likewise.
  Status measure_distances(std::span<const Point> vertices, IndexedMesh& mesh, FollowedFrame& frame) const override {
    if (!mesh.prepared().report.closed) return {};
    std::vector<Point> centres;
    for (const Ball& ball : frame.balls) centres.push_back(ball.centre);
    std::vector<double> depths(centres.size());
    if (Status status = depths_in_frame(vertices, centres, options_.follower.threads, mesh, depths); !status) {
      return status;
    }
    double greatest = 0;
    for (std::size_t i = 0; i < depths.size(); ++i) {
      if (frame.balls[i].radius > 0) greatest = std::max(greatest, frame.balls[i].radius - depths[i]);
    }
    frame.cover->reach_out_bound = greatest;
    return {};
  }

  /// How far they reach out is what a cover has in its place.
  Status estimate_outside(std::span<const Point>, IndexedMesh&, FollowedFrame&) const override { return {}; }

  CheckReport check(const PreparedMesh& frame, std::span<const Ball> balls) const override {
    return check_balls_cover(frame, balls);
  }

 private:
  CoverFollower follower_;
  const FollowOptions& options_;
  std::vector<double> rest_radii_;
};

}  // namespace

Result<std::unique_ptr<MovingBalls>> balls_that_stay_a_cover(const FollowOptions& options, const IndexedMesh& mesh,
                                                             std::span<const Ball> balls) {
  if (!options.balls.empty()) {
    const Result<SphereProofs> proofs = prove_spheres(mesh, {}, balls, {options.follower.threads});
    if (!proofs) return in_words_of_file(proofs.error(), options);
    if (const std::string why = what_is_not_covered(proofs.value().cover); !why.empty()) {
      return Error{ErrorCode::kUsage,
                   fmt::format("--balls {}: the balls do not cover {}: {}", options.balls, options.rest, why)};
    }
  }
  CoverFollowerOptions cover;
  cover.steps = options.follower.steps;
  cover.threads = options.follower.threads;
  Result<CoverFollower> follower = CoverFollower::create(mesh, balls, cover);
  if (!follower) return in_words_of_file(follower.error(), options);
  if (options.tighten) {
    if (Status status = follower.value().tighten(); !status) return status.error();
  }
  return std::unique_ptr<MovingBalls>(std::make_unique<CoverBalls>(std::move(follower).value(), options));
}

}  // namespace medial_vk::cli
