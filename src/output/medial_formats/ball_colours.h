// The colour of a ball: by object angle, as in the picture.
#pragma once

#include <array>

namespace medial_vk {

/// 0 at the threshold `least_angle`, 1 at pi/2, clamped.
float colour_share(float object_angle, double least_angle);

/// Viridis at `share`: red, green and blue in [0, 1], encoded for screens (sRGB).
std::array<float, 3> colour_of(float share);

/// The same colour in linear light, as glTF requires.
std::array<float, 3> linear_colour_of(float share);

}  // namespace medial_vk
