#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace medial_vk::picture {

/// Viridis (van der Walt and Smith 2015): equal steps appear equal, also to colour-blind readers and in grey. `t` is
/// clamped to [0, 1]; red, green and blue are in [0, 1].
Eigen::Vector3f viridis(float t);

/// Ten samples of viridis, evenly spaced; it is close to linear between them.
std::span<const Eigen::Vector3f> viridis_samples();

/// The colour of points without a sheet, then the colours that sheets take in turn.
std::span<const Eigen::Vector3f> sheet_colours();
/// The index of a sheet's colour in sheet_colours().
std::size_t sheet_colour_index(std::int32_t sheet);

/// Conversion from encoded sRGB values (IEC 61966-2-1) to linear light and back.
Eigen::Vector3f to_light(const Eigen::Vector3f& srgb);
Eigen::Vector3f to_srgb(const Eigen::Vector3f& light);
/// The nearest of 256 steps; `share` is clamped to [0, 1].
std::uint8_t byte_of(float share);

}  // namespace medial_vk::picture
