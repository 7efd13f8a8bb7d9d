// A picture of two solids with what is nearest between them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/ball.h"
#include "medial_vk/mesh.h"
#include "output/picture/panels/image.h"
#include "output/picture/panels/options.h"

namespace medial_vk {

/// All in one frame.
struct PairPicture {
  Mesh mesh;  ///< The triangles of A, those of B, and those of everything else.
  std::size_t triangles_of_a = 0, triangles_of_b = 0;
  std::string name_a = "a", name_b = "b";  ///< Empty: not in the legend.
  bool has_points = false;                 ///< Whether there are nearest points.
  bool is_hit = false;                     ///< They are proved to be one common point.
  /// The nearest points, joined by a line; or one common point, which shows through everything.
  Point on_a = {0, 0, 0}, on_b = {0, 0, 0};
  /// Drawn as balls in the glass of the meshes; one that holds a ball of the other solid as a globe of wires, since it
  /// would hide that one.
  std::vector<Ball> inside_a, inside_b;
  std::vector<Ball> cover_a, cover_b;  ///< Drawn as circles, since they would hide what they hold.
  bool balls_decide = true;            ///< The balls give both ends; else triangles do, and the balls bound them.
  std::string title;
};

/// Drawn on the CPU, on one thread: 1200 x 900 pixels.
Picture draw_pair(const PairPicture& pair, const PictureView& view);

}  // namespace medial_vk
