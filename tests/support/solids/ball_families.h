// Sets of balls for tests and measurements of unions: random sets, and difficult ones.
#pragma once

#include <cstddef>
#include <vector>

#include "medial_vk/ball.h"

namespace medial_vk::test {

/// Centres in the unit cube, radii between two bounds.
std::vector<Ball> random_balls(std::size_t count, unsigned seed, double least, double most);
/// n^3 balls of one radius on a lattice of step 1, each coordinate and radius moved by up to `noise`.
std::vector<Ball> lattice(int n, double radius, double noise = 0, unsigned seed = 1);
/// n^2 balls of one radius on a square lattice of step 1 in the plane z = 1/2.
std::vector<Ball> flat_lattice(int n, double radius);
/// Spheres of several sizes through one point, up to rounding; centres in all directions or in a half-space.
std::vector<Ball> through_a_point(std::size_t count, unsigned seed, bool all_directions);
/// Centres on a line that is not along an axis, up to rounding.
std::vector<Ball> collinear(std::size_t count, unsigned seed);
/// Radii over twelve orders of magnitude, evenly in their logarithm; the small ones close to each other.
std::vector<Ball> of_all_sizes(std::size_t count, unsigned seed);
/// One centre, radii in random order, some of them equal.
std::vector<Ball> concentric(std::size_t count, unsigned seed);
/// Balls that stand on the plane z = 0.
std::vector<Ball> on_a_plane(std::size_t count, unsigned seed);
/// Centres on a sphere of radius 1, up to rounding, evenly spread.
std::vector<Ball> cospherical(std::size_t count, double radius);

}  // namespace medial_vk::test
