// How far a surface is from the balls inside it, region by region (docs/theory.md, "Balls chosen anew").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "following/surface/moving_surface.h"
#include "following/surface/surface_point.h"
#include "medial_vk/ball.h"
#include "sphere_fits/quality/nearest_ball_tree.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// Points spread over a surface by its area in the rest pose, which move with it, in regions of compact parts of the
/// surface. The volume between a region and the balls is estimated as the sum over its points of their areas times
/// their distances from the balls. A frame allocates nothing.
class GapSamples {
 public:
  /// Of the points that a surface has, if it has so many triangles or more. Coarser ones may have a few less.
  static constexpr std::size_t kPoints = 2048;
  static constexpr std::size_t kPointsOfRegion = 32;

  /// The balls are those of the rest pose, their number that of all later ones. Throws std::bad_alloc.
  GapSamples(const MovingSurface& surface, std::span<const Ball> balls);

  std::size_t regions() const { return first_.size() - 1; }
  std::uint32_t region_of(std::uint32_t triangle) const { return region_of_triangle_[triangle]; }
  std::span<const SurfacePoint> points() const { return points_; }

  /// Upper bounds of the estimates of all regions in the present frame: by one ball for each point, the last that
  /// tighten() found.
  void bound(const MovingSurface& surface, std::span<const Ball> balls, WorkerPool& pool);
  /// The estimate itself, after bound() with the same balls. `prepare` once before it.
  void prepare(std::span<const Ball> balls);
  void tighten(const MovingSurface& surface, std::uint32_t region);
  /// What the last of these calls found. Balls of radius 0 hold nothing; without others, points are one longest side
  /// away.
  double volume(std::uint32_t region) const { return volumes_[region]; }

  /// The balls that tighten() has found so far are those of later return_to_rest().
  void keep_for_rest() { rest_nearest_ = nearest_; }
  void return_to_rest() { nearest_ = rest_nearest_; }

 private:
  void divide(const MovingSurface& surface, std::span<std::uint32_t> triangles, std::size_t count, bool in_region);
  void add_points(const MovingSurface& surface, std::span<const std::uint32_t> triangles, std::size_t count);
  double distance_from(const Point& at, std::uint32_t ball, std::span<const Ball> balls, double otherwise) const;
  double area(const MovingSurface& surface, std::size_t point) const;
  void sum(std::uint32_t region);

  std::vector<std::uint32_t> region_of_triangle_;
  std::vector<std::uint32_t> first_;  // by region, and one more: its first point
  // By point.
  std::vector<SurfacePoint> points_;
  std::vector<double> shares_;  // its area, over that of its triangle
  std::vector<std::uint32_t> nearest_, rest_nearest_;
  std::vector<double> gaps_;  // area times distance
  std::vector<double> volumes_;
  // Of prepare(): the balls that are not lost.
  NearestBallTree tree_;
  std::vector<Ball> present_;
  std::vector<std::uint32_t> ball_of_;
};

}  // namespace medial_vk
