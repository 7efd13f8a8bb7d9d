// The longest of the shortest paths between ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "medial_vk/plane_centre_line.h"
#include "unit/plane_centre_lines/axes_of_shapes.h"

namespace medial_vk {
namespace {

using test::axis_of;
using test::axis_of_graph;
using test::length_of;

PlaneAxis longest(const PlaneAxis& axis) {
  auto paths = find_longest_paths(axis);
  EXPECT_TRUE(paths) << paths.error().message;
  EXPECT_EQ(paths.value().excess, 0);
  return std::move(paths.value().axis);
}

/// By all pairs of nodes (Floyd and Warshall).
double longest_by_all_pairs(const PlaneAxis& axis) {
  const std::size_t n = axis.nodes.size();
  std::vector<double> distance(n * n, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < n; ++i) distance[i * n + i] = 0;
  for (const AxisBranch& branch : axis.branches) {
    for (const auto& [a, b] : {std::pair(branch.ends[0], branch.ends[1]), std::pair(branch.ends[1], branch.ends[0])}) {
      distance[a * n + b] = std::min(distance[a * n + b], branch.length);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        distance[i * n + j] = std::min(distance[i * n + j], distance[i * n + k] + distance[k * n + j]);
      }
    }
  }
  double most = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (axis.nodes[i].degree != 1 || axis.nodes[j].degree != 1 || std::isinf(distance[i * n + j])) continue;
      most = std::max(most, distance[i * n + j]);
    }
  }
  return most;
}

TEST(PlaneLongestPath, OfARectangleGoesFromCornerToCorner) {
  const PlaneAxis line = longest(axis_of({test::rectangle_ring(0, 0, 3, 1.5)}));
  ASSERT_EQ(line.branches.size(), 1u);
  EXPECT_NEAR(line.branches.front().length, 1.5 + 1.5 * std::sqrt(2.0), 1e-9);
  EXPECT_EQ(line.branches.front().arcs.size(), 3u);
}

/// Nodes within branches.
std::size_t two_of(const PlaneAxis& axis) {
  return static_cast<std::size_t>(std::ranges::count_if(axis.nodes, [](const AxisNode& n) { return n.degree == 2; }));
}

TEST(PlaneLongestPath, OfTreesIsThatOfAllPairs) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const PlaneAxis axis = axis_of({test::star_ring(seed, 30)}, 1e-7);  // a tree, whatever the star
    ASSERT_EQ(axis.branches.size() + 1, axis.nodes.size() - two_of(axis)) << seed;
    const PlaneAxis line = longest(axis);
    ASSERT_EQ(line.branches.size(), 1u);
    EXPECT_NEAR(line.branches.front().length, longest_by_all_pairs(axis), 1e-9) << seed;
  }
}

// Random graphs with many loops; two of three nodes at the end hang on one branch.
TEST(PlaneLongestPath, WithLoopsIsThatOfAllPairs) {
  std::uint64_t state = 5;
  const auto random = [&](std::uint32_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::uint32_t>((state >> 33) % below);
  };
  for (int round = 0; round < 200; ++round) {
    const std::uint32_t inner = 4 + random(12), ends = 2 + random(12);
    std::vector<std::pair<std::array<std::uint32_t, 2>, double>> edges;
    for (std::uint32_t n = 1; n < inner; ++n) edges.push_back({{random(n), n}, 1.0 + random(50)});
    for (std::uint32_t k = 0; k < inner; ++k) edges.push_back({{random(inner), random(inner)}, 1.0 + random(50)});
    for (std::uint32_t e = 0; e < ends; ++e) edges.push_back({{random(inner), inner + e}, 1.0 + random(20)});
    const PlaneAxis axis = axis_of_graph(std::vector<double>(inner + ends, 0.0), edges);
    EXPECT_EQ(length_of(longest(axis)), longest_by_all_pairs(axis)) << round;
  }
}

TEST(PlaneLongestPath, PartsAreSeparateAndLoopsStay) {
  const PlaneAxis axis = axis_of({test::rectangle_ring(0, 0, 4, 4), test::rectangle_ring(1, 1, 2, 2),
                                  test::rectangle_ring(6, 0, 1, 3), test::rectangle_ring(8, 0, 3, 1)});
  const PlaneAxis line = longest(axis);
  EXPECT_EQ(line.branches.size(), 3u);
  // Without corners, the frame is a loop without ends.
  auto pruned = prune_plane_axis(axis, {1, 0});
  ASSERT_TRUE(pruned);
  const PlaneAxis loop = longest(pruned.value());
  EXPECT_EQ(std::ranges::count_if(loop.branches, [](const AxisBranch& b) { return b.ends[0] == b.ends[1]; }), 1);
  EXPECT_EQ(length_of(loop), length_of(pruned.value()));
}

TEST(PlaneLongestPath, Stops) {
  std::stop_source stop;
  stop.request_stop();
  const PlaneAxis axis = axis_of({test::rectangle_ring(0, 0, 3, 1.5)});
  EXPECT_EQ(find_longest_paths(axis, stop.get_token()).error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace medial_vk
