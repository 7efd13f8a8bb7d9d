// Balls in the single precision of glTF.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/extraction.h"

namespace medial_vk {

/// As a float towards 0.
float shortened(double x);

/// The middle of the box around all centres, rounded to floats; the origin if there is none.
Point middle_of_centres(std::span<const MedialSphere> spheres);

/// A ball about `centre` + the middle, inside of the ball it was made from.
struct GlbBall {
  std::array<float, 3> centre;
  float radius = 0;
};

GlbBall glb_ball(const MedialSphere& sphere, const Point& middle);

/// Colours are steps of the scale, so that few materials do.
inline constexpr std::uint32_t kColourSteps = 32;

/// Which step the ball of each object angle has: the indices of the spheres by step, ascending.
std::array<std::vector<std::uint32_t>, kColourSteps> spheres_by_colour(std::span<const MedialSphere> spheres,
                                                                       double least_angle);

/// The middle of the step, in [0, 1].
constexpr float share_of_step(std::uint32_t step) {
  return (static_cast<float>(step) + 0.5f) / static_cast<float>(kColourSteps);
}

}  // namespace medial_vk
