// The content of a mesh as a short text.
#pragma once

#include <string>

#include "medial_vk/mesh.h"

namespace medial_vk::cli {

/// 32 hexadecimal digits of the mesh as it was read, whatever its format and the files that it was in. It is the pair
/// of values of a polynomial at two points of the field of 2^61 - 1 elements. The polynomial has n coefficients, which
/// are the n words of 32 bits of the mesh with their number, so two different meshes have equal values at fewer than n
/// points each, hence for a share below (n / 2^61)^2 of all pairs of points: 2e-19 for 10^9 words.
std::string mesh_digest(const Mesh& mesh);

}  // namespace medial_vk::cli
