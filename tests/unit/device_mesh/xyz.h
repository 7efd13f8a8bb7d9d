// Numbers of kernels as points.
#pragma once

#include "base/point_ops.h"
#include "gpu_types.h"

namespace medial_vk {

inline Point xyz(const gpu::vec4& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

}  // namespace medial_vk
