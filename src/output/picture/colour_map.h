#pragma once

#include <Eigen/Core>

namespace medial_vk::picture {

/// Viridis (van der Walt and Smith 2015): even steps look like even steps, also to colour-blind eyes and in grey.
/// `t` is clamped to [0, 1]; red, green and blue are in [0, 1].
Eigen::Vector3f viridis(float t);

}  // namespace medial_vk::picture
