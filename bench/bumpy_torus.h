// A mesh for benchmarks, of any size.
#pragma once

#include <cstdint>

#include "medial_vk/mesh.h"

namespace medial_vk::bench {

/// A torus with bumps of several sizes, rotated: no two of its edges are alike, none is along an axis. The number of
/// triangles is approximate.
Mesh make_bumpy_torus(std::uint32_t triangles);

}  // namespace medial_vk::bench
