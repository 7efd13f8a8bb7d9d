#pragma once

#include "base/point_ops.h"

namespace medial_vk::any_boundary {

inline Point unit(const Point& v) { return (1 / length(v)) * v; }

}  // namespace medial_vk::any_boundary
