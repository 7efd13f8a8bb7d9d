#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace medial_vk::picture {

/// Viridis (van der Walt and Smith 2015): even steps look like even steps, also to colour-blind eyes and in grey.
/// `t` is clamped to [0, 1]; red, green and blue are in [0, 1].
Eigen::Vector3f viridis(float t);

/// Ten samples of viridis, evenly spaced; between them it is close to straight.
std::span<const Eigen::Vector3f> viridis_samples();

/// The colour of points that have no sheet, then those of the sheets, by turns.
std::span<const Eigen::Vector3f> sheet_colours();
/// Where in sheet_colours() a sheet's colour is.
std::size_t sheet_colour_index(std::int32_t sheet);

/// From the numbers of a file (IEC 61966-2-1) to light and back.
Eigen::Vector3f to_light(const Eigen::Vector3f& srgb);
Eigen::Vector3f to_srgb(const Eigen::Vector3f& light);
/// The nearest of 256 steps; `share` is clamped to [0, 1].
std::uint8_t byte_of(float share);

}  // namespace medial_vk::picture
