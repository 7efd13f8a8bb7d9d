// By how much joints stretch what is below them.
#pragma once

#include <span>
#include <vector>

#include "rigs/ball_rig.h"

namespace medial_vk {

/// The greatest factor by which the map lengthens a vector: the largest singular value of its matrix, up to a few
/// roundings. Infinite where the matrix is not finite.
double greatest_stretch(const AffineMap& map);

/// By joint, the greatest of all frames.
std::vector<double> greatest_stretches(std::span<const RiggedFrame> frames);

}  // namespace medial_vk
