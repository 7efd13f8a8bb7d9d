#include "sheets/grow_pieces.h"

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

std::vector<std::uint32_t> grow_pieces(const VoxelGraph& graph, double object_angle, const SheetOptions& options) {
  const LinkTest linked(object_angle, options);
  ConcurrentSets sets(graph.size());
  parallel_for(graph.size(), 1024, options.threads, [&](std::size_t i) {
    const auto place = static_cast<std::uint32_t>(i);
    for (const std::uint32_t other : graph.neighbours(place)) {
      if (other > place && linked(graph.sphere(place), graph.sphere(other))) sets.join(place, other);
    }
  });
  std::vector<std::uint32_t> piece_of(graph.size());
  std::uint32_t pieces = 0;
  for (std::uint32_t place = 0; place < graph.size(); ++place) {
    const std::uint32_t root = sets.root(place);  // never above `place`
    piece_of[place] = root == place ? pieces++ : piece_of[root];
  }
  return piece_of;
}

}  // namespace medial_vk
