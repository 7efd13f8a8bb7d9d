// One ball for each cell of a grid.
#pragma once

#include <cstddef>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/solid.h"

namespace medial_vk::bench {

/// The balls around the cells that meet the solid, which they cover: of a grid of cubes that begins at the lower corner
/// of the box of the mesh, with sides 1 % apart, the finest that has at most `count` such cells. Radii are enlarged by
/// a millionth. Precondition: the solid has a volume; `count` > 0.
std::vector<Ball> voxel_cover(const Solid& solid, std::size_t count, unsigned threads);

/// The largest balls inside at the middles of cells: the finest of such grids with at most `count` middles inside.
std::vector<Ball> voxel_balls_inside(const Solid& solid, std::size_t count, unsigned threads);

}  // namespace medial_vk::bench
