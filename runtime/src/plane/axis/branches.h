// Arcs of an axis in a row.
#pragma once

#include "medial_vk/plane_axis.h"

namespace medial_vk::plane {

/// Sets the degrees of nodes, and the branches, in the order of their first arcs.
void set_branches(PlaneAxis& axis);

}  // namespace medial_vk::plane
