// The spoke tips of medial balls on the triangles of a mesh, and paths along the mesh to them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "base/loop_watch.h"
#include "medial_vk/curvature.h"
#include "medial_vk/indexed_mesh.h"

namespace medial_vk {

inline Eigen::Vector3d to_eigen(const Point& p) { return {p[0], p[1], p[2]}; }
inline Point to_point(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

/// A tip at which both curvatures are known.
struct SurfaceTip {
  Point position;  ///< On the mesh.
  Ball sphere;     ///< The ball itself.
  Eigen::Vector3d normal;
  Eigen::Matrix3d shape;  ///< The shape operator in space; 0 along the normal.
  double error = 0;       ///< Of the curvatures; 0 if there is no estimate.
  std::uint32_t ball = 0;
  std::uint8_t side = 0;
};

/// The shape operator of a tip, in space.
Eigen::Matrix3d shape_of(const TipCurvature& tip);

/// Lists of indices by another index.
class IndexLists {
 public:
  IndexLists() = default;
  /// One entry for each pair (of, index), in the order of the pairs.
  template <class Pairs>
  IndexLists(std::size_t count, const Pairs& pairs) : starts_(count + 1), indices_(pairs.size()) {
    for (const auto& pair : pairs) ++starts_[pair.first + 1];
    for (std::size_t i = 0; i < count; ++i) starts_[i + 1] += starts_[i];
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for (const auto& pair : pairs) indices_[next[pair.first]++] = pair.second;
  }
  std::span<const std::uint32_t> operator[](std::size_t i) const {
    return {indices_.data() + starts_[i], starts_[i + 1] - starts_[i]};
  }

 private:
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> indices_;
};

class SurfaceTips {
 public:
  /// Tips that are not known, and those without a part of the mesh beside them that faces the same way, are left out.
  /// Throws LoopStopped.
  SurfaceTips(const IndexedMesh& mesh, std::span<const Ball> balls, const BoundaryCurvature& curvature,
              unsigned threads, LoopWatch& watch);

  const MeshView& mesh() const { return mesh_; }
  const std::vector<SurfaceTip>& tips() const { return tips_; }
  std::span<const std::uint32_t> of_triangle(std::size_t triangle) const { return by_triangle_[triangle]; }
  std::span<const std::uint32_t> triangles_at(std::size_t vertex) const { return by_vertex_[vertex]; }
  /// The mean of the normals of the triangles at a vertex, weighted by their angles; 0 where they cancel.
  const Point& normal(std::size_t vertex) const { return normals_[vertex]; }

 private:
  void find_normals();

  MeshView mesh_;
  std::vector<SurfaceTip> tips_;
  IndexLists by_triangle_, by_vertex_;
  std::vector<Point> normals_;
};

/// Walks from a vertex along the edges, and collects what it passes. Its memory is kept between walks.
class SurfaceWalk {
 public:
  explicit SurfaceWalk(const SurfaceTips& tips);

  /// Begins at a vertex. Tips beyond paths of the length `most` are not collected.
  void begin(std::uint32_t vertex, double most);
  /// Goes on along all paths up to this length.
  void go_to(double path);
  /// Goes on until so many tips are found.
  void find_tips(std::size_t count);
  /// Goes on until so many vertices are passed.
  void find_vertices(std::size_t count);

  bool has_seen(std::uint32_t tip) const { return seen_[tip] == walk_; }
  const std::vector<std::uint32_t>& tips() const { return tips_; }
  const std::vector<std::uint32_t>& vertices() const { return vertices_; }  ///< The nearest first.

 private:
  struct Front {
    double path;
    std::uint32_t vertex;
    bool operator>(const Front& other) const { return path != other.path ? path > other.path : vertex > other.vertex; }
  };

  /// Passes the next vertex, if its path is at most `limit`; whether it did.
  bool step(double limit);
  void visit(const Front& at);

  const SurfaceTips& surface_;
  std::uint32_t walk_ = 0;
  double most_ = 0;
  std::vector<std::uint32_t> settled_, seen_;  // by vertex, by tip: the number of the walk
  std::vector<std::uint32_t> tips_, vertices_;
  std::vector<Front> front_;
};

}  // namespace medial_vk
