#include "output/colours/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace medial_vk::picture {
namespace {

using Eigen::Vector3f;

Vector3f bytes(int red, int green, int blue) {
  return Vector3f(static_cast<float>(red), static_cast<float>(green), static_cast<float>(blue)) / 255.0f;
}

}  // namespace

std::span<const Vector3f> viridis_samples() {
  static const std::array<Vector3f, 10> kSamples = {
      bytes(68, 1, 84),    bytes(72, 40, 120),  bytes(62, 74, 137),  bytes(49, 104, 142), bytes(38, 130, 142),
      bytes(31, 158, 137), bytes(53, 183, 121), bytes(109, 205, 89), bytes(180, 222, 44), bytes(253, 231, 37)};
  return kSamples;
}

Vector3f viridis(float t) {
  const std::span<const Vector3f> samples = viridis_samples();
  const float position = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(samples.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(position), samples.size() - 2);
  const float share = position - static_cast<float>(below);
  return samples[below] + share * (samples[below + 1] - samples[below]);
}

std::span<const Vector3f> sheet_colours() {
  // The colours of Okabe and Ito, which all readers can distinguish, then paler or darker ones; the page uses the same.
  static const std::array<Vector3f, 13> kColours = {
      bytes(140, 148, 158), bytes(230, 159, 0),   bytes(86, 180, 233), bytes(0, 158, 115),   bytes(213, 94, 0),
      bytes(204, 121, 167), bytes(240, 228, 66),  bytes(0, 114, 178),  bytes(168, 216, 160), bytes(150, 90, 40),
      bytes(176, 160, 224), bytes(250, 180, 160), bytes(110, 130, 40)};
  return kColours;
}

std::size_t sheet_colour_index(std::int32_t sheet) {
  return sheet < 0 ? 0 : 1 + static_cast<std::size_t>(sheet) % (sheet_colours().size() - 1);
}

Vector3f to_light(const Vector3f& srgb) {
  return srgb.unaryExpr([](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); });
}

Vector3f to_srgb(const Vector3f& light) {
  return light.unaryExpr([](float l) {
    const float c = std::clamp(l, 0.0f, 1.0f);
    return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f;
  });
}

std::uint8_t byte_of(float share) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0f, 1.0f) * 255.0f));
}

}  // namespace medial_vk::picture
