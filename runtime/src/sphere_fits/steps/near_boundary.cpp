#include "sphere_fits/steps/near_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <new>
#include <stdexcept>

#include "base/point_ops.h"
#include "sphere_fits/quality/branch_and_bound.h"
#include "sphere_fits/quality/envelope.h"
#include "sphere_fits/quality/surface_samples.h"
#include "sphere_fits/quality/triangle_part.h"

namespace medial_vk {
namespace {

/// The depth of points that are treated as too deep, as a share of the allowed one: the division of the boundary ends,
/// as a part of size (1 - kNearly) of that is settled in either case.
constexpr double kNearly = 15.0 / 16;
/// How far from a point another one may be exposed for its sake, as a share of the allowed depth.
constexpr double kFarthest = 14.0 / 16;

/// Of radii, so that an exposed point is in no ball for any rounding of distances.
constexpr double kRoom = 1 - 1e-12;

/// A point of the boundary that is deeper in the union than it may be.
struct Buried {
  Point at;
  double depth;
};

class BuriedPoints {
 public:
  /// Depths of up to `most` are allowed.
  BuriedPoints(const Envelope& envelope, double most, const Threads& threads)
      : envelope_(envelope), most_(most), threads_(threads) {}

  /// Appends points of this part of the boundary such that each of its points is within `most` of one of them, or not
  /// deeper than `most`.
  void find(const TrianglePart& part, std::vector<Buried>& found) const {
    threads_.check();
    const Point middle = part.middle();
    const double reach = part.reach(middle), enough = most_ - reach;
    const double outside = envelope_.tree().nearest(middle).distance;
    if (outside >= 0 && reach - outside <= most_) return;  // No point of the part is deeper than that.
    const double depth = outside >= 0 ? 0 : depth_of(middle, part.normal(), std::max(0.0, enough));
    if (depth <= enough) return;
    if (depth > kNearly * most_) found.push_back({middle, depth});
    if (depth > kNearly * most_ && reach <= most_) return;
    std::vector<TrianglePart> parts;
    split_part(part, parts);
    for (const TrianglePart& each : parts) find(each, found);
  }

 private:
  /// Any number up to `enough`, if the depth is no greater than that.
  double depth_of(const Point& at, const Point& normal, double enough) const {
    const double outward = envelope_.distance_along(at, normal, enough);
    return outward <= enough ? outward : envelope_.distance(at, enough);
  }

