// What tests of files of hulls share: files are made, and what they hold is compared with the hulls.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/point_ops.h"
#include "output/hull_files/hull_files.h"

namespace medial_vk::test {

inline std::string encoded(HullFormat format, const HullRecord& record) {
  Result<std::string> bytes = encode_hulls(format, record);
  EXPECT_TRUE(bytes.ok()) << name_of(format) << ": " << (bytes.ok() ? "" : bytes.error().message);
  return bytes.ok() ? std::move(bytes).value() : std::string();
}

/// Every edge of a closed surface has one neighbour in the other direction.
inline void expect_closed(const std::vector<Triangle>& triangles) {
  std::map<std::array<std::uint32_t, 2>, int> edges;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({edge[1], edge[0]}));
  }
}

inline double volume_in(const std::vector<Point>& vertices, const std::vector<Triangle>& triangles) {
  double six_volumes = 0;
  for (const auto& [a, b, c] : triangles) {
    const Point o = vertices[0];
    six_volumes += dot(vertices[a] - o, cross(vertices[b] - o, vertices[c] - o));
  }
  return six_volumes / 6;
}

/// Closed, inside the hull, and with most of its volume: within 1 % of the greatest radius of the surface.
inline void expect_mesh_of(const BallHull& hull, const std::vector<Point>& vertices,
                           const std::vector<Triangle>& triangles) {
  expect_closed(triangles);
  for (const Point& v : vertices) ASSERT_LE(signed_distance(hull, v), 0);
  const double volume = volume_of(hull);
  EXPECT_LE(volume_in(vertices, triangles), volume * (1 + 1e-12));
  EXPECT_GT(volume_in(vertices, triangles), 0.85 * volume);
}

inline void expect_ball_inside(const BallHull& hull, const Point& centre, double radius) {
  EXPECT_LE(signed_distance(hull, centre) + radius, 0);
}

/// A vector by the rotation of a quaternion w, x, y, z of unit length.
inline Point rotated(const std::vector<double>& q, const Point& p) {
  const Point v = {q[1], q[2], q[3]};
  const Point twice = 2 * cross(v, p);
  return p + q[0] * twice + cross(v, twice);
}

}  // namespace medial_vk::test
