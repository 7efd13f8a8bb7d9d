#include "output/medial_formats/ball_colours.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "output/colours/colour_map.h"

namespace medial_vk {
namespace {

/// The transfer function of IEC 61966-2-1.
float linear_of(float srgb) { return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f); }

}  // namespace

float colour_share(float object_angle, double least_angle) {
  const double share = (object_angle - least_angle) / (std::numbers::pi / 2 - least_angle);
  return static_cast<float>(std::clamp(share, 0.0, 1.0));
}

std::array<float, 3> colour_of(float share) {
  const Eigen::Vector3f colour = picture::viridis(share);
  return {colour.x(), colour.y(), colour.z()};
}

std::array<float, 3> linear_colour_of(float share) {
  std::array<float, 3> colour = colour_of(share);
  for (float& part : colour) part = linear_of(part);
  return colour;
}

}  // namespace medial_vk
