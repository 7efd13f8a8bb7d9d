// The nodes of an axis against Boost.Polygon's Voronoi diagram of points and segments, whose coordinates are integers.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/polygon/point_data.hpp>
#include <boost/polygon/segment_data.hpp>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/plane_axis/exact_distances.h"
#include "support/plane_axis/ring_shapes.h"

namespace medial_vk::test {
namespace {

using boost::polygon::point_data, boost::polygon::segment_data;

/// Rings with coordinates that are integers of up to 2^26.
std::vector<PlaneRing> integral(std::vector<PlaneRing> rings) {
  double most = 0;
  for (const PlaneRing& ring : rings) {
    for (const PlanePoint& p : ring) most = std::max({most, std::fabs(p[0]), std::fabs(p[1])});
  }
  for (PlaneRing& ring : rings) {
    for (PlanePoint& p : ring) p = {std::round(p[0] / most * 0x1p26), std::round(p[1] / most * 0x1p26)};
  }
  return rings;
}

/// Vertices of the diagram that lie inside and have contacts at an angle above twice the threshold.
std::vector<PlanePoint> vertices_by_boost(const PreparedShape& shape, double least_angle) {
  std::vector<segment_data<int>> segments;
  for (const auto& [a, b] : shape.segments) {
    const auto at = [&](std::uint32_t i) {
      return point_data<int>(static_cast<int>(shape.points[i][0]), static_cast<int>(shape.points[i][1]));
    };
    segments.emplace_back(at(a), at(b));
  }
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(segments.begin(), segments.end(), &diagram);
  std::vector<PlanePoint> result;
  for (const auto& vertex : diagram.vertices()) {
    const PlanePoint x = {vertex.x(), vertex.y()};
    const double radius = nearest_point(shape, x).distance;
    if (radius < 1 || !is_inside(shape, x)) continue;
    // The feet on all segments that are equally far, to the rounding of coordinates of 2^26.
    std::vector<double> directions;
    for (const auto& [a, b] : shape.segments) {
      const PreparedShape one = {shape.points, {{a, b}}, {}};
      const NearestPoint near = nearest_point(one, x);
      if (near.distance <= radius + 1e-6) directions.push_back(std::atan2(near.foot[1] - x[1], near.foot[0] - x[0]));
    }
    double widest = 0;
    for (const double a : directions) {
      for (const double b : directions) {
        const double turn = std::fabs(a - b);
        widest = std::max(widest, std::min(turn, 2 * std::numbers::pi - turn) / 2);
      }
    }
    if (widest > least_angle) result.push_back(x);
  }
  return result;
}

double nearest_of(const std::vector<PlanePoint>& points, const PlanePoint& x) {
  double best = std::numeric_limits<double>::infinity();
  for (const PlanePoint& p : points) best = std::min(best, std::hypot(p[0] - x[0], p[1] - x[1]));
  return best;
}

TEST(BoostVoronoi, HasTheSameVertices) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 70; ++seed) {
    if (seed % 7 == 0 || seed % 7 == 2 || seed % 7 == 3) continue;  // crossings are no integers
    SCOPED_TRACE(seed);
    const PreparedShape shape = prepared(integral(rings_of_seed(seed)), FillRule::kEvenOdd);
    PlaneAxisOptions options;
    options.object_angle = 0.1;
    const auto axis = find_plane_axis(shape, options);
    ASSERT_TRUE(axis.ok());
    const std::vector<PlanePoint> wide = vertices_by_boost(shape, 0.11), all = vertices_by_boost(shape, 0.09);
    // Boost rounds vertices to doubles, and its own tests allow 64 units in the last place; a thousandth is ample.
    for (const PlanePoint& vertex : wide) EXPECT_LT(distance_to_axis(axis.value(), vertex), 1e-3);
    // Where walls are parallel but for the rounding of their ends, vertices slide along the axis.
    if (seed % 7 == 4 || seed % 7 == 6) continue;
    std::vector<PlanePoint> nodes;
    for (const AxisNode& node : axis.value().nodes) {
      if (node.kind == AxisNodeKind::kMeeting && node.radius >= 1) nodes.push_back(node.point);
    }
    for (const PlanePoint& vertex : wide) EXPECT_LT(nearest_of(nodes, vertex), 1e-3);
    for (const PlanePoint& node : nodes) EXPECT_LT(nearest_of(all, node), 1e-3);
    compared += nodes.size();
  }
  EXPECT_GT(compared, 700u);
}

}  // namespace
}  // namespace medial_vk::test
