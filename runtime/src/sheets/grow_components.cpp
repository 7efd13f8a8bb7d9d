#include "sheets/grow_components.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "sheets/concurrent_sets.h"
#include "sheets/spoke_turns.h"

namespace medial_vk {

LinkTest::LinkTest(double object_angle, const SheetOptions& options)
    : normals_(std::cos(options.angle * std::numbers::pi / 180)),
      crease_(options.crease > 0 ? std::cos(options.crease * std::numbers::pi / 180) : 2),
      salient_(options.crease > 0 ? std::cos(2 * object_angle) : -2) {}

bool LinkTest::operator()(const MedialSphere& p, const MedialSphere& q) const {
  const double turn = cosine_of_turn(p, q);
  return turn >= crease_ || (turn > salient_ && cosine_of_normals(p, q) >= normals_);
}

std::vector<std::uint32_t> grow_components(const VoxelGraph& graph, double object_angle, const SheetOptions& options) {
  const LinkTest linked(object_angle, options);
  ConcurrentSets sets(graph.size());
  parallel_for(graph.size(), 1024, options.threads, [&](std::size_t i) {
    const auto position = static_cast<std::uint32_t>(i);
    for (const std::uint32_t other : graph.neighbours(position)) {
      if (other > position && linked(graph.sphere(position), graph.sphere(other))) sets.join(position, other);
    }
  });
  std::vector<std::uint32_t> component_of(graph.size());
  std::uint32_t components = 0;
  for (std::uint32_t position = 0; position < graph.size(); ++position) {
    const std::uint32_t root = sets.root(position);  // never above `position`
    component_of[position] = root == position ? components++ : component_of[root];
  }
  return component_of;
}

}  // namespace medial_vk
