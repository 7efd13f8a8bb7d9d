// The properties that hold for any mesh (docs/reliability.md, "Messy meshes").
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/context.h"

namespace medial_vk::test {

struct MutationOutcome {
  std::string description;
  bool rejected = false;  ///< prepare_mesh() refused it, with a message.
  bool closed = false;
  std::uint64_t points = 0, undecided = 0;
  std::vector<std::string> faults;  ///< Sentences; empty without a fault.
};

/// Makes the mutation of a seed, extracts it on the device and by the reference, and compares:
///   * the mesh is refused as invalid, with a message, or both extractions finish;
///   * every ball passes every condition of the certificate, evaluated by the reference;
///   * if the mesh is closed, neither finds a clearly salient point, of a radius that float can distinguish from 0, in
///     the middle of voxels that the other has proved empty. (On open meshes the two decide sides differently:
///     docs/decisions.md.)
MutationOutcome check_mutation(Context& context, std::uint64_t seed);

}  // namespace medial_vk::test
