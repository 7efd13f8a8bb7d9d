// Points of a surface that balls must not leave farther away than any of them was.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "following/gap_samples.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/ball.h"
#include "sphere_fits/quality/nearest_ball_tree.h"
#include "threads/worker_pool.h"

namespace medial_vk {

inline SurfacePoint middle_of(std::uint32_t triangle) { return {triangle, 1.0 / 3, 1.0 / 3}; }

struct WatchedPoint {
  Point at = {0, 0, 0};
  double distance = 0;  ///< From the nearest ball at the beginning; without any, one longest side.
  std::uint32_t triangle = 0;
  bool is_middle = false;  ///< Of the triangle.
};

/// Middles of triangles, and the samples of gaps. Of very fine meshes a part of the triangles suffices.
class WatchedPoints {
 public:
  /// Of frames of this surface, with these samples and so many balls. Throws std::bad_alloc.
  WatchedPoints(const MovingSurface& surface, std::size_t balls, const GapSamples& samples);

  /// The beginning, in the present frame. Balls of radius 0 are lost. Allocates nothing.
  void start(const MovingSurface& surface, std::span<const Ball> balls, const GapSamples& samples, WorkerPool& pool);

  std::span<const WatchedPoint> points() const { return points_; }
  /// True if all points would still have a ball as near as the farthest one had at the beginning, without this one.
  bool can_leave(std::uint32_t ball) const;
  /// The ball, which can leave, is now this one.
  void exchange(std::uint32_t ball, const Ball& by);

 private:
  /// The nearest ball but this one; lost balls are nowhere.
  std::uint32_t nearest_but(std::uint32_t ball, const Point& at, double& distance) const;

  std::vector<WatchedPoint> points_;
  std::vector<std::uint32_t> held_by_;  // by point: a ball that is near enough
  std::vector<Ball> balls_;
  double greatest_ = 0;
  std::size_t middles_ = 0, stride_ = 1;
  // Of start(): the balls that are not lost.
  std::vector<Ball> present_;
  std::vector<std::uint32_t> ball_of_;
  NearestBallTree tree_;
};

}  // namespace medial_vk
