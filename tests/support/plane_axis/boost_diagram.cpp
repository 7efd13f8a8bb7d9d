#include "support/plane_axis/other_diagram.h"

#if __has_include(<boost/polygon/voronoi.hpp>)
#include <boost/polygon/point_data.hpp>
#include <boost/polygon/segment_data.hpp>
#include <boost/polygon/voronoi.hpp>

namespace medial_vk::test {
namespace {

using Voronoi = boost::polygon::voronoi_diagram<double>;

PlaneContact contact_of(const PreparedShape& shape, const Voronoi::cell_type& cell) {
  const auto segment = static_cast<std::uint32_t>(cell.source_index());
  if (cell.contains_segment()) return {false, segment};
  const bool is_end = cell.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_END_POINT;
  return {true, shape.segments[segment][is_end ? 1 : 0]};
}

}  // namespace

std::optional<OtherDiagram> boost_diagram(const PreparedShape& integral) {
  using boost::polygon::point_data, boost::polygon::segment_data;
  std::vector<segment_data<int>> segments;
  segments.reserve(integral.segments.size());
  const auto at = [&](std::uint32_t i) {
    return point_data<int>(static_cast<int>(integral.points[i][0]), static_cast<int>(integral.points[i][1]));
  };
  for (const auto& [a, b] : integral.segments) segments.emplace_back(at(a), at(b));
  Voronoi diagram;
  boost::polygon::construct_voronoi(segments.begin(), segments.end(), &diagram);

  OtherDiagram result;
  for (const Voronoi::vertex_type& vertex : diagram.vertices()) {
    vertex.color(result.vertices.size());
    OtherDiagram::Vertex& copy = result.vertices.emplace_back();
    copy.point = {vertex.x(), vertex.y()};
    const Voronoi::edge_type* edge = vertex.incident_edge();
    do {
      copy.contacts.push_back(contact_of(integral, *edge->cell()));
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
  }
  for (const Voronoi::edge_type& edge : diagram.edges()) {
    if (!edge.is_primary() || !edge.is_finite() || &edge > edge.twin()) continue;
    result.edges.push_back(
        {{static_cast<std::uint32_t>(edge.vertex0()->color()), static_cast<std::uint32_t>(edge.vertex1()->color())},
         {contact_of(integral, *edge.cell()), contact_of(integral, *edge.twin()->cell())}});
  }
  return result;
}

}  // namespace medial_vk::test

#else

namespace medial_vk::test {
std::optional<OtherDiagram> boost_diagram(const PreparedShape&) { return {}; }
}  // namespace medial_vk::test

#endif
