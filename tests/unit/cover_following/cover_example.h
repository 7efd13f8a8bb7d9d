// Solids with covers that follow them, and what tests compare.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/sphere_certificate.h"
#include "medial_vk/cover_follower.h"
#include "medial_vk/prepare.h"
#include "solid/solid.h"
#include "support/indexed.h"
#include "support/reference_balls.h"
#include "support/reference_mesh.h"
#include "support/solids/motions.h"
#include "support/solids/solids.h"

namespace medial_vk {

using CoverFrame = std::vector<Point>;

/// Balls around the cells of a grid that the solid may meet, or with `shell` its boundary alone.
inline std::vector<Ball> cells_of(const IndexedMesh& mesh, double cell, bool shell = false) {
  const Solid solid = Solid::build(mesh).value();
  const MeshReport& report = mesh.prepared().report;
  const double radius = 0.87 * cell;  // more than half of a cell's diagonal
  std::vector<Ball> balls;
  for (double x = report.lower[0] - cell / 3; x < report.upper[0] + cell; x += cell) {
    for (double y = report.lower[1] - cell / 3; y < report.upper[1] + cell; y += cell) {
      for (double z = report.lower[2] - cell / 3; z < report.upper[2] + cell; z += cell) {
        const Point p = {x, y, z};
        if (solid.distance(p) <= radius || (!shell && solid.contains(p))) balls.push_back({p, radius});
      }
    }
  }
  return balls;
}

struct CoverExample {
  CoverExample(Mesh raw, double cell, bool shell = false)
      : mesh(test::indexed(prepare_mesh(std::move(raw)).value())), balls(cells_of(mesh, cell, shell)) {}

  CoverFrame rest() const { return {mesh.view().vertices.begin(), mesh.view().vertices.end()}; }
  CoverFollower follower(const CoverFollowerOptions& options = {}) const {
    return CoverFollower::create(mesh, balls, options).value();
  }

  IndexedMesh mesh;
  std::vector<Ball> balls;
};

inline CoverExample covered_torus() { return {test::make_turned_torus(40, 20), 0.4}; }
inline CoverExample covered_l_shape() { return {test::make_l_shape(2, 0.6, 0.8), 0.35}; }

inline std::vector<Ball> used_balls(std::span<const Ball> balls) {
  std::vector<Ball> used;
  std::ranges::copy_if(balls, std::back_inserter(used), [](const Ball& ball) { return ball.radius > 0; });
  return used;
}

/// By the reference: the balls cover the frame. `turned`: its triangles are turned over, so that a mirrored solid has
/// positive winding numbers.
inline void expect_cover(const CoverFollower& follower, const IndexedMesh& mesh, const CoverFrame& frame,
                         const std::string& where, bool turned = false) {
  EXPECT_EQ(follower.state(), CoverState::kSolid) << where;
  Mesh moved = mesh.prepared().mesh;
  moved.vertices = frame;
  if (turned) test::turn_over(moved);
  reference::Mesh of_reference = test::to_reference(moved);
  of_reference.closed = mesh.prepared().report.closed;
  const reference::Certificate certificate =
      reference::check_cover(of_reference, test::to_reference(used_balls(follower.balls())));
  EXPECT_GE(certificate.lines.size(), 2u);
  for (const auto& line : certificate.lines) EXPECT_EQ(line.failed, 0u) << where << ": " << line.first_failure;
}

inline bool any_holds(std::span<const Ball> balls, const Point& p) {
  return std::ranges::any_of(balls, [&](const Ball& ball) { return length(p - ball.centre) <= ball.radius; });
}

inline double difference_of(std::span<const Ball> a, std::span<const Ball> b) {
  double difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max({difference, length(a[i].centre - b[i].centre), std::fabs(a[i].radius - b[i].radius)});
  }
  return difference;
}

inline std::vector<Ball> balls_of(const CoverFollower& follower) {
  return {follower.balls().begin(), follower.balls().end()};
}

}  // namespace medial_vk
