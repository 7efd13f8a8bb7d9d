#include "mesh/winding_closure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/point_ops.h"
#include "mesh/winding/winding_number.h"

namespace medial_vk {

WindingClosure::WindingClosure(const Mesh& mesh, const MeshTopology& topology) {
  Point sum = {0, 0, 0}, reach = {0, 0, 0};
  for (std::uint32_t edge = 0; edge < topology.edge_count(); ++edge) {
    const auto balance = static_cast<double>(balance_at(mesh, topology, edge));
    if (balance == 0) continue;
    const Point &from = mesh.vertices[topology.ends(edge)[0]], &to = mesh.vertices[topology.ends(edge)[1]];
    // Against the direction in which the mesh traverses the edge more often.
    triangles_.push_back({{balance > 0 ? to : from, balance > 0 ? from : to, {}}, std::fabs(balance)});
    sum = sum + 0.5 * (from + to);
    reach = greatest(reach, greatest(from - to, to - from));
  }
  // Not in the mean of the edges: searches on symmetric meshes begin there.
  const Point mean = (1.0 / static_cast<double>(std::max<std::size_t>(1, triangles_.size()))) * sum;
  const Point apex = mean + Point{0.311 * reach[0], 0.173 * reach[1], 0.237 * reach[2]};
  for (Closing& triangle : triangles_) triangle.corners[2] = apex;
}

std::optional<double> WindingClosure::sharpened(const Point& p, double rough, double doubt) const {
  CompensatedSum added;
  for (const Closing& triangle : triangles_) added.add(triangle.times * triangle_winding(triangle.corners, p));
  const double whole = rough + added.value(), integer = std::round(whole);
  if (std::fabs(whole - integer) > doubt) return std::nullopt;
  return integer - added.value();
}

}  // namespace medial_vk
