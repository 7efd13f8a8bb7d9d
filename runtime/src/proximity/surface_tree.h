// A tree over the triangles of a solid.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "proximity/boxes/boxes.h"
#include "proximity/node_tree.h"
#include "proximity/triangle_pair.h"
#include "solid/solid.h"

namespace medial_vk {

/// Balls that hold triangles, and reach out of the solid as little as possible. Let a ball with the centre c and the
/// radius r hold some triangles, and let d be the distance of c from the boundary, with c inside. A point p outside is
/// then at least at |p - c| - r >= (distance of p from the solid) - (r - d) from the ball, since the way from c to p
/// leaves the solid no sooner than after d: the search opens no ball that is farther away than the solid by more than
/// its excess r - d. The inner ball of the radius d also bounds the distance of the solids from above. A ball around
/// the middle of a flat patch of the radius w has the excess w; one whose centre is at the depth h below it, where the
/// solid is thick enough, has sqrt(h^2 + w^2) - h < w^2 / 2h.
class SurfaceTree {
 public:
  /// Corner c of eight triangles, relative to the centre: [c][axis].
  using EightTriangles = std::array<std::array<std::array<float, BodyNode::kWidth>, 3>, 3>;

  /// Keeps a reference to the solid. Balls are relative to `centre`. Throws std::bad_alloc, LoopStopped.
  static SurfaceTree build(const Solid& solid, const Point& centre, unsigned threads, LoopWatch& watch);

  const NodeTree& nodes() const { return nodes_; }
  std::size_t size() const { return mesh_->triangles.size(); }
  /// The triangles of a node of the lowest level; those of unused slots are the first one.
  const EightTriangles& triangles(std::uint32_t node) const { return triangles_[place_[node]]; }
  /// Of every other node: boxes that hold what its balls hold.
  const EightBoxes& boxes(std::uint32_t node) const { return boxes_[place_[node]]; }
  Corners corners(std::uint32_t triangle) const {
    const Triangle& t = mesh_->triangles[triangle];
    return {mesh_->vertices[t[0]], mesh_->vertices[t[1]], mesh_->vertices[t[2]]};
  }

 private:
  explicit SurfaceTree(const Mesh& mesh) : mesh_(&mesh) {}
  void find_places();
  void collect_triangles(const Point& centre);
  void collect_boxes(const Point& centre, unsigned threads, LoopWatch& watch);
  void add_triangles_below(const BodyNode& node, std::uint32_t slot, std::vector<std::uint32_t>& triangles) const;
  FloatBox box_of(std::span<const std::uint32_t> triangles, const Point& centre) const;

  const Mesh* mesh_;
  NodeTree nodes_;
  std::vector<std::uint32_t> place_;  // by node, in one of these:
  std::vector<EightTriangles> triangles_;
  std::vector<EightBoxes> boxes_;
};

}  // namespace medial_vk
