// Two copies of a solid that tumble in a closed box, by the physics engine Bullet.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/pose.h"

namespace medial_vk::bench {

/// Of the second copy in the frame of the first, for each of `frames` frames of a sixtieth of a second. The copies are
/// compounds of `balls`. They start side by side at rest, in a cube of 2.4 times `side`; in every frame gravity has a
/// random direction (S. Stolpner, "Medial Spheres for Shape Representation", 2011, Section 8.5). Lengths are such that
/// `side` is one metre. `middle`: of the box around the solid. The same in every run.
std::vector<Pose> tumble(std::span<const Ball> balls, const Point& middle, double side, std::size_t frames);

}  // namespace medial_vk::bench
