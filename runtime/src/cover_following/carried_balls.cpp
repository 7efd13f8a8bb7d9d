#include "cover_following/carried_balls.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr double kRounding = 0x1p-53;

/// By which radii are greater than they need to be: shares of the longest side, and units of the greatest coordinate.
constexpr double kRoomOfSide = 1e-9, kRoomOfCoordinate = 256;

/// The length by which a normal counts as an edge, as a share of the radius.
constexpr double kNormalLength = 0.5;

/// In longest sides. A centre that is farther from the patches, as that of a ball far from a mesh may be, would give a
/// radius that has lost the digits that tell the patches apart.
constexpr double kFarthest = 1 << 20;

Eigen::Vector3d vector_of(const Point& p) { return {p[0], p[1], p[2]}; }

double greatest_coordinate(const Corners3& corners) {
  double greatest = 0;
  for (const Point& p : corners) greatest = std::max({greatest, std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])});
  return greatest;
}

}  // namespace

const Point& HeldCorners::farthest(const Point& from) const {
  std::size_t out = 0;
  double most = -1;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point d = points[k] - from;
    const double squared = dot(d, d);
    if (!(squared > most)) continue;
    most = squared;
    out = k;
  }
  return points[out];
}

/// Distances have relative errors of 4 units, and so has the radius.
Ball HeldCorners::around(const Point& centre) const {
  return {centre, length(farthest(centre) - centre) * (1 + 16 * kRounding) + room};
}

CarriedBalls::CarriedBalls(const MovingSurface& surface, Patches patches, std::span<const Ball> balls)
    : patches_(std::move(patches)),
      mean_shares_(patches_.corners.size()),
      shares_(patches_.corners.size()),
      normal_shares_(patches_.patches.size()) {
  centres_.reserve(balls.size());
  for (const Ball& ball : balls) centres_.push_back(ball.centre);
  for (std::size_t i = 0; i < balls.size(); ++i) prepare(surface, i, balls[i].radius);
}

/// The affine map of least squares, from corners and normals, takes the centre c to m' + H Q^-1 (c - m) with
/// Q = sum w (p - m)(p - m)^T and H = sum w (p' - m')(p - m)^T: a sum of shares of p' - m'.
void CarriedBalls::prepare(const MovingSurface& surface, std::size_t i, double radius) {
  double total = 0, corners = 0;
  for (const Patch& patch : patches_.of(i)) {
    total += patch.area;
    corners += patch.count;
  }
  most_corners_ = std::max(most_corners_, static_cast<std::size_t>(corners));
  Point mean{};
  const auto for_corners = [&](const auto& visit) {
    for (const Patch& patch : patches_.of(i)) {
      const double weight = total > 0 ? patch.area / (total * patch.count) : 1 / corners;
      for (std::uint32_t k = patch.first; k < patch.first + patch.count; ++k) {
        visit(k, weight, point_of(patches_.corners[k], surface.corners(patch.triangle)));
      }
    }
  };
  for_corners([&](std::uint32_t k, double weight, const Point& p) {
    mean_shares_[k] = weight;
    mean = mean + weight * p;
  });
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for_corners([&](std::uint32_t, double weight, const Point& p) {
    const Eigen::Vector3d d = vector_of(p - mean);
    squares += weight * d * d.transpose();
  });
  const double normal_weight = kNormalLength * kNormalLength * radius * radius / (total > 0 ? total : 1);
  for (const Patch& patch : patches_.of(i)) {
    const Eigen::Vector3d n = vector_of(surface.inward_normal(patch.triangle));
    squares += normal_weight * patch.area * n * n.transpose();
  }
  squares += (1e-9 * squares.trace()) * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d solved = squares.ldlt().solve(vector_of(centres_[i] - mean));
  if (!solved.allFinite()) return;  // the mean it is
  for_corners(
      [&](std::uint32_t k, double weight, const Point& p) { shares_[k] = weight * vector_of(p - mean).dot(solved); });
  for (std::size_t k = patches_.first[i]; k < patches_.first[i + 1]; ++k) {
    const Patch& patch = patches_.patches[k];
    normal_shares_[k] = normal_weight * patch.area * vector_of(surface.inward_normal(patch.triangle)).dot(solved);
  }
}

/// Sums of differences from one of the corners, so that a mesh far from the origin keeps its digits.
Point CarriedBalls::carried(const MovingSurface& surface, std::size_t i) const {
  const Point origin = surface.corners(patches_.of(i).front().triangle)[0];
  Point mean{}, moved{};
  double sum = 0;
  for (std::size_t k = patches_.first[i]; k < patches_.first[i + 1]; ++k) {
    const Patch& patch = patches_.patches[k];
    const Corners3 corners = surface.corners(patch.triangle);
    for (std::uint32_t corner = patch.first; corner < patch.first + patch.count; ++corner) {
      const Point p = point_of(patches_.corners[corner], corners) - origin;
      mean = mean + mean_shares_[corner] * p;
      moved = moved + shares_[corner] * p;
      sum += shares_[corner];
    }
    moved = moved + normal_shares_[k] * surface.inward_normal(patch.triangle);
  }
  const Point further = moved - sum * mean;
  const bool is_near = length(further) <= kFarthest * surface.longest_side();  // not if it is no number
  return origin + (is_near ? mean + further : mean);
}

/// Three products and two sums, all of at most the greatest coordinate, are rounded in each coordinate of a point,
/// whose error is then below 7 units of it. The room is much greater than that, so that proofs by division into parts
/// end.
void CarriedBalls::hold(const MovingSurface& surface, std::size_t i, HeldCorners& held) const {
  held.points.clear();
  double greatest = 0;
  for (const Patch& patch : patches_.of(i)) {
    const Corners3 corners = surface.corners(patch.triangle);
    greatest = std::max(greatest, greatest_coordinate(corners));
    for (std::uint32_t k = patch.first; k < patch.first + patch.count; ++k) {
      held.points.push_back(point_of(patches_.corners[k], corners));
    }
  }
  held.room = kRoomOfSide * surface.longest_side() + kRoomOfCoordinate * kRounding * greatest;
}

Ball CarriedBalls::ball(const MovingSurface& surface, std::size_t i, HeldCorners& memory) const {
  if (!has_patches(i)) return {centres_[i], 0};
  hold(surface, i, memory);
  return memory.around(carried(surface, i));
}

/// The function is convex; its gradient is the vector less `area` times the direction to the farthest point.
Ball CarriedBalls::shifted(const MovingSurface& surface, std::size_t i, const Ball& ball, double area,
                           const Point& vector, double reach, HeldCorners& memory) const {
  constexpr int kSteps = 12;
  if (!has_patches(i) || !(area > 0)) return ball;
  hold(surface, i, memory);
  Ball best = ball;
  double least = area * ball.radius;
  Point centre = ball.centre;
  for (int step = 0; step < kSteps; ++step) {
    const Point out = memory.farthest(centre) - centre;
    const double radius = length(out);
    const Point moved = centre - ball.centre;
    const double value = area * radius + dot(vector, moved);
    if (value < least && length(moved) <= reach) {
      least = value;
      best.centre = centre;
    }
    const Point gradient = vector - (radius > 0 ? area / radius : 0) * out;
    const double slope = length(gradient);
    if (!(slope > 0)) break;
    centre = centre - (reach / (2 + step) / slope) * gradient;
  }
  return memory.around(best.centre);
}

}  // namespace medial_vk
