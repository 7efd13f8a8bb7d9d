// Binary trees over balls: which nodes are paired, without bounding volumes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "medial_vk/ball.h"

namespace medial_vk::bench {

/// The nodes of a binary tree over n balls. Nodes 0 to n - 1 are the balls; node n + i joins the two nodes `pairs[i]`,
/// which come before it. The last node is the root.
struct Pairing {
  std::size_t balls = 0;
  std::vector<std::array<std::uint32_t, 2>> pairs;

  std::size_t nodes() const { return balls + pairs.size(); }
};

/// From the root down: balls are divided by the plane through their centroid across the direction in which they spread
/// most (S. Stolpner, "Medial Spheres for Shape Representation", 2011, Section 8.4).
Pairing pair_top_down(std::span<const Ball> balls);

/// From the balls up: of all pairs of nodes the one with the smallest ball around it is joined next (Section 8.7.1 asks
/// for such a tree).
Pairing pair_bottom_up(std::span<const Ball> balls);

/// From the root down, with cuts across the same directions where the likelihoods on both sides are closest to equal,
/// so that likely balls are near the root (Section 8.7.4). Precondition: a likelihood for each ball.
Pairing pair_by_likelihood(std::span<const Ball> balls, std::span<const double> likelihoods);

}  // namespace medial_vk::bench
