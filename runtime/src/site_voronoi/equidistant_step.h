#pragma once

#include <optional>
#include <span>

#include "site_voronoi/cell_sites.h"

namespace medial_vk {

/// The shortest step from p after which the tangents of two to four distances at p are equal. No value where there is
/// none, as where contacts are in one plane with p.
std::optional<Point> step_to_equal(const Point& p, std::span<const SiteDistance> distances);

}  // namespace medial_vk
