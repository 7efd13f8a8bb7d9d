#include "output/picture/colour_map.h"

#include <algorithm>
#include <array>

namespace medial_vk::picture {

Eigen::Vector3f viridis(float t) {
  // Ten samples of the published map, evenly spaced; between them it is close to straight.
  static constexpr std::array<std::array<float, 3>, 10> kSamples = {{{68, 1, 84},
                                                                     {72, 40, 120},
                                                                     {62, 74, 137},
                                                                     {49, 104, 142},
                                                                     {38, 130, 142},
                                                                     {31, 158, 137},
                                                                     {53, 183, 121},
                                                                     {109, 205, 89},
                                                                     {180, 222, 44},
                                                                     {253, 231, 37}}};
  const float position = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(kSamples.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(position), kSamples.size() - 2);
  const float share = position - static_cast<float>(below);
  const Eigen::Vector3f a(kSamples[below].data());
  const Eigen::Vector3f b(kSamples[below + 1].data());
  return (a + share * (b - a)) / 255.0f;
}

}  // namespace medial_vk::picture
