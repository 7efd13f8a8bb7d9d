// Clean solids made dirty, by seed: what files from the wild hold. The same seed gives the same mesh on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "medial_vk/mesh.h"

namespace medial_vk::test {

struct Mutation {
  std::string description;  ///< The solid, and what was done to it in which order.
  Mesh mesh;
};

/// One of a few small solids after one to three mutations. Seeds go through all mutations in turn.
Mutation make_mutation(std::uint64_t seed);
/// How many mutations there are.
std::size_t mutation_count();

}  // namespace medial_vk::test
