#include "simplification/simplify_spheres.h"

#include <array>
#include <cstddef>
#include <unordered_map>
#include <utility>

namespace medial_vk {
namespace {

using Voxel = std::array<std::uint32_t, 3>;

struct VoxelHash {
  // Grids have at most 2^13 voxels a side (4096 and a margin): 21 bits each never overlap.
  std::size_t operator()(const Voxel& v) const {
    const std::uint64_t key = (std::uint64_t{v[2]} << 42) | (std::uint64_t{v[1]} << 21) | v[0];
    return static_cast<std::size_t>(key * 0x9e3779b97f4a7c15ull);  // Fibonacci hashing spreads neighbours.
  }
};

/// Kept points by voxel: index into the spheres.
using KeptByVoxel = std::unordered_map<Voxel, std::size_t, VoxelHash>;

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

/// True if a kept point lies within epsilon in the 26 neighbours. Subtracting 1 from coordinate 0 wraps around to a
/// voxel that no grid has, so none is found there.
bool near_kept(const MedialSphere& sphere, const std::vector<MedialSphere>& spheres, const KeptByVoxel& kept,
               double squared_epsilon) {
  for (std::uint32_t neighbour = 0; neighbour < 27; ++neighbour) {
    const Voxel voxel = {sphere.voxel[0] + neighbour % 3 - 1, sphere.voxel[1] + neighbour / 3 % 3 - 1,
                         sphere.voxel[2] + neighbour / 9 - 1};
    const auto found = kept.find(voxel);
    if (found == kept.end()) continue;
    if (squared_distance(sphere.centre, spheres[found->second].centre) <= squared_epsilon) return true;
  }
  return false;
}

}  // namespace

std::uint64_t simplify_spheres(double epsilon, std::vector<MedialSphere>& spheres) {
  KeptByVoxel kept;
  kept.reserve(spheres.size());
  std::size_t end = 0;  // Kept spheres move to the front, in order.
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    if (near_kept(spheres[i], spheres, kept, epsilon * epsilon)) continue;
    if (end != i) spheres[end] = spheres[i];
    kept.emplace(spheres[end].voxel, end);
    ++end;
  }
  const std::uint64_t removed = spheres.size() - end;
  spheres.resize(end);
  return removed;
}

}  // namespace medial_vk
