#include "sheets/voxel_graph.h"

#include <algorithm>
#include <numeric>

#include "base/parallel.h"

namespace medial_vk {
namespace {

constexpr std::size_t kBlock = 4096;  // positions that one thread processes at a time
constexpr std::uint64_t kY = std::uint64_t{1} << 21;
constexpr std::uint64_t kZ = std::uint64_t{1} << 42;

/// Keys are of each coordinate plus one, so that a coordinate of -1 has a key of its own, too.
std::uint64_t key_of(const MedialSphere& sphere) {
  return (sphere.voxel[2] + 1) * kZ + (sphere.voxel[1] + 1) * kY + (sphere.voxel[0] + 1);
}

/// Visits positions in order with one cursor for each of the nine rows of three voxels around a voxel: as keys ascend,
/// cursors never go back, so that a pass takes linear time.
class NeighbourWalk {
 public:
  NeighbourWalk(std::span<const std::uint64_t> keys, std::size_t first) : keys_(keys) {
    for (std::size_t row = 0; row < 9; ++row) {
      const std::uint64_t least = keys[first] + offset(row) - 1;
      cursors_[row] = static_cast<std::size_t>(std::lower_bound(keys.begin(), keys.end(), least) - keys.begin());
    }
  }

  /// Positions must be passed in ascending order.
  void append_neighbours(std::size_t position, std::vector<std::uint32_t>& out) {
    for (std::size_t row = 0; row < 9; ++row) {
      const std::uint64_t middle = keys_[position] + offset(row);
      std::size_t& cursor = cursors_[row];
      while (cursor < keys_.size() && keys_[cursor] < middle - 1) ++cursor;
      for (std::size_t i = cursor; i < keys_.size() && keys_[i] <= middle + 1; ++i) {
        if (i != position) out.push_back(static_cast<std::uint32_t>(i));
      }
    }
  }

 private:
  /// Unsigned numbers wrap around, so that a row below or before is a sum, too.
  static std::uint64_t offset(std::size_t row) { return (row / 3 - 1) * kZ + (row % 3 - 1) * kY; }

  std::span<const std::uint64_t> keys_;
  std::array<std::size_t, 9> cursors_;
};

struct Block {
  std::vector<std::uint32_t> counts, neighbours;
};

}  // namespace

VoxelGraph::VoxelGraph(std::span<const MedialSphere> spheres, unsigned threads)
    : spheres_(spheres), order_(spheres.size()), starts_(spheres.size() + 1, 0) {
  std::iota(order_.begin(), order_.end(), 0u);
  const auto before = [&](std::uint32_t a, std::uint32_t b) { return key_of(spheres[a]) < key_of(spheres[b]); };
  // The input usually is in order already.
  if (!std::is_sorted(order_.begin(), order_.end(), before)) std::stable_sort(order_.begin(), order_.end(), before);
  std::vector<std::uint64_t> keys(order_.size());
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = key_of(spheres[order_[i]]);

  std::vector<Block> blocks((keys.size() + kBlock - 1) / kBlock);
  parallel_for(blocks.size(), 1, threads, [&](std::size_t b) {
    NeighbourWalk walk(keys, b * kBlock);
    for (std::size_t position = b * kBlock; position < std::min(keys.size(), (b + 1) * kBlock); ++position) {
      const std::size_t size = blocks[b].neighbours.size();
      walk.append_neighbours(position, blocks[b].neighbours);
      blocks[b].counts.push_back(static_cast<std::uint32_t>(blocks[b].neighbours.size() - size));
    }
  });
  std::size_t position = 0;
  for (const Block& block : blocks) {
    for (const std::uint32_t count : block.counts) {
      starts_[position + 1] = starts_[position] + count;
      ++position;
    }
    neighbours_.insert(neighbours_.end(), block.neighbours.begin(), block.neighbours.end());
  }
}

bool VoxelGraph::touch(std::uint32_t a, std::uint32_t b) const {
  const auto &u = sphere(a).voxel, &v = sphere(b).voxel;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (u[axis] + 1 < v[axis] || v[axis] + 1 < u[axis]) return false;
  }
  return true;
}

}  // namespace medial_vk
