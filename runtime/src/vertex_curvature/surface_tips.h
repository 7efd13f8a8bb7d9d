// The spoke tips of medial balls on the triangles of a mesh, and paths along the mesh to them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "base/loop_watch.h"
#include "medial_vk/curvature.h"
#include "medial_vk/indexed_mesh.h"
#include "vertex_curvature/index_lists.h"
#include "vertex_curvature/surface_graph.h"

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

class SurfaceTips {
 public:
  /// Tips that are not known, and those without a part of the mesh beside them that faces the same way, are left out.
  /// Throws LoopStopped.
  SurfaceTips(const IndexedMesh& mesh, std::span<const Ball> balls, const BoundaryCurvature& curvature,
              unsigned threads, LoopWatch& watch);

  const MeshView& mesh() const { return mesh_; }
  const std::vector<SurfaceTip>& tips() const { return tips_; }
  /// Paths whose nodes are as far apart as balls, or farther.
  const SurfaceGraph& graph() const { return graph_; }
  const Point& place(std::uint32_t node) const { return mesh_.vertices[graph_.vertex(node)]; }
  /// Tips on the triangles at the vertices that a node stands for.
  std::span<const std::uint32_t> of_node(std::uint32_t node) const { return by_node_[node]; }
  std::span<const std::uint32_t> triangles_at(std::size_t vertex) const { return by_vertex_[vertex]; }
  /// The mean of the normals of the triangles at a vertex, weighted by their angles; 0 where they cancel.
  const Point& normal(std::size_t vertex) const { return normals_[vertex]; }

 private:
  void find_normals();

  MeshView mesh_;
  std::vector<SurfaceTip> tips_;
  IndexLists by_node_, by_vertex_;
  SurfaceGraph graph_;
  std::vector<Point> normals_;
};

/// Walks from a vertex along the links of the graph, and collects what it passes. Its memory is kept between walks.
class SurfaceWalk {
 public:
  explicit SurfaceWalk(const SurfaceTips& tips);

  /// Begins at a vertex. Tips beyond paths of the length `most` are not collected.
  void begin(std::uint32_t vertex, double most);
  /// Goes on along all paths up to this length.
  void go_to(double path);
  /// Goes on until so many tips are found.
  void find_tips(std::size_t count);
  /// Goes on until so many nodes are passed.
  void find_nodes(std::size_t count);

  bool has_seen(std::uint32_t tip) const { return seen_[tip] == walk_; }
  const std::vector<std::uint32_t>& tips() const { return tips_; }
  const std::vector<std::uint32_t>& nodes() const { return nodes_; }  ///< The nearest first.

 private:
  struct Front {
    double path;
    std::uint32_t node;
    bool operator>(const Front& other) const { return path != other.path ? path > other.path : node > other.node; }
  };

  /// Passes the next node, if its path is at most `limit`; whether it did.
  bool step(double limit);
  void visit(const Front& at);

  const SurfaceTips& surface_;
  std::uint32_t walk_ = 0;
  double most_ = 0;
  std::vector<std::uint32_t> settled_, seen_;  // by node, by tip: the number of the walk
  std::vector<std::uint32_t> tips_, nodes_;
  std::vector<Front> front_;
};

}  // namespace medial_vk
