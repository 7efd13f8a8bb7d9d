#include "thickness/ball_direction.h"

#include <algorithm>

#include "base/point_ops.h"
#include "bvh/nearby_triangles.h"

namespace medial_vk {
namespace {

std::vector<Point> normals_near(const Solid& solid, const Point& p, double radius, double sign,
                                std::vector<std::uint32_t>& nearby) {
  gather_within(solid.bvh(), p, radius, nearby);
  std::vector<Point> normals;
  normals.reserve(nearby.size());
  for (const std::uint32_t position : nearby) {
    const std::array<Point, 3>& corners = solid.bvh().corners()[position];
    if (nearest_on_triangle(p, corners).squared_distance > radius * radius) continue;
    double shorter = 0;
    const Point area = double_area(corners[0], corners[1], corners[2], shorter);
    const double size = length(area);
    if (size > kAreaRounding * shorter) normals.push_back((sign / size) * area);
  }
  return normals;
}

}  // namespace

// The centre of the smallest ball around the normals, by steps of decreasing length towards the farthest one
// (M. Badoiu, K. L. Clarkson, "Smaller core-sets for balls", 2003): the search is correct from any direction.
Point direction_of_balls(const Solid& solid, const Point& p, double radius, ThicknessSide side,
                         std::vector<std::uint32_t>& nearby) {
  constexpr int kSteps = 16;
  const std::vector<Point> normals = normals_near(solid, p, radius, side == ThicknessSide::kWalls ? -1 : 1, nearby);
  if (normals.empty()) return {0, 0, 1};
  Point direction = normals.front();
  for (int step = 0; step < kSteps; ++step) {
    const auto cosine = [&](const Point& normal) { return dot(normal, direction); };
    const Point& farthest = *std::ranges::min_element(normals, {}, cosine);
    direction = direction + (1.0 / (step + 2)) * (farthest - direction);
  }
  const double size = length(direction);
  // Normals to all sides, as at the tip of a needle, have no such direction.
  constexpr double kLeastSize = 0.01;
  return size > kLeastSize ? (1 / size) * direction : normals.front();
}

}  // namespace medial_vk
