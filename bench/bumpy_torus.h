// A mesh for benchmarks, of any size.
#pragma once

#include <cstdint>

#include "medial_vk/mesh.h"

namespace medial_vk::bench {

/// A torus with bumps of several sizes, turned: no two of its edges are alike, none is along an axis. About so many
/// triangles.
Mesh make_bumpy_torus(std::uint32_t triangles);

}  // namespace medial_vk::bench
