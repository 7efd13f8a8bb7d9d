// Balls that move with the mesh, of either contract, and what is known of them in the present frame.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "check_reports/check_report.h"
#include "cli/options/follow_options.h"
#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"
#include "output/motion_files/motion_record.h"

namespace medial_vk::cli {

class MovingBalls {
 public:
  MovingBalls() = default;
  MovingBalls(const MovingBalls&) = delete;
  MovingBalls& operator=(const MovingBalls&) = delete;
  virtual ~MovingBalls() = default;

  /// The vertices of the prepared mesh in a frame. Errors: those of Follower::update() and CoverFollower::update().
  virtual Status update(std::span<const Point> vertices) = 0;
  /// Sets the balls of the present frame, with states and volumes.
  virtual Status describe(FollowedFrame& frame) const = 0;
  /// Sets its distances between surface and balls, where they are known; `mesh` is moved there.
  virtual Status measure_distances(std::span<const Point> vertices, IndexedMesh& mesh, FollowedFrame& frame) const = 0;
  /// Sets what samples say of the balls' volume outside the solid, where they may reach out and the mesh is closed;
  /// `mesh` is moved there.
  virtual Status estimate_outside(std::span<const Point> vertices, IndexedMesh& mesh, FollowedFrame& frame) const = 0;
  /// By the reference: the contract of the balls in a frame.
  virtual CheckReport check(const PreparedMesh& frame, std::span<const Ball> balls) const = 0;
};

/// Balls inside the rest pose. Errors: those of Follower::create(), of which kUsage names the file of the balls;
/// kInvalidMesh if no ball is known to be inside an open mesh.
Result<std::unique_ptr<MovingBalls>> balls_that_stay_inside(const FollowOptions& options, const IndexedMesh& mesh,
                                                            std::span<const Ball> balls);

/// Balls that cover the rest pose: those of a file are proved to. Errors: kUsage, with the file, if they do not; those
/// of prove_spheres() and CoverFollower::create().
Result<std::unique_ptr<MovingBalls>> balls_that_stay_a_cover(const FollowOptions& options, const IndexedMesh& mesh,
                                                             std::span<const Ball> balls);

}  // namespace medial_vk::cli
