// Does a triangle close a hole or a bubble?
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace medial_vk {

/// The boundaries of triangles modulo 2, reduced as in persistent homology (Edelsbrunner, Letscher and Zomorodian
/// 2002). A triangle whose three sides are there already closes a hole if its boundary is no sum of boundaries of the
/// triangles before it; if it is one, the triangle closes a bubble.
class Boundaries {
 public:
  /// By its three sides, in any numbers that tell edges apart. Chains stay short if the numbers of edges that are close
  /// to each other are, too. True: it closes no bubble, and counts from now on.
  bool add(std::array<std::uint64_t, 3> sides);
  /// Is a loop of edges a sum of the boundaries so far? Else it goes around a hole.
  bool is_boundary(std::span<const std::uint64_t> loop) const;

 private:
  using Chain = std::vector<std::uint64_t>;  // edges, descending
  Chain reduced(std::span<const std::uint64_t> edges) const;

  std::unordered_map<std::uint64_t, Chain> by_last_;  // by edge: the reduced chain that it is the greatest of
};

}  // namespace medial_vk
