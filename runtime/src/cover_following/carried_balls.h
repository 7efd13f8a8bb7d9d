// Balls that move with their parts of a surface.
#pragma once

#include <span>
#include <vector>

#include "cover_following/patches.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/ball.h"

namespace medial_vk {

/// The corners of a ball's patches in a frame.
struct HeldCorners {
  std::vector<Point> points;
  double room = 0;  ///< To add to a radius.

  const Point& farthest(const Point& from) const;
  Ball around(const Point& centre) const;
};

/// Balls whose patches were made in the present frame of a surface, prepared for later frames.
class CarriedBalls {
 public:
  /// Throws std::bad_alloc.
  CarriedBalls(const MovingSurface& surface, Patches patches, std::span<const Ball> balls);

  std::size_t size() const { return centres_.size(); }
  const Patches& patches() const { return patches_; }
  bool has_patches(std::size_t ball) const { return !patches_.of(ball).empty(); }
  /// Of a ball.
  std::size_t most_corners() const { return most_corners_; }
  /// In the present frame of the surface: a ball that holds all its patches, in exact arithmetic. Without patches: of
  /// radius 0, at the last centre. `memory` is of the calling thread alone, and used again from call to call.
  Ball ball(const MovingSurface& surface, std::size_t i, HeldCorners& memory) const;
  /// The same at another centre, at most `reach` away, at which the union has a smaller volume to first order: where
  /// the least of `area` times the radius, plus the product of `vector` and the centre, is found in a few steps. `area`
  /// and `vector`: of `ball` on the envelope, as those of BallUnion.
  Ball shifted(const MovingSurface& surface, std::size_t i, const Ball& ball, double area, const Point& vector,
               double reach, HeldCorners& memory) const;

 private:
  void prepare(const MovingSurface& surface, std::size_t i, double radius);
  Point carried(const MovingSurface& surface, std::size_t i) const;
  void hold(const MovingSurface& surface, std::size_t i, HeldCorners& held) const;

  Patches patches_;
  std::vector<Point> centres_;
  std::size_t most_corners_ = 0;
  // The centre is the mean of all corners, plus these shares of their differences from it and of the inward normals.
  std::vector<double> mean_shares_, shares_;  // by corner
  std::vector<double> normal_shares_;         // by patch
};

}  // namespace medial_vk
