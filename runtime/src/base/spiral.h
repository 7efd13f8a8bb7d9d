// Points spread evenly over the unit sphere: the generalised spiral of Section 2.3.2.
#pragma once

#include <cstdint>
#include <vector>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// `count` unit vectors from pole to pole. Heights divide the axis evenly; the azimuth advances by
/// 3.6 / sqrt(count (1 - h^2)), so that turns are as far apart as points on a turn (Saff and Kuijlaars 1997, after
/// Rakhmanov, Saff and Zhou 1994).
std::vector<Point> spiral_points(std::uint32_t count);

}  // namespace medial_vk
