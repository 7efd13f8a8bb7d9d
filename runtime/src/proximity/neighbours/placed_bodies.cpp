#include "proximity/neighbours/placed_bodies.h"

#include <algorithm>
#include <cmath>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "proximity/body.h"
#include "proximity/placement.h"

namespace medial_vk {
namespace {

using PlacedBodiesImpl = Internals::ImplOf<PlacedBodies>::Type;

Point middle_of_balls(std::span<const Ball> balls) {
  if (balls.empty()) return {0, 0, 0};
  Point lower = balls.front().centre, upper = lower;
  for (const Ball& ball : balls) {
    lower = least(lower, ball.centre);
    upper = greatest(upper, ball.centre);
  }
  return 0.5 * lower + 0.5 * upper;
}

}  // namespace

double reach_of_body(const Body& body) {
  const BodyImpl& impl = Internals::of(body);
  double reach = std::max(impl.inside_tree.nodes().reach(), impl.cover_tree.nodes().reach());
  if (impl.surface) reach = std::max(reach, impl.surface->tree.nodes().reach());
  return (length(impl.centre) + reach) * (1 + 8 * 0x1p-53);
}

/// The centre has an error of less than 7 u of the lengths that it is made of. A rotation that is one to within 1e-12
/// stretches lengths by less than 4e-12.
bool world_ball_of(const PlacedBody& placed, Ball& ball) {
  const BodyImpl& impl = Internals::of(placed.body);
  if (!impl.surface && impl.cover.empty()) return false;
  // The solid of a mesh lies in any ball that holds its triangles.
  const double reach = (impl.surface ? impl.surface->tree.nodes() : impl.cover_tree.nodes()).reach();
  ball.centre = placed.pose * impl.centre;
  ball.radius = reach * (1 + 5e-12) + 0x1p-49 * (length(impl.centre) + length(placed.pose.shift));
  return true;
}

Status check_world_pose(const Pose& pose, const std::string& whose) {
  bool is_good = true;
  for (std::size_t i = 0; i < 3; ++i) {
    is_good = is_good && std::fabs(pose.shift[i]) <= kLargestCoordinate;
    for (const double entry : pose.rotation[i]) is_good = is_good && std::fabs(entry) <= 1 + 1e-9;
  }
  if (is_good) return {};
  return Error{ErrorCode::kUsage,
               format_text("the `pose` of {} shifts beyond {:g} or is no rigid motion", whose, kLargestCoordinate)};
}

Result<PlacedBodies> PlacedBodies::create(std::span<const PlacedBody> bodies) {
  if (bodies.size() > kMostBodyBalls) {
    return Error{ErrorCode::kUsage, format_text("there are {} `bodies`, more than {}", bodies.size(), kMostBodyBalls)};
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (Status status = check_world_pose(bodies[i].pose, format_text("body {}", i)); !status) return status.error();
  }
  return catch_out_of_memory("indexing bodies", [&]() -> Result<PlacedBodies> {
    auto impl = std::make_shared<PlacedBodiesImpl>();
    impl->bodies.assign(bodies.begin(), bodies.end());
    std::vector<Ball> balls;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Ball ball;
      if (world_ball_of(bodies[i], ball)) {
        balls.push_back(ball);
        impl->of_ball.push_back(i);
      } else {
        impl->unknown.push_back(i);
      }
    }
    impl->centre = middle_of_balls(balls);
    impl->tree = BodyTree::build(balls, impl->centre);
    return PlacedBodies(impl);
  });
}

std::size_t PlacedBodies::size() const { return impl_->bodies.size(); }

}  // namespace medial_vk
