#include "plane/centre_lines/kept_arcs.h"

#include <cstdint>

#include "plane/axis/branches.h"

namespace medial_vk::plane {

PlaneAxis axis_of_arcs(const PlaneAxis& axis, const std::vector<bool>& is_kept, const std::vector<bool>& stays) {
  PlaneAxis kept;
  kept.epsilon = axis.epsilon;
  kept.cells = axis.cells;
  constexpr std::uint32_t kNone = ~0u;
  std::vector<std::uint32_t> place(axis.nodes.size(), kNone);
  const auto keep_node = [&](std::uint32_t node) {
    if (place[node] == kNone) place[node] = 0;
  };
  for (std::size_t a = 0; a < axis.arcs.size(); ++a) {
    if (!is_kept[a]) continue;
    for (const std::uint32_t node : axis.arcs[a].nodes) keep_node(node);
    kept.arcs.push_back(axis.arcs[a]);
  }
  for (std::uint32_t n = 0; n < axis.nodes.size(); ++n) {
    const bool is_alone = axis.nodes[n].degree == 0 || (!stays.empty() && stays[n]);
    if (place[n] == kNone && !is_alone) continue;
    place[n] = static_cast<std::uint32_t>(kept.nodes.size());
    kept.nodes.push_back(axis.nodes[n]);
  }
  for (AxisArc& arc : kept.arcs) {
    for (std::uint32_t& node : arc.nodes) node = place[node];
  }
  set_branches(kept);
  return kept;
}

}  // namespace medial_vk::plane
