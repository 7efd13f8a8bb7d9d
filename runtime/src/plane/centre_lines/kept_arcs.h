// A part of an axis.
#pragma once

#include <vector>

#include "medial_vk/plane_axis.h"

namespace medial_vk::plane {

/// Whether a branch can end at the node without being held there: nothing else meets it, and it does not leave the box.
inline bool is_free_end(const AxisNode& node) { return node.degree == 1 && node.kind != AxisNodeKind::kBorder; }

/// Some arcs of an axis with their nodes, the nodes that never had an arc, and those that stay without one; `stays` may
/// be empty.
PlaneAxis axis_of_arcs(const PlaneAxis& axis, const std::vector<bool>& is_kept, const std::vector<bool>& stays = {});

}  // namespace medial_vk::plane
