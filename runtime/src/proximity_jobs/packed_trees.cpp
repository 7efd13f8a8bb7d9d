#include "proximity_jobs/packed_trees.h"

#include "proximity/body.h"

namespace medial_vk {
namespace {

static_assert(BodyNode::kWidth == gpu::kProximityWidth);
static_assert(node_levels(kMostBodyBalls) <= gpu::kProximityLevels);

/// `first` is the index of the tree's first node among all.
gpu::ProximityNode packed_node(const BodyNode& node, std::uint32_t first) {
  gpu::ProximityNode packed{};
  for (std::size_t k = 0; k < BodyNode::kWidth; ++k) {
    packed.balls[k] = {node.centre[0][k], node.centre[1][k], node.centre[2][k], node.radius[k]};
    packed.below[k] = node.below[k] + (node.is_lowest || k >= node.count ? 0 : first);
  }
  return packed;
}

gpu::ProximityTree add_tree(const NodeTree& tree, std::vector<gpu::ProximityNode>& nodes) {
  const auto first = static_cast<std::uint32_t>(nodes.size());
  for (std::uint32_t i = 0; i < tree.size(); ++i) nodes.push_back(packed_node(tree.node(i), first));
  return {first, static_cast<std::uint32_t>(tree.levels()), rounded_up(tree.reach()), 0};
}

}  // namespace

PackedTrees::PackedTrees(std::span<const Body> of_bodies) {
  bodies.reserve(of_bodies.size());
  for (const Body& body : of_bodies) {
    const BodyImpl& impl = Internals::of(body);
    const FloatBall centre = float_ball_at(impl.centre);
    gpu::ProximityBody& packed = bodies.emplace_back();
    packed.inside = add_tree(impl.inside_tree.nodes(), nodes);
    packed.cover = add_tree(impl.cover_tree.nodes(), nodes);
    packed.centre = {centre.centre[0], centre.centre[1], centre.centre[2], 0};
  }
}

}  // namespace medial_vk
