#include "cgal/segment_graph.h"

#include <CGAL/CORE_Expr.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Segment_Delaunay_graph_2.h>
#include <CGAL/Segment_Delaunay_graph_filtered_traits_2.h>
#include <CGAL/Segment_Delaunay_graph_traits_2.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace medial_vk::test {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Traits = CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<Kernel>;
using Graph = CGAL::Segment_Delaunay_graph_2<Traits>;
using Coordinates = std::pair<double, double>;

// Roots of integers and their sums, as exact as is asked for.
using ExactKernel = CGAL::Simple_cartesian<CORE::Expr>;
using ExactTraits = CGAL::Segment_Delaunay_graph_traits_without_intersections_2<ExactKernel, CGAL::Field_with_sqrt_tag>;

ExactTraits::Site_2 exact(const Graph::Site_2& site) {
  const auto point = [](const Kernel::Point_2& p) { return ExactKernel::Point_2(p.x(), p.y()); };
  if (site.is_point()) return ExactTraits::Site_2::construct_site_2(point(site.point()));
  return ExactTraits::Site_2::construct_site_2(point(site.source()), point(site.target()));
}

/// From a point to a point or to the line of a segment.
double distance_to(const Graph::Site_2& site, const Kernel::Point_2& x) {
  if (site.is_point()) return std::hypot(x.x() - site.point().x(), x.y() - site.point().y());
  const Kernel::Point_2 a = site.source(), b = site.target();
  const double ux = b.x() - a.x(), uy = b.y() - a.y();
  return std::fabs(ux * (x.y() - a.y()) - uy * (x.x() - a.x())) / std::hypot(ux, uy);
}

/// The point that is equally far from the sites of a face. Constructed in doubles, it can be far off where two of them
/// are nearly parallel; then it is constructed exactly, and rounded.
PlanePoint centre_of(const Graph& graph, Graph::Face_handle face) {
  const Kernel::Point_2 centre = graph.primal(face);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int i = 0; i < 3; ++i) {
    const double d = distance_to(face->vertex(i)->site(), centre);
    least = std::min(least, d);
    most = std::max(most, d);
  }
  constexpr double kStep = 0x1p-10;  // of coordinates that are integers of some 24 bits
  if (most - least < kStep) return {centre.x(), centre.y()};
  const auto vertex = ExactTraits().construct_svd_vertex_2_object()(
      exact(face->vertex(0)->site()), exact(face->vertex(1)->site()), exact(face->vertex(2)->site()));
  return {CGAL::to_double(vertex.x()), CGAL::to_double(vertex.y())};
}

/// Sites of the graph as contacts.
class ContactsOfSites {
 public:
  explicit ContactsOfSites(const PreparedShape& shape) {
    for (std::uint32_t i = 0; i < shape.points.size(); ++i) points_[{shape.points[i][0], shape.points[i][1]}] = i;
    for (std::uint32_t i = 0; i < shape.segments.size(); ++i) {
      segments_[std::minmax(shape.segments[i][0], shape.segments[i][1])] = i;
    }
  }

  PlaneContact of(const Graph::Site_2& site) const {
    if (site.is_point()) return {true, index_of(site.point())};
    return {false, segments_.at(std::minmax(index_of(site.source()), index_of(site.target())))};
  }

 private:
  std::uint32_t index_of(const Kernel::Point_2& p) const { return points_.at({p.x(), p.y()}); }

  std::map<Coordinates, std::uint32_t> points_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> segments_;
};

}  // namespace

OtherDiagram cgal_diagram(const PreparedShape& shape) {
  Graph graph;
  std::vector<Kernel::Point_2> points;
  points.reserve(shape.points.size());
  for (const PlanePoint& p : shape.points) points.emplace_back(p[0], p[1]);
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  segments.reserve(shape.segments.size());
  for (const auto& [a, b] : shape.segments) segments.emplace_back(a, b);
  graph.insert_segments(points.begin(), points.end(), segments.begin(), segments.end());

  const ContactsOfSites contacts(shape);
  OtherDiagram result;
  std::map<Graph::Face_handle, std::uint32_t> vertices;
  for (auto face = graph.finite_faces_begin(); face != graph.finite_faces_end(); ++face) {
    vertices[face] = static_cast<std::uint32_t>(result.vertices.size());
    OtherDiagram::Vertex& vertex = result.vertices.emplace_back();
    vertex.point = centre_of(graph, face);
    for (int i = 0; i < 3; ++i) vertex.contacts.push_back(contacts.of(face->vertex(i)->site()));
  }
  for (auto edge = graph.finite_edges_begin(); edge != graph.finite_edges_end(); ++edge) {
    const Graph::Face_handle face = edge->first, other = face->neighbor(edge->second);
    if (graph.is_infinite(face) || graph.is_infinite(other)) continue;
    result.edges.push_back({{vertices.at(face), vertices.at(other)},
                            {contacts.of(face->vertex(Graph::cw(edge->second))->site()),
                             contacts.of(face->vertex(Graph::ccw(edge->second))->site())}});
  }
  return result;
}

}  // namespace medial_vk::test
