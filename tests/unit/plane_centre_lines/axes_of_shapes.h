// Axes of shapes for the tests of centre lines.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "medial_vk/plane_axis.h"
#include "medial_vk/plane_shape.h"

namespace medial_vk::test {

inline PlaneRing rectangle_ring(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

inline PlaneAxis axis_of(const std::vector<PlaneRing>& rings, double object_angle = 0.6,
                         PlaneSide side = PlaneSide::kInside) {
  const auto shape = prepare_shape(rings, FillRule::kEvenOdd);
  EXPECT_TRUE(shape) << shape.error().message;
  PlaneAxisOptions options;
  options.object_angle = object_angle;
  options.side = side;
  auto axis = find_plane_axis(shape.value(), options);
  EXPECT_TRUE(axis) << axis.error().message;
  return std::move(axis).value();
}

/// A star of random radii around 1, the same for the same seed.
inline PlaneRing star_ring(unsigned seed, std::size_t corners) {
  PlaneRing ring;
  std::uint64_t state = seed;
  for (std::size_t i = 0; i < corners; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const double radius = 0.4 + 0.6 * static_cast<double>(state >> 40) / 0x1p24;
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

/// A graph of straight arcs of given lengths between numbered nodes, each with a radius.
inline PlaneAxis axis_of_graph(const std::vector<double>& radii,
                               const std::vector<std::pair<std::array<std::uint32_t, 2>, double>>& edges) {
  PlaneAxis axis;
  for (const double radius : radii) axis.nodes.push_back({{0, 0}, radius, 1, AxisNodeKind::kMeeting, 0});
  for (const auto& [ends, length] : edges) {
    AxisArc arc;
    arc.curve.kind = PlaneCurve::Kind::kOfSegments;
    arc.nodes = ends;
    arc.t = {0, length};
    for (const std::uint32_t end : ends) ++axis.nodes[end].degree;
    const auto number = static_cast<std::uint32_t>(axis.arcs.size());
    axis.branches.push_back({ends, {number}, {false}, length});
    axis.arcs.push_back(arc);
  }
  return axis;
}

inline double length_of(const PlaneAxis& axis) {
  double length = 0;
  for (const AxisBranch& branch : axis.branches) length += branch.length;
  return length;
}

}  // namespace medial_vk::test
