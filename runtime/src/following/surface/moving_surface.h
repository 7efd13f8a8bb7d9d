// The boundary of a solid in the present and in the last frame.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "bvh/wide_tree.h"
#include "following/surface/surface_point.h"
#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "mesh/mesh_topology.h"
#include "solid/solid.h"

namespace medial_vk {

/// Queries may come from several threads at once.
class MovingSurface {
 public:
  /// The least longest side, and the greatest coordinate. Products of three lengths neither overflow nor lose digits,
  /// so that the bounds of rounding hold.
  static constexpr double kLeastSide = 1e-60, kGreatestCoordinate = 1e60;

  /// Whether contains() and holds() are called. Without them, frames of meshes that are not closed take less time.
  enum class Sides : std::uint8_t { kNeeded, kUnneeded };

  /// Throws std::bad_alloc. Errors: kInvalidMesh (as move()), kOutOfMemory.
  static Result<MovingSurface> build(const IndexedMesh& rest, Sides sides = Sides::kNeeded);

  /// The next frame. Errors: kInvalidMesh (another number of vertices, a coordinate that is not finite, a size beyond
  /// kLeastSide and kGreatestCoordinate; the surface is unchanged), kOutOfMemory.
  Status move(std::span<const Point> vertices, unsigned threads);
  /// Makes the rest pose the present frame, and the last one, too.
  Status return_to_rest(unsigned threads);

  std::span<const Point> vertices() const { return vertices_; }
  std::span<const Triangle> triangles() const { return rest_.view().triangles; }
  Corners3 corners(std::uint32_t triangle) const { return corners_of(vertices_, triangle); }
  Point at(const SurfacePoint& point) const { return point_at(point, corners(point.triangle)); }
  Point at_rest(const SurfacePoint& point) const {
    return point_at(point, corners_of(rest_.view().vertices, point.triangle));
  }
  SurfacePoint surface_point(const BvhHit& hit) const {
    return surface_point_at(hit.point, hit.triangle, corners(hit.triangle));
  }
  /// The direction in the last frame at a point, in the present one. On an edge or at a vertex all triangles around
  /// with an area carry it, and the mean counts: which of them holds the point is a matter of rounding.
  Point carried(const Point& direction, const SurfacePoint& at) const {
    return carried_by_all(direction, at, last_vertices_, last_front_);
  }
  /// The same from the rest pose.
  Point carried_from_rest(const Point& direction, const SurfacePoint& at) const {
    return carried_by_all(direction, at, rest_.view().vertices, rest_front_);
  }
  Point inward_normal(std::uint32_t triangle) const { return inward_normal_of(corners(triangle), front_); }
  /// 1 if triangles are counter-clockwise seen from outside, -1 if the frame of a closed mesh is mirrored: its signed
  /// volume is negative.
  double front() const { return front_; }

  /// The nearest point of the boundary, if it is closer than `bound`.
  BvhHit closest(const Point& p, double bound) const { return wide_.closest(bvh_, p, bound); }
  /// The leaf positions of all triangles within `radius` of p, and of few beyond, for closest_of(); none where they are
  /// too many.
  std::optional<std::span<const std::uint32_t>> gather(const Point& p, double radius,
                                                       std::span<std::uint32_t> room) const {
    const std::optional<std::size_t> count = wide_.gather(p, radius, room);
    return count ? std::optional<std::span<const std::uint32_t>>(room.first(*count)) : std::nullopt;
  }
  /// As closest(), among these triangles.
  BvhHit closest_of(std::span<const std::uint32_t> positions, const Point& p, double bound) const;
  /// The nearest points of all triangles that are not farther than `radius`. Throws std::bad_alloc.
  std::vector<BvhHit> within(const Point& p, double radius) const;
  /// The error of a distance at a point within one longest side of the box.
  double rounding() const { return rounding_; }
  double longest_side() const { return longest_side_; }
  /// Of the rest pose.
  double rest_side() const { return rest_.longest_side(); }
  /// The volume by the triangles, positive in a mirrored frame, too, if it can be that of the solid, of which at least
  /// `least` and at most `most` is proved; otherwise NaN: the mesh is not closed, the volume is no more than rounding,
  /// or parts with winding numbers of both signs, or of more than 1, count in it.
  double solid_volume(double least, double most) const;

  bool is_closed() const { return rest_.prepared().report.closed; }
  /// True if the winding number at a point off the boundary is at least 1/2 (at most -1/2, in a mirrored frame of a
  /// closed mesh).
  bool contains(const Point& p) const;
  /// True if the ball, which the boundary does not meet, is known to lie inside.
  bool holds(const Ball& ball) const;
  /// True if no point of the boundary of a closed mesh is known to be closer than `distance`, at least rounding(), and
  /// the winding number is known to be 0.
  bool is_known_outside(const Point& p, double distance) const;

 private:
  MovingSurface(const IndexedMesh& rest, Bvh bvh, Sides sides);
  Corners3 corners_of(std::span<const Point> vertices, std::uint32_t triangle) const {
    const Triangle& t = rest_.view().triangles[triangle];
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
  }
  Point carried_by_all(const Point& direction, const SurfacePoint& at, std::span<const Point> from,
                       double from_front) const;
  Status measure(unsigned threads);
  /// An upper bound of the rounding error of volume_.
  double volume_rounding() const;

  IndexedMesh rest_;
  VertexTriangles around_;
  Sides sides_;
  std::vector<Point> vertices_, last_vertices_;
  Bvh bvh_;
  WideTree wide_;
  double front_ = 1, last_front_ = 1, rest_front_ = 1;
  double rounding_ = 0, longest_side_ = 0, volume_ = 0;
  std::optional<Solid> open_solid_;  // of a mesh that is not closed
};

}  // namespace medial_vk
