// Balls that move with their parts of a surface.
#pragma once

#include <span>
#include <vector>

#include "cover_following/patches.h"
#include "following/moving_surface.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// Balls whose patches were made in the present frame of a surface, prepared for later frames.
class CarriedBalls {
 public:
  /// Throws std::bad_alloc.
  CarriedBalls(const MovingSurface& surface, Patches patches, std::span<const Ball> balls);

  std::size_t size() const { return centres_.size(); }
  bool has_patches(std::size_t ball) const { return !patches_.of(ball).empty(); }
  /// In the present frame of the surface: a ball that holds all its patches, in exact arithmetic. Without patches: of
  /// radius 0, at the last centre.
  Ball ball(const MovingSurface& surface, std::size_t i) const;

 private:
  void prepare(const MovingSurface& surface, std::size_t i, double radius);
  Point carried(const MovingSurface& surface, std::size_t i) const;

  Patches patches_;
  std::vector<Point> centres_;
  // The centre is the mean of all corners, plus these shares of their differences from it and of the inward normals.
  std::vector<double> mean_shares_, shares_;  // by corner
  std::vector<double> normal_shares_;         // by patch
};

/// At `centre`, a ball that holds points computed by point_of() from coordinates of at most `greatest`, the farthest of
/// which is computed to be at `distance`.
Ball ball_around_points(const Point& centre, double distance, double greatest);

}  // namespace medial_vk
