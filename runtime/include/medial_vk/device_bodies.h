// Bodies on a device, and queries in many poses there, by balls: docs/theory.md, "Many poses on a device".
#pragma once

#include <memory>
#include <span>

#include "medial_vk/context.h"
#include "medial_vk/proximity.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// The balls of many bodies in the memory of a device; the bodies are kept, too. Move-only. For one thread at a time,
/// like its context, which must outlive it.
///
/// Answers are proved as those of collide_by_balls() and distance_bounds(), in float: with M and L of
/// distance_bounds(), bounds are within 6e-6 M + 4e-15 L + 1e-17 of the distances of the sets, and overlaps and gaps of
/// the sets beyond that are decided. Vulkan leaves the rounding to the driver, so answers may differ between devices
/// within that accuracy.
class DeviceBodies {
 public:
  /// Uploads the balls of all bodies, and waits for the device; meshes stay with the host. Errors: kUsage (no
  /// bodies, or more than 2^28 nodes in their trees), kOutOfMemory, kInternal.
  static Result<DeviceBodies> create(Context& context, std::span<const Body> bodies);
  DeviceBodies(DeviceBodies&&) noexcept;
  DeviceBodies& operator=(DeviceBodies&&) noexcept;
  ~DeviceBodies();

  /// The verdicts of collide_by_balls(bodies, pairs, ...), in blocks of up to 262,144 pairs, of which the device
  /// computes one while the host prepares the next. Memory for two blocks is kept, 176 bytes for each pair (on a device
  /// of the host's processors, for one block, 88 bytes). The host completes searches that are too long for the device's
  /// loops (on lavapipe, 3,200 pairs of nodes). Blocks until all are answered. Precondition: as for that function.
  /// Errors: kUsage (an index that is too large; `verdicts` of another size), kOutOfMemory, kInternal (device lost).
  Status collide_by_balls(std::span<const PosedPair> pairs, std::span<Collision> verdicts,
                          const BatchOptions& options = {});
  /// The same for the bounds of distance_bounds(bodies, pairs, ...).
  Status distance_bounds(std::span<const PosedPair> pairs, std::span<DistanceBounds> bounds,
                         const BatchOptions& options = {});

 private:
  friend struct Internals;
  struct Impl;
  explicit DeviceBodies(std::unique_ptr<Impl> impl);

  std::unique_ptr<Impl> impl_;
};

}  // namespace medial_vk
