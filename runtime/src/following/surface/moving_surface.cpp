#include "following/surface/moving_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bvh/nearby_triangles.h"
#include "bvh/refined_tree.h"
#include "indexed_mesh/bounded_mesh.h"
#include "mesh/winding/winding_number.h"
#include "solid/number_by_rays.h"

namespace medial_vk {
namespace {

double longest_side_of(const BvhBox& box) {
  const Point sides = box.upper - box.lower;
  return std::max({sides[0], sides[1], sides[2]});
}

Status check_size(const BvhBox& box) {
  double greatest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    greatest = std::max({greatest, std::fabs(box.lower[k]), std::fabs(box.upper[k])});
  }
  if (longest_side_of(box) >= MovingSurface::kLeastSide && greatest <= MovingSurface::kGreatestCoordinate) return {};
  return Error{ErrorCode::kInvalidMesh,
               "the longest side of a mesh that moves must be at least 1e-60, and its coordinates at most 1e60"};
}

/// Of the cones from a point near the middle of the box to all triangles, which keeps rounding small.
double signed_volume(std::span<const Point> vertices, std::span<const Triangle> triangles, const BvhBox& box) {
  const Point middle = 0.5 * (box.lower + box.upper);
  CompensatedSum sum;
  for (const Triangle& t : triangles) {
    sum.add(dot(vertices[t[0]] - middle, cross(vertices[t[1]] - middle, vertices[t[2]] - middle)));
  }
  return sum.value() / 6;
}

/// The ends of the edge that holds the point, or its vertex twice.
std::array<std::uint32_t, 2> side_of(const SurfacePoint& point, const Triangle& triangle) {
  const std::array shares = point.shares();
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return shares[a] > shares[b]; });
  const bool is_vertex = shares[order[1]] <= SurfacePoint::kOnSide;
  return {triangle[order[0]], triangle[order[is_vertex ? 0 : 1]]};
}

Point magnitudes(const Point& p) { return {std::fabs(p[0]), std::fabs(p[1]), std::fabs(p[2])}; }

}  // namespace

MovingSurface::MovingSurface(const IndexedMesh& rest, Bvh bvh, Sides sides)
    : rest_(rest),
      around_(rest.prepared().mesh),
      sides_(sides),
      vertices_(rest.view().vertices.begin(), rest.view().vertices.end()),
      last_vertices_(vertices_),
      bvh_(std::move(bvh)),
      wide_(bvh_, WideTree::Bounds::kBoxes) {}

Result<MovingSurface> MovingSurface::build(const IndexedMesh& rest, Sides sides) {
  constexpr std::uint32_t kLeafSize = 4;
  if (Status status = check_bounded(rest); !status) return status.error();
  Result<Bvh> bvh = refined_tree(rest.bvh(), kLeafSize);
  if (!bvh) return bvh.error();
  MovingSurface surface(rest, std::move(bvh).value(), sides);
  if (Status status = check_size(surface.bvh_.nodes().front().box); !status) return status.error();
  if (Status status = surface.measure(1); !status) return status.error();
  surface.last_front_ = surface.rest_front_ = surface.front_;
  return surface;
}

Status MovingSurface::move(std::span<const Point> vertices, unsigned threads) {
  if (vertices.size() != vertices_.size()) {
    return Error{ErrorCode::kInvalidMesh, "the frame has " + std::to_string(vertices.size()) +
                                              " vertices, the mesh has " + std::to_string(vertices_.size())};
  }
  const MeshView moved = {vertices, triangles(), {}, is_closed()};
  if (Status status = bvh_.refit(moved, {threads}); !status) return status;
  if (Status size = check_size(bvh_.nodes().front().box); !size) {
    const MeshView present = {vertices_, triangles(), {}, is_closed()};
    if (Status status = bvh_.refit(present, {threads}); !status) return status;
    return size;
  }
  std::swap(vertices_, last_vertices_);
  std::ranges::copy(vertices, vertices_.begin());
  last_front_ = front_;
  return measure(threads);
}

Status MovingSurface::return_to_rest(unsigned threads) {
  if (Status status = move(rest_.view().vertices, threads); !status) return status;
  last_vertices_ = vertices_;
  last_front_ = front_;
  return {};
}

