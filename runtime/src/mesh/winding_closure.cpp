#include "mesh/winding_closure.h"

#include <cmath>

#include "base/point_ops.h"
#include "mesh/winding/winding_number.h"

namespace medial_vk {

WindingClosure::WindingClosure(const Mesh& mesh, const MeshTopology& topology) {
  Point sum = {0, 0, 0};
  for (std::uint32_t edge = 0; edge < topology.edge_count(); ++edge) {
    const auto balance = static_cast<double>(balance_at(mesh, topology, edge));
    if (balance == 0) continue;
    const Point &from = mesh.vertices[topology.ends(edge)[0]], &to = mesh.vertices[topology.ends(edge)[1]];
    // Against the direction in which the mesh traverses the edge more often.
    triangles_.push_back({{balance > 0 ? to : from, balance > 0 ? from : to, {}}, std::fabs(balance)});
    sum = sum + 0.5 * (from + to);
  }
  const Point apex = (1.0 / static_cast<double>(std::max<std::size_t>(1, triangles_.size()))) * sum;
  for (Closing& triangle : triangles_) triangle.corners[2] = apex;
}

double WindingClosure::sharpened(const Point& p, double rough) const {
  CompensatedSum added;
  for (const Closing& triangle : triangles_) added.add(triangle.times * triangle_winding(triangle.corners, p));
  return std::round(rough + added.value()) - added.value();
}

}  // namespace medial_vk
