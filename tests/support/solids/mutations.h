// Clean solids with faults, by seed, as files of users have them. The same seed gives the same mesh on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

struct Mutation {
  std::string description;  ///< The solid, and the mutations in their order.
  Mesh mesh;
};

/// One of a few small solids after one to three mutations. Seeds select all mutations in turn.
Mutation make_mutation(std::uint64_t seed);
/// The number of mutations.
std::size_t mutation_count();

}  // namespace medial_vk::test
