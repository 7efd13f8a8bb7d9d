// Smooth solids whose medial surfaces are known in closed form, and many meshes of each: coarse or fine, regular or
// not, with or without noise. For tests that results do not depend on the triangulation of a solid.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

/// A point of a smooth boundary and the outward unit normal there.
struct SurfacePoint {
  Eigen::Vector3d point, normal;
};

/// A point of a smooth medial surface. On a sheet it has two spokes: `spoke` and its mirror image in the plane with
/// normal `axis`, the tangent plane of the sheet. On a curve its spokes form a ring: `spoke` turned about `axis`, the
/// curve's tangent.
struct SmoothMedialPoint {
  Eigen::Vector3d point;
  double radius;
  Eigen::Vector3d spoke, axis;
  bool on_curve;

  /// Half of the largest angle between two spokes, radians.
  double object_angle() const;
};

/// A solid about the origin.
class SmoothSolid {
 public:
  virtual ~SmoothSolid() = default;

  /// Evenly cut, all vertices on the surface, about `triangles` faces.
  virtual Mesh mesh(std::uint32_t triangles) const = 0;
  /// The boundary point nearest to p, which lies closer to the boundary than to the medial surface.
  virtual SurfacePoint nearest(const Eigen::Vector3d& p) const = 0;
  /// Points of the medial surface, neighbours at most `spacing` apart on a curve, or along each axis of a sheet.
  virtual std::vector<SmoothMedialPoint> medial_points(double spacing) const = 0;
  /// Exact, to medial points of any object angle.
  virtual double distance_to_medial_surface(const Eigen::Vector3d& p) const = 0;
};

/// Axis z. The medial surface is the central circle, object angle pi/2.
std::unique_ptr<SmoothSolid> smooth_torus(double major, double minor);
/// The union of balls centred on a segment of the z axis, from z = -length/2 with radius `low` to length/2 with `high`.
/// Between them the radius follows half a wave of the cosine, so that it is stationary at both ends. Equal radii: a
/// cylinder capped by half spheres; else a pear. The medial surface is the segment.
std::unique_ptr<SmoothSolid> smooth_pear(double low, double high, double length);
/// Semi-axes a >= b >= c along x, y and z, a > c. With b > c the medial surface is a sheet, the part of the plane z = 0
/// in the ellipse of semi-axes a - c^2/a and b - c^2/b; with b = c it is a segment of the x axis.
std::unique_ptr<SmoothSolid> smooth_ellipsoid(double a, double b, double c);

/// Moves every vertex along the surface by up to 0.3 of its shortest edge and turns over the diagonals of some pairs of
/// triangles. Closed and oriented as before.
void make_irregular(const SmoothSolid& solid, Mesh& mesh, std::uint64_t seed);
/// Moves every vertex by `length` in a random direction.
void add_noise(Mesh& mesh, double length, std::uint64_t seed);

/// The longest side of the bounding box.
double longest_side(const Mesh& mesh);
/// Largest distance from the solid's surface to corners, middles of edges and centroids of the mesh.
double deviation(const SmoothSolid& solid, const Mesh& mesh);
/// Largest angle between the normal of a face and the solid's normal at one of its corners, radians.
double normal_deviation(const SmoothSolid& solid, const Mesh& mesh);

}  // namespace medial_vk::test
