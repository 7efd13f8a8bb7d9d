// Balls in the single precision of glTF.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// Rounds to a float towards 0.
float shortened(double x);
/// Rounds a positive number up to a float.
float lengthened(double x);

/// The box around centres.
class CentreBox {
 public:
  void add(const Point& centre);
  /// Rounded to floats; the origin if there are no centres.
  Point middle() const;

 private:
  Point lower_ = {0, 0, 0}, upper_ = {0, 0, 0};
  bool is_empty_ = true;
};

/// A ball around `centre` + the middle, inside the ball that it represents.
struct GlbBall {
  std::array<float, 3> centre;
  float radius = 0;
};

GlbBall glb_ball(const Ball& of, const Point& middle);

/// The same ball around the given one, of a cover; of radius 0 if that has radius 0.
GlbBall glb_ball_around(const Ball& of, const Point& middle);

/// Colours are quantised to these steps, so that few materials suffice.
inline constexpr std::uint32_t kColourSteps = 32;

/// The indices of the spheres by colour step, ascending; the object angle determines the step.
std::array<std::vector<std::uint32_t>, kColourSteps> spheres_by_colour(std::span<const MedialSphere> spheres,
                                                                       double least_angle);

/// The middle of the step, in [0, 1].
constexpr float share_of_step(std::uint32_t step) {
  return (static_cast<float>(step) + 0.5f) / static_cast<float>(kColourSteps);
}

}  // namespace medial_vk
