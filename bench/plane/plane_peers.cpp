#include "plane_peers.h"

#include <cmath>
#include <utility>
#include <vector>

#if __has_include(<boost/polygon/voronoi.hpp>)
#include <boost/polygon/point_data.hpp>
#include <boost/polygon/segment_data.hpp>
#include <boost/polygon/voronoi.hpp>
#define MEDIAL_VK_HAVE_BOOST
#endif

#ifdef MEDIAL_VK_HAVE_CGAL
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Segment_Delaunay_graph_2.h>
#include <CGAL/Segment_Delaunay_graph_filtered_traits_2.h>
#endif

namespace medial_vk::bench {

#ifdef MEDIAL_VK_HAVE_BOOST
std::size_t boost_voronoi(const PreparedShape& shape) {
  using boost::polygon::point_data, boost::polygon::segment_data;
  const double step = shape.report.longest_side() * 0x1p-26;
  const auto at = [&](std::uint32_t i) {
    return point_data<int>(static_cast<int>(std::lround((shape.points[i][0] - shape.report.lower[0]) / step)),
                           static_cast<int>(std::lround((shape.points[i][1] - shape.report.lower[1]) / step)));
  };
  std::vector<segment_data<int>> segments;
  segments.reserve(shape.segments.size());
  for (const auto& [a, b] : shape.segments) segments.emplace_back(at(a), at(b));
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(segments.begin(), segments.end(), &diagram);
  return diagram.num_vertices();
}
#else
std::size_t boost_voronoi(const PreparedShape&) { return 0; }
#endif

#ifdef MEDIAL_VK_HAVE_CGAL
std::size_t cgal_delaunay_graph(const PreparedShape& shape) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  // Segments of a prepared shape meet in common ends only.
  using Traits = CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<Kernel>;
  CGAL::Segment_Delaunay_graph_2<Traits> graph;
  std::vector<Kernel::Point_2> points;
  points.reserve(shape.points.size());
  for (const PlanePoint& p : shape.points) points.emplace_back(p[0], p[1]);
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  segments.reserve(shape.segments.size());
  for (const auto& [a, b] : shape.segments) segments.emplace_back(a, b);
  graph.insert_segments(points.begin(), points.end(), segments.begin(), segments.end());
  return graph.number_of_faces();
}
#else
std::size_t cgal_delaunay_graph(const PreparedShape&) { return 0; }
#endif

}  // namespace medial_vk::bench
