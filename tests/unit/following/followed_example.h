// Solids with balls that follow them, and what tests compare.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/point_ops.h"
#include "cpu_reference/sphere_certificate.h"
#include "medial_vk/follower.h"
#include "medial_vk/prepare.h"
#include "solid/solid.h"
#include "support/indexed.h"
#include "support/reference_balls.h"
#include "support/reference_mesh.h"
#include "support/solids/solids.h"

namespace medial_vk {

using Frame = std::vector<Point>;

/// The balls around `count` random points inside a solid.
inline std::vector<Ball> balls_in(const IndexedMesh& mesh, std::size_t count) {
  const Solid solid = Solid::build(mesh).value();
  const MeshReport& report = mesh.prepared().report;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Ball> balls;
  while (balls.size() < count) {
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = report.lower[k] + unit(random) * (report.upper[k] - report.lower[k]);
    const double distance = solid.distance(p);
    if (distance > 1e-3 && solid.contains(p)) balls.push_back({p, distance * (1 - 1e-12)});
  }
  return balls;
}

struct Example {
  explicit Example(Mesh raw, std::size_t count = 120)
      : mesh(test::indexed(prepare_mesh(std::move(raw)).value())), balls(balls_in(mesh, count)) {}

  Frame rest() const { return {mesh.view().vertices.begin(), mesh.view().vertices.end()}; }
  Follower follower(const FollowerOptions& options = {}) const {
    return Follower::create(mesh, balls, options).value();
  }

  IndexedMesh mesh;
  std::vector<Ball> balls;
};

/// An example in another unit and place; its balls are smaller by more than the rounding of their places.
class PlacedExample {
  double unit_;
  Point shift_;

 public:
  PlacedExample(const Example& of, double unit, double away)
      : unit_(unit), shift_{away, -away, away}, mesh(placed_mesh(of)) {
    for (const Ball& ball : of.balls) {
      balls.push_back({unit_ * (ball.centre + shift_), unit_ * (ball.radius * (1 - 1e-6))});
    }
  }

  Frame place(Frame frame) const {
    for (Point& p : frame) p = unit_ * (p + shift_);
    return frame;
  }

  IndexedMesh mesh;
  std::vector<Ball> balls;

 private:
  IndexedMesh placed_mesh(const Example& of) const {
    Mesh moved = of.mesh.prepared().mesh;
    moved.vertices = place(moved.vertices);
    return test::indexed(test::view_of(moved));
  }
};

inline Example torus() { return Example(test::make_turned_torus(40, 20)); }
inline Example l_shape() { return Example(test::make_l_shape(2, 0.6, 0.8)); }

inline std::vector<Ball> not_lost(const Follower& follower) {
  std::vector<Ball> balls;
  for (const Ball& ball : follower.balls()) {
    if (ball.radius > 0) balls.push_back(ball);
  }
  return balls;
}

inline reference::Mesh reference_of(const IndexedMesh& mesh, const Frame& frame) {
  Mesh moved = mesh.prepared().mesh;
  moved.vertices = frame;
  reference::Mesh out = test::to_reference(moved);
  out.closed = mesh.prepared().report.closed;
  return out;
}

/// By the reference: every ball that is not lost lies inside the frame.
inline void expect_inside(const Follower& follower, const IndexedMesh& mesh, const Frame& frame,
                          const std::string& where) {
  const reference::Certificate certificate =
      reference::check_inside(reference_of(mesh, frame), test::to_reference(not_lost(follower)));
  for (const auto& line : certificate.lines) EXPECT_EQ(line.failed, 0u) << where << ": " << line.first_failure;
}

inline std::size_t lost(const Follower& follower) {
  return static_cast<std::size_t>(std::ranges::count(follower.states(), FollowState::kLost));
}

inline double greatest_difference(std::span<const Ball> a, std::span<const Ball> b) {
  double difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max({difference, length(a[i].centre - b[i].centre), std::fabs(a[i].radius - b[i].radius)});
  }
  return difference;
}

inline std::vector<Ball> copy_of(std::span<const Ball> balls) { return {balls.begin(), balls.end()}; }

}  // namespace medial_vk
