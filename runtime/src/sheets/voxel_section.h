// The area of a plane in a voxel.
#pragma once

#include <array>

namespace medial_vk {

/// Area of the plane through `point` perpendicular to `normal` within the cube [0, 1]^3; 0 if the normal is zero.
/// The sum over all voxels that a plane passes, once each, is the area of the plane.
double section_area(const std::array<double, 3>& point, const std::array<double, 3>& normal);

}  // namespace medial_vk