Point MovingSurface::carried_by_all(const Point& direction, const SurfacePoint& at, std::span<const Point> from,
                                    double from_front) const {
  const auto image_by = [&](std::uint32_t triangle) {
    return carried_direction(direction, corners_of(from, triangle), from_front, corners(triangle), front_);
  };
  if (at.is_within_face()) return image_by(at.triangle).value_or(direction);
  const auto [first, second] = side_of(at, triangles()[at.triangle]);
  Point sum = {0, 0, 0};
  for (const std::uint32_t t : around_.of(first)) {
    const Triangle& triangle = triangles()[t];
    if (std::ranges::find(triangle, second) == triangle.end()) continue;
    if (const auto image = image_by(t)) sum = sum + *image;
  }
  const double size = length(sum);
  return size > 0 ? (1 / size) * sum : image_by(at.triangle).value_or(direction);
}

Status MovingSurface::measure(unsigned threads) {
  const BvhBox& box = bvh_.nodes().front().box;
  wide_.refit(bvh_);
  rounding_ = distance_rounding(bvh_);
  longest_side_ = longest_side_of(box);
  const double volume = signed_volume(vertices_, triangles(), box);
  front_ = is_closed() && volume < 0 ? -1 : 1;
  volume_ = std::fabs(volume);
  if (is_closed() || sides_ == Sides::kUnneeded) return {};
  IndexedMesh moved = rest_;
  if (Status status = moved.move_vertices(vertices_, {{}, threads}); !status) return status;
  Result<Solid> solid = Solid::build(moved);
  if (!solid) return solid.error();
  open_solid_.emplace(std::move(solid).value());
  return {};
}

BvhHit MovingSurface::closest_of(std::span<const std::uint32_t> positions, const Point& p, double bound) const {
  BvhHit best;
  best.squared_distance = bound > 0 ? bound * bound : 0.0;
  best = medial_vk::closest_of(bvh_, p, positions, best);
  if (best.triangle == BvhHit().triangle) best.squared_distance = std::numeric_limits<double>::infinity();
  return best;
}

std::vector<BvhHit> MovingSurface::within(const Point& p, double radius) const {
  std::vector<std::uint32_t> positions;
  gather_within(bvh_, p, radius, positions);
  std::vector<BvhHit> hits;
  for (const std::uint32_t position : positions) {
    BvhHit hit;
    improve_hit(bvh_, p, position, hit);
    if (hit.squared_distance <= radius * radius) hits.push_back(hit);
  }
  return hits;
}

/// The volume of a closed surface is the same from each point, so the rounding of the middle does not matter. Each of
/// the six products of a cone has eight factors 1 + d with |d| at most the unit roundoff u: of three differences of
/// coordinates, of two products, and of the three sums that it is part of. Together they change it by less than 9 u of
/// itself; the compensated sum adds less than 2 u of all magnitudes, and the division u. Twice these 12 u are more than
/// the rounding of the sum below, too.
double MovingSurface::volume_rounding() const {
  constexpr double kUnitRoundoff = 0.5 * std::numeric_limits<double>::epsilon();
  const BvhBox& box = bvh_.nodes().front().box;
  const Point middle = 0.5 * (box.lower + box.upper);
  double sum = 0;
  for (const Triangle& t : triangles()) {
    const Point a = magnitudes(vertices_[t[0]] - middle);
    const Point b = magnitudes(vertices_[t[1]] - middle), c = magnitudes(vertices_[t[2]] - middle);
    sum += a[0] * (b[1] * c[2] + b[2] * c[1]) + a[1] * (b[2] * c[0] + b[0] * c[2]) + a[2] * (b[0] * c[1] + b[1] * c[0]);
  }
  return 24 * kUnitRoundoff * sum / 6;
}

double MovingSurface::solid_volume(double least, double most) const {
  const bool is_known = is_closed() && volume_ > volume_rounding() && volume_ >= least && volume_ <= most;
  return is_known ? volume_ : std::numeric_limits<double>::quiet_NaN();
}

bool MovingSurface::contains(const Point& p) const {
  if (!is_closed()) return open_solid_->contains(p);
  if (const auto number = number_by_rays({&bvh_}, p)) return front_ * static_cast<double>(*number) > 0;
  CompensatedSum number;
  for (const Corners3& triangle : bvh_.corners()) number.add(triangle_winding(triangle, p));
  return front_ * number.value() >= 0.5;
}

bool MovingSurface::holds(const Ball& ball) const {
  if (is_closed()) return contains(ball.centre);
  return open_solid_->side_around(ball.centre, ball.radius) == SolidSide::kInside;
}

bool MovingSurface::is_known_outside(const Point& p, double distance) const {
  const auto number = number_by_rays({&bvh_}, p);
  if (!number || *number != 0) return false;
  return !(closest(p, distance).squared_distance < distance * distance);
}

}  // namespace medial_vk
