// Batches of scattered queries of one mesh on the device, answered by walks of its BVH.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/mesh_view.h"
#include "medial_vk/result.h"

namespace medial_vk {

class Context;

/// The nearest part of a triangle.
enum class Feature : std::uint32_t { kFace = 0, kEdge = 1, kVertex = 2 };

struct ClosestPoint {
  /// Nearest point of the mesh, in mesh units, to float accuracy relative to the longest side.
  Point point;
  double distance = 0;         ///< |query - point|.
  std::uint32_t triangle = 0;  ///< Index into MeshView::triangles; the smallest among exact ties in float.
  Feature feature = Feature::kFace;
};

struct FluxSample {
  double flux = 0;               ///< Average outward flux (equation 2.4), two-sided fans left out (Definition 2.4).
  double greatest_distance = 0;  ///< Largest distance from a sampled point to the boundary (2.4.2).
  std::uint32_t fans = 0;        ///< Samples left out.
};

/// A mesh on the device, in float, scaled to the unit box. Queries may lie anywhere; outside of the mesh's box the
/// accuracy is that of a float of the size of their distance from it. Errors of every query: kUsage (a coordinate that
/// is not finite, or further away than 1e15 box sizes), kOutOfMemory, kInternal (device lost).
class Scene {
 public:
  /// Uploads the mesh. Errors: kInvalidMesh (no extent), kOutOfMemory.
  static Result<Scene> create(Context& context, const IndexedMesh& mesh);
  /// Follows vertices that have moved; `moved` is the mesh passed to create(), after move_vertices(). Errors: kUsage
  /// (another mesh, detected by the order of its tree and the number of vertices: the scene is unchanged), kInvalidMesh
  /// (no extent: the scene is unusable until an update succeeds), kOutOfMemory (likewise).
  Status update(const IndexedMesh& moved);
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  /// Closest points, for points in any order; batches of some thousands or more are sorted in space, and neighbours
  /// share their walks.
  Result<std::vector<ClosestPoint>> closest_points(std::span<const Point> points);
  /// The same into `out`, which a caller with many batches can reuse, since new memory costs time. Additional error:
  /// kUsage, if the size of `out` differs from the number of points. After an error the content of `out` is undefined.
  Status closest_points(std::span<const Point> points, std::span<ClosestPoint> out);
  /// The same for groups of `group_size` consecutive points that lie near each other compared with the distance between
  /// groups: samples of spheres, for example, with the centre among them. A group shares one walk. It is fastest with
  /// up to 51 points per group, and if all groups arrange their points alike. Additional error: kUsage, if the number
  /// of points is no multiple of `group_size`, or if `group_size` is 0 or above 262,144.
  Result<std::vector<ClosestPoint>> closest_points_of_groups(std::span<const Point> points, std::uint32_t group_size);
  Status closest_points_of_groups(std::span<const Point> points, std::uint32_t group_size, std::span<ClosestPoint> out);
  /// For each ball: 1 if the open ball holds no point of the mesh, else 0.
  Result<std::vector<std::uint8_t>> empty_balls(std::span<const Ball> balls);
  /// Generalised winding numbers (Jacobson et al. 2013) up to `tolerance`; of the outside (on_side()), 1 less those.
  Result<std::vector<double>> winding_numbers(std::span<const Point> points, double tolerance = 0.05);
  /// Average outward flux of the distance gradient through each ball's sphere, `samples` spiral points each, 1 to
  /// 60,000.
  Result<std::vector<FluxSample>> fluxes(std::span<const Ball> spheres, std::uint32_t samples);

 private:
  friend struct Internals;
  class Impl;
  explicit Scene(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