  const Envelope& envelope_;
  double most_;
  const Threads& threads_;
};

/// Of a size at which threads can share them.
std::vector<TrianglePart> parts_of_boundary(const Mesh& mesh, double most) {
  constexpr std::size_t kEnough = 4096;
  std::vector<TrianglePart> parts, next;
  parts.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    parts.push_back({{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}});
  for (bool is_divided = true; is_divided && parts.size() < kEnough;) {
    is_divided = false;
    next.clear();
    for (const TrianglePart& part : parts) {
      const bool is_large = part.reach(part.middle()) > 2 * most;
      is_divided |= is_large;
      is_large ? split_part(part, next) : next.push_back(part);
    }
    parts.swap(next);
  }
  return parts;
}

/// The deepest first.
std::vector<Buried> find_buried(const Solid& solid, const Envelope& envelope, double most, const Threads& threads) {
  const std::vector<TrianglePart> parts = parts_of_boundary(solid.mesh().mesh, most);
  const BuriedPoints points(envelope, most, threads);
  std::vector<std::vector<Buried>> by_part(parts.size());
  for_all(parts.size(), 4, threads, [&](std::size_t i) { points.find(parts[i], by_part[i]); });
  std::vector<Buried> all;
  for (const std::vector<Buried>& some : by_part) all.insert(all.end(), some.begin(), some.end());
  std::stable_sort(all.begin(), all.end(), [](const Buried& a, const Buried& b) { return a.depth > b.depth; });
  return all;
}

/// About the volume that balls lose if they shrink until the point is in none.
double cost_of_exposure(const Point& point, std::span<const Ball> balls) {
  double cost = 0;
  for (const Ball& ball : balls) {
    const double depth = ball.radius - length(point - ball.centre);
    if (depth > 0) cost += depth * ball.radius * ball.radius;
  }
  return cost;
}

}  // namespace

/// Of points near to this one and outside the solid, that which costs least to expose.
Point NearBoundary::cheapest_around(const Point& deep, std::span<const Ball> balls) const {
  constexpr std::size_t kPoints = 64;
  std::vector<Ball> near;
  for (const Ball& ball : balls) {
    if (length(deep - ball.centre) < ball.radius + most_) near.push_back(ball);
  }
  Point best = deep;
  double least = cost_of_exposure(deep, near);
  for (const double away : {0.25, 0.5, kFarthest}) {
    for (std::size_t k = 0; k < kPoints; ++k) {
      const Point at = deep + away * most_ * spiral_point(k, kPoints);
      const double cost = cost_of_exposure(at, near);
      if (cost < least && !solid_.contains(at)) least = cost, best = at;
    }
  }
  return best;
}

/// The balls that hold the point shrink until it lies on their spheres. Returns whether any did.
bool NearBoundary::expose(const Point& deep, std::vector<Ball>& balls) {
  const Point point = cheapest_around(deep, balls);
  bool shrinks = false;
  for (Ball& ball : balls) {
    const double radius = kRoom * length(point - ball.centre);
    if (radius >= ball.radius) continue;
    ball.radius = radius;
    shrinks = true;
  }
  exposed_.push_back(point);
  return shrinks;
}

double NearBoundary::greatest_radius(const Point& centre) const {
  const double distance = solid_.distance(centre);
  double radius = kReachShare * most_ - solid_.rounding() + (solid_.contains(centre) ? distance : -distance);
  for (const Point& point : exposed_) radius = std::min(radius, kRoom * length(point - centre));
  return radius;
}

/// An exposed point remains exposed, as balls only shrink, so no point within `most` of it is too deep any more. A
/// point that still is lies farther from it than kNearly `most`; in the same round, than `most`, since others are
/// passed over. The point that is exposed for its sake is no nearer than (kNearly - kFarthest) `most`, so the number of
/// exposed points is finite.
std::vector<Ball> NearBoundary::keep(std::span<const Ball> balls, const Threads& threads) {
  std::vector<Ball> kept(balls.begin(), balls.end());
  for_all(kept.size(), 16, threads, [&](std::size_t i) {
    if (kept[i].radius > solid_.distance(kept[i].centre) || !solid_.contains(kept[i].centre))
      kept[i].radius = std::max(0.0, std::min(kept[i].radius, greatest_radius(kept[i].centre)));
  });
  for (;;) {
    std::vector<Ball> held;
    std::copy_if(kept.begin(), kept.end(), std::back_inserter(held), [](const Ball& ball) { return ball.radius > 0; });
    if (held.empty()) return kept;
    const Result<Envelope> envelope = Envelope::build(held, threads.count);
    if (!envelope) throw std::bad_alloc();  // The balls are finite, so the error is one of memory.
    const std::vector<Buried> buried = find_buried(solid_, envelope.value(), most_, threads);
    if (buried.empty()) return kept;
    const std::size_t known = exposed_.size();
    bool shrinks = false;
    for (const Buried& each : buried) {
      const bool is_settled = std::any_of(exposed_.begin() + static_cast<std::ptrdiff_t>(known), exposed_.end(),
                                          [&](const Point& p) { return length(p - each.at) <= most_; });
      if (!is_settled) shrinks |= expose(each.at, kept);
    }
    // Only if depths have errors of some hundredths of the bound.
    if (!shrinks) throw std::runtime_error("the depth of the boundary in the balls is too inexact for the bound");
  }
}

}  // namespace medial_vk
