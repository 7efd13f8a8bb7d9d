#include "proximity_jobs/packed_poses.h"

#include "base/parallel.h"
#include "proximity/body.h"
#include "proximity/placement.h"

namespace medial_vk {
namespace {

/// Separations of balls of two trees in range have squares that are floats, in the kernel.
constexpr double kMostSeparation = 8.9e18;

/// The bound of docs/theory.md, where a sum or product in the kernel has a relative error of up to 2^-23.
double error_on_device(const BodyTree& a, const BodyTree& b, const Placement& placement) {
  const double size = a.nodes().reach() + b.nodes().reach() + placement.distance();
  return 22.1 * 0x1p-23 * size + 0x1p-60 + 0x1p-48 * placement.lengths();
}

bool is_in_range_of_device(const BodyTree& a, const BodyTree& b, const Placement& placement) {
  return a.nodes().reach() + b.nodes().reach() + placement.distance() < kMostSeparation;
}

gpu::ProximityPose packed_pose(std::span<const Body> bodies, const PosedPair& pair) {
  const BodyImpl &a = Internals::of(bodies[pair.a]), &b = Internals::of(bodies[pair.b]);
  const Placement placement(a, b, pair.pose);
  gpu::ProximityPose packed{};
  packed.a = packed.b = kNoBody;
  if (!placement.is_in_range() || !is_in_range_of_device(a.inside_tree, b.inside_tree, placement) ||
      !is_in_range_of_device(a.cover_tree, b.cover_tree, placement)) {
    return packed;
  }
  const auto& [rows, shift] = placement.float_pose();
  packed.row_x = {rows[0][0], rows[0][1], rows[0][2], shift[0]};
  packed.row_y = {rows[1][0], rows[1][1], rows[1][2], shift[1]};
  packed.row_z = {rows[2][0], rows[2][1], rows[2][2], shift[2]};
  packed.a = pair.a | gpu::kProximityCentred;
  packed.b = pair.b;
  packed.inside_error = rounded_up(error_on_device(a.inside_tree, b.inside_tree, placement));
  packed.cover_error = rounded_up(error_on_device(a.cover_tree, b.cover_tree, placement));
  return packed;
}

}  // namespace

void pack_poses(std::span<const Body> bodies, std::span<const PosedPair> pairs, std::span<gpu::ProximityPose> packed,
                unsigned threads) {
  constexpr std::size_t kBlock = 1024;
  parallel_for(pairs.size(), kBlock, threads, [&](std::size_t i) { packed[i] = packed_pose(bodies, pairs[i]); });
}

}  // namespace medial_vk
